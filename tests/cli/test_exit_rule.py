"""Commands that judge end with 1 on a miss, 3 where something could not be judged, 0 where all holds."""

import math
from types import SimpleNamespace

import pytest

from contact_sim_lab.validation import curves, validation
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.records.metric import exit_status
from contact_sim_pkg.studies.effects import effects_study, effects_table


def test_a_miss_counts_before_what_could_not_be_judged():
    assert [exit_status(missed=missed, unjudged=unjudged) for missed in (False, True) for unjudged in (False, True)] == [
        0, 3, 1, 1,
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("ours", "code"), [((2.0, 3.0), 0), ((2.0, 9.0), 1), ((2.0, math.nan), 3), ((9.0, math.nan), 1)]
)
def test_validation_ends_by_its_figures(monkeypatch, capsys, ours, code):
    rows = [
        {"machine": "tire", "quantity": "length", "unit": "mm", "published": "2", "ours": each, "band": [1.0, 4.0],
         "inside": 1.0 <= each <= 4.0, "fitted": False, "source": "s", "note": "n"}
        for each in ours
    ]  # fmt: skip
    monkeypatch.setattr(validation, "study", lambda _progress: rows)
    monkeypatch.setattr(curves, "study", lambda _progress: [])
    assert main(["validation"]) == code
    assert "length" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("verdicts", "code"),
    [
        (("needed", "not needed", "not available"), 0), (("needed", "off but needed"), 1),
        (("the error of the numbers decides", "needed"), 3),
    ],
)  # fmt: skip
def test_effects_end_by_their_verdicts(monkeypatch, verdicts, code):
    study = SimpleNamespace(rows=[SimpleNamespace(verdict=each) for each in verdicts])
    monkeypatch.setattr(effects_study, "study_of", lambda *_given, **_options: study)
    monkeypatch.setattr(effects_table, "answer", lambda _study: "")
    monkeypatch.setattr(effects_table, "table", lambda _study: [])
    assert main(["effects", "block_fall"]) == code
