"""The page in a real browser; skipped where none is installed."""

import html
import re
import shutil
import subprocess

import pytest

from contact_sim_pkg.report.report import write_report

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

# Runs in the copy of the page that the test makes; the page itself has no script.
PROBE = """<pre id="probe"></pre><script>
const boxes = [...document.querySelectorAll('figure svg')].map(svg => svg.getBoundingClientRect());
const texts = [...document.querySelectorAll('figure svg text')].filter(text => text.getBoundingClientRect().width > 0);
const cut = text => {
  const box = text.getBoundingClientRect(), frame = text.ownerSVGElement.getBoundingClientRect();
  return box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 || box.bottom > frame.bottom + 1;
};
const root = document.documentElement;
document.getElementById('probe').textContent = [
  boxes.length, Math.min(...boxes.map(box => box.width)), Math.min(...boxes.map(box => box.height)),
  texts.filter(cut).length, texts.length, root.scrollWidth, root.clientWidth,
].join(' ');
</script>"""

pytestmark = pytest.mark.skipif(BROWSER is None, reason="no chromium or chrome on the PATH")


@pytest.fixture(scope="module", params=["car", "rolling", "backrest"])
def rendered(request, tmp_path_factory):
    """Name of the bag, number of pictures, least width and height, texts cut and drawn, width of content and window [px]."""
    folder = tmp_path_factory.mktemp("browser")
    bag = request.getfixturevalue(request.param)
    page = write_report(bag, folder / "page.html").read_text(encoding="utf-8")
    page = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page).replace("</body>", f"{PROBE}</body>")
    (folder / "probe.html").write_text(page, encoding="utf-8")
    command = [
        BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run",
        f"--user-data-dir={folder / 'profile'}", "--window-size=1200,2000", "--dump-dom",
        (folder / "probe.html").as_uri(),
    ]  # fmt: skip
    shown = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True).stdout
    found = re.search(r'<pre id="probe">([^<]*)</pre>', shown)
    assert found is not None
    return [request.param, *(float(number) for number in html.unescape(found[1]).split())]


def test_every_picture_is_drawn(rendered):
    name, pictures, width, height, _, texts, *_ = rendered

    assert pictures == {"car": 12, "rolling": 11, "backrest": 11}[name]
    assert width > 600
    assert height > 150
    assert texts > 100


def test_nothing_runs_over_the_side_at_1200_pixels(rendered):
    *_, content, window = rendered

    assert 1100 < window <= 1200
    assert content <= window


def test_no_text_of_a_picture_is_cut(rendered):
    _, _, _, _, cut, *_ = rendered

    assert cut == 0
