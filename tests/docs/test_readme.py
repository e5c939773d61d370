"""What the README shows is true: what Python prints, the badges, the gallery with its commands, the commands below."""

import contextlib
import io
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PIL import Image

from contact_sim_lab.pages.gallery import GALLERY
from contact_sim_pkg.cli.main import COMMANDS, LABORATORY
from contact_sim_pkg.library import load_scene, run
from contact_sim_pkg.report.printed import figure_named
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.scene.load import shipped_names
from set_up.underlay import DISTRIBUTION

ROOT = Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs" / "images"
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
LARGEST = 150_000  # bytes of a picture of the gallery
SHORT = 0.6  # [s] of a run that has the figure, though not what it is to show
SETUP = (ROOT / "contact_sim_pkg" / "setup.py").read_text(encoding="utf-8")


def test_python_prints_what_stands_below():
    """At most five statements, the import among them."""
    code, printed = (
        re.search(rf"^```{kind}\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)[1] for kind in ("python", "text")
    )
    assert len([line for line in code.splitlines() if line]) == 5
    with contextlib.redirect_stdout(io.StringIO()) as said:
        exec(compile(code, "README.md", "exec"), {})
    assert said.getvalue() == printed


def test_the_badges_are_true_and_need_no_service():
    licence = re.search(r'license="(.*?)"', SETUP)[1]
    first, beyond = re.search(r'python_requires=">=3\.(\d+),<3\.(\d+)"', SETUP).groups()
    said = {
        "licence": f"licence: {licence}",
        "python": f"Python: 3.{first} to 3.{int(beyond) - 1}",
        "ros": f"ROS 2: {DISTRIBUTION.capitalize()}",
    }
    for name, sentence in said.items():
        path = IMAGES / f"badge_{name}.svg"
        assert ElementTree.parse(path).getroot().get("aria-label") == sentence
        assert f"docs/images/{path.name}" in TEXT
    assert "Apache License" in (ROOT / "LICENSE").read_text(encoding="utf-8")
    assert not re.findall(r"!\[[^]]*\]\(http", TEXT)


@pytest.mark.parametrize("shown", GALLERY, ids=lambda shown: shown.scene)
def test_a_picture_stands_with_its_commands(shown):
    assert f"](docs/images/{shown.file})" in TEXT
    assert f"| {shown.caption} |" in TEXT
    assert "\n".join(shown.commands) in TEXT
    path = IMAGES / shown.file
    assert path.stat().st_size < LARGEST
    with Image.open(path) as image:
        assert image.mode in ("RGB", "RGBA")  # no palette
        assert 700 < image.width < 1000


@pytest.mark.parametrize("shown", GALLERY, ids=lambda shown: shown.scene)
def test_its_figure_is_in_the_report_of_its_scene(shown):
    figure = figure_named(shown.figure, read_recording(run(load_scene(shown.scene, f"duration={SHORT}"))))
    assert figure.axes


def test_there_are_six_and_no_picture_of_a_page_is_left_over():
    assert len(GALLERY) == 6
    pages = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "README.md", *ROOT.glob("docs/**/*.md")))
    assert [path.name for path in IMAGES.iterdir() if f"images/{path.name}" not in pages] == []


def test_its_commands_and_scenes_are_those_of_the_bench():
    blocks = re.findall(r"^```bash\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)
    named = {match[1] for block in blocks for match in re.finditer(r"^bench (\w+)", block, re.MULTILINE)}
    assert named <= {*COMMANDS, *LABORATORY}
    rows = re.findall(
        r"^\| (`\w+`(?:, `\w+`)*) \| (?:seat|backrest|occupant|impact|block|roller|tire|car) \|", TEXT, re.MULTILINE
    )
    assert sorted(re.findall(r"`(\w+)`", " ".join(rows))) == sorted(shipped_names())
