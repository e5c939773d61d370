"""The page in a real browser; skipped where none is installed."""

import pytest
from tests.report.browser import BROWSER, browser

from contact_sim_pkg.report.comparison.runs import write_comparison
from contact_sim_pkg.report.report import write_report

pytestmark = pytest.mark.skipif(BROWSER is None, reason="no chromium or chrome on the PATH")
WIDE, NARROW = 1400, 400
"""[px] of the two windows"""


@pytest.fixture(scope="module")
def tab(tmp_path_factory):
    with browser(tmp_path_factory.mktemp("browser")) as found:
        yield found


@pytest.fixture(scope="module", params=["car", "seat", "rolling", "backrest"])
def page(request, tmp_path_factory):
    bag = request.getfixturevalue(request.param)
    return request.param, write_report(bag, tmp_path_factory.mktemp("page") / "page.html")


@pytest.fixture(scope="module", params=[WIDE, NARROW])
def shown(request, page, tab):
    return page[0], tab.measured(page[1], request.param)


def test_every_picture_is_drawn(shown):
    name, found = shown
    assert found["pictures"] == {"car": 12, "seat": 6, "rolling": 11, "backrest": 11}[name]
    assert found["texts"] > 100


def test_the_page_is_short_as_first_opened(shown):
    _, found = shown
    assert found["height"] <= 6000
    assert found["height"] < found["unfolded"]


def test_the_first_screen_has_a_tile_and_a_picture(shown):
    _, found = shown
    assert found["first_tile"] <= 900
    assert found["first_picture"] <= 900


def test_no_text_is_too_small_cut_or_over_another(shown):
    _, found = shown
    assert found["smallest"] == []
    assert found["cut"] == []
    assert found["overlap"] == []


def test_nothing_runs_over_the_side(shown):
    _, found = shown
    assert found["content"] <= found["window"]


def test_the_contents_list_every_fold_and_lead_somewhere(shown):
    _, found = shown
    assert found["unlisted"] == []
    assert found["broken"] == []
    assert found["headless"] == 0


def test_the_scripts_run_under_the_policy_and_ask_for_nothing(shown):
    _, found = shown
    assert found["console"] == []
    assert found["requests"] == []
    assert found["ready"] > 0


@pytest.mark.parametrize("width", [WIDE, NARROW])
@pytest.mark.parametrize("name", ["car", "backrest"])
def test_a_comparison_is_short_and_legible(tab, request, tmp_path, name, width):
    bag = request.getfixturevalue(name)
    found = tab.measured(write_comparison([bag, bag], tmp_path / "pair.html"), width)
    assert found["height"] <= 6000
    assert found["content"] <= found["window"]
    assert [found[fault] for fault in ("smallest", "cut", "overlap", "console", "requests")] == [[]] * 5


def test_the_slider_moves_the_map_and_the_cursor(page, tab):
    name, file = page
    if name == "seat":
        pytest.skip("the bag has no map")
    tab.open(file, WIDE, 900)
    seen = "document.querySelector('.film output').textContent"
    before = tab.value(seen)
    tab.value("{ const slider = document.querySelector('.slider input'); slider.value = slider.max;"
              " slider.dispatchEvent(new Event('input')); }")  # fmt: skip
    assert tab.value(seen) != before
    assert float(tab.value("document.querySelector('.u-legend .u-value').textContent")) > 0.0


def test_the_keyboard_reaches_slider_and_folds(page, tab):
    tab.open(page[1], WIDE, 900)
    unreached = """[...document.querySelectorAll('summary, input:not([disabled]), .picture, nav a')]
        .filter(each => each.checkVisibility() && each.tabIndex < 0).length"""
    assert tab.value(unreached) == 0


@pytest.mark.parametrize("dark", [False, True])
def test_texts_stand_out_from_their_ground(page, tab, dark):
    """Contrast of at least 4.5 of each colour of text to page and panel (WCAG 2.2, 1.4.3)."""
    tab.open(page[1], WIDE, 900, dark=dark)
    contrasts = """(() => {
      const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
      const light = name => {
        const [r, g, b] = [1, 3, 5].map(at => parseInt(colour(name).slice(at, at + 2), 16) / 255)
          .map(each => (each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05;
      };
      const found = {};
      for (const text of ["--ink", "--muted", "--accent", "--warn", "--good", "--bad"])
        for (const ground of ["--paper", "--panel"]) {
          const [a, b] = [light(text), light(ground)];
          found[`${text} on ${ground}`] = Math.max(a, b) / Math.min(a, b);
        }
      return found;
    })()"""
    assert {name: each for name, each in tab.value(contrasts).items() if each < 4.5} == {}
