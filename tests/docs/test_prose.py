"""Pages are easy to read: short lines, table cells that hold a phrase, words of the field, links that lead somewhere."""

import re
from pathlib import Path

import click
import pytest

from contact_sim_pkg.cli.main import COMMANDS, bench

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted(
    path
    for pattern in ("*.md", "docs/**/*.md", "bags/*.md", "contact_msgs_defs/**/*.md", "contact_sim_pkg/**/*.md")
    for path in ROOT.glob(pattern)
)
WIDEST = 100
LONGEST_CELL = 120
NAMES = [str(path.relative_to(ROOT)) for path in PAGES]
PRIVATE_WORDS = (
    "asked|coast|doubts?|doubted|ladders?|marched|put right|remembers|rungs?|speaks? against|stands? where|stretch|stretches|"
    "tiers?|told|tells|touch(es)? nothing known|waited in vain"
)
"""Words that `docs/glossary.md` has a term for."""
LABORATORY = ROOT / "contact_sim_lab" / "contact_sim_lab"
ROOMS = (ROOT, ROOT / "contact_sim_pkg", ROOT / "contact_sim_pkg" / "contact_sim_pkg", LABORATORY, LABORATORY.parent)


TEXTS = sorted(
    path
    for pattern in (
        "contact_msgs_defs/msg/*.msg",
        "contact_sim_pkg/contact_sim_pkg/rigs/*/scenes/*.yaml",
        "contact_sim_pkg/config/*.yaml",
    )
    for path in ROOT.glob(pattern)
)
"""Files with comments for a user."""


def private_words(text):
    """The private words of a text, those between backticks left out."""
    found = re.finditer(rf"\b({PRIVATE_WORDS})\b", re.sub(r"`[^`]*`", "", text), flags=re.IGNORECASE)
    return [match[0] for match in found]


def prose(text):
    """Number and text of each line outside code blocks, tables and HTML."""
    code = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            code = not code
        elif not code and not line.lstrip().startswith(("|", "<")):
            yield number, line


def by_hand(text):
    """The text without the tables that a command makes."""
    return re.sub(
        r"<!-- tables made from .*?: begin -->.*<!-- tables made from .*?: end -->", "", text, flags=re.DOTALL
    )


def anchors(text):
    """The anchors of a page's headings, as GitHub makes them."""
    titles = (line.lstrip("#").strip().lower() for _, line in prose(text) if line.startswith("#"))
    return {re.sub(r"[^\w\- ]", "", title).replace(" ", "-") for title in titles}


def test_the_pages_are_found():
    assert {"README.md", "docs/models.md", "docs/decisions/0001-an-absent-effect-is-none.md"} <= set(NAMES)


@pytest.mark.parametrize("path", PAGES, ids=NAMES)
def test_lines_of_prose_are_short(path):
    long = [number for number, line in prose(path.read_text(encoding="utf-8")) if len(line) > WIDEST]
    assert not long, f"lines of more than {WIDEST} characters: {long}"


@pytest.mark.parametrize("path", PAGES, ids=NAMES)
def test_a_table_cell_holds_a_figure_or_a_phrase(path):
    rows = [line for line in by_hand(path.read_text(encoding="utf-8")).splitlines() if line.startswith("|")]
    cells = [cell.strip() for row in rows for cell in re.split(r"(?<!\\)\|", row)]
    assert not [cell for cell in cells if len(cell) > LONGEST_CELL or re.search(r"[a-z)]\. [A-Z]", cell)]


@pytest.mark.parametrize("path", [path for path in PAGES if path.name != "glossary.md"], ids=str)
def test_pages_use_the_words_of_the_field(path):
    assert not private_words(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.name)
def test_comments_use_the_words_of_the_field(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    assert not private_words("\n".join(line.partition("#")[2] for line in lines if "bench " not in line))


@pytest.mark.parametrize("name", ["", *COMMANDS])
def test_help_texts_use_the_words_of_the_field(name):
    command = bench.get_command(click.Context(bench), name) if name else bench
    assert not private_words(command.get_help(click.Context(command)))


@pytest.mark.parametrize("path", PAGES, ids=NAMES)
def test_links_lead_somewhere(path):
    text = path.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", text)):
        if target.startswith("http"):
            continue
        file, _, anchor = target.partition("#")
        page = (path.parent / file) if file else path
        assert page.exists(), target
        assert not anchor or anchor in anchors(page.read_text(encoding="utf-8")), target


@pytest.mark.parametrize("path", PAGES, ids=NAMES)
def test_modules_that_a_page_names_are_there(path):
    named = re.findall(r"`([\w./]+/[\w./]*\.py)`", path.read_text(encoding="utf-8"))
    assert not [name for name in named if not any((room / name).exists() for room in (*ROOMS, path.parent))]


@pytest.mark.parametrize("path", PAGES, ids=NAMES)
def test_modules_that_a_page_runs_are_there(path):
    modules = re.findall(r"python -m (contact_sim_pkg[\w.]*|comparisons[\w.]*)", path.read_text(encoding="utf-8"))
    files = [
        ROOT / ("contact_sim_pkg" if name.startswith("contact") else "") / name.replace(".", "/") for name in modules
    ]
    assert not [file for file in files if not file.with_suffix(".py").exists() and not (file / "__main__.py").exists()]


@pytest.mark.parametrize("path", [path for path in PAGES if "rigs" in path.parts], ids=str)
def test_the_page_of_a_rig_lists_files_that_are_there(path):
    files = path.read_text(encoding="utf-8").partition("\n## Files\n")[2]
    cells = re.findall(r"^\| (`.*?) \|", files, flags=re.MULTILINE)
    listed = re.findall("`([^`]+)`", " ".join(cells))
    assert listed
    assert not [name for name in listed if not (path.parent / name).exists()]
