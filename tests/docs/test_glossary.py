"""docs/glossary.md explains the names of effects, rigs and topics, one line a term, each with its source."""

import re
from pathlib import Path

from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.records.registry import effects, rigs

TEXT = (Path(__file__).resolve().parents[2] / "docs" / "glossary.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
    for line in TEXT.splitlines()
    if line.startswith("|") and not line.startswith(("| term", "|---"))
]
NAMES = set(re.findall(r"`([^`]+)`", " ".join(row[3] for row in ROWS)))
PAPERS = r"\*(Driver and Seat|Contact Area|Tire/Road Contact|Rolling Contact|Identifiability)\*"
SOURCES = rf"Johnson|Pacejka|Brogliato|HNW|Fairley|Huang|ISO|REP|ASAM|ROS 2|{PAPERS}"


def test_every_effect_stands_in_the_glossary():
    assert not set(effects()) - NAMES


def test_every_message_of_a_contact_stands_in_the_glossary():
    leaves = {
        name.rpartition("/")[2] for name in TOPICS if name.split("/")[0] in {"tire", "seat", "backrest", "roller"}
    }
    plain = {"force", "contact"}  # of everyday language
    assert not leaves - plain - NAMES
    assert not set(rigs()) - {"car", "seat", "block", "impact", "roller", "backrest"} - NAMES


def test_a_term_has_one_line_with_meaning_and_source():
    assert len(ROWS) > 100
    assert all(len(row) == 5 and row[0] and row[2] for row in ROWS)
    assert len({row[0] for row in ROWS}) == len(ROWS)
    assert not [row for row in ROWS if row[4] != "–" and not re.match(SOURCES, row[4])]
