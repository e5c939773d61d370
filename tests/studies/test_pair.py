"""Numerical error of a metric by a pair of runs on half the cells."""

import json
import math
from types import SimpleNamespace

import pytest

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.compare.companion import halved
from contact_sim_pkg.records.metric import Metric
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.studies import pair


def metric(value, **more):
    return Metric("tire.a", "a", value, "N", "no band", None, **more)


def test_half_the_cells_are_half_along_each_side_and_nothing_else_changes():
    scene = load_resolved("car_full_bench")
    half = halved(scene)
    tire, other = (each.data["effects"]["tire"]["contact_field"] for each in (scene, half))
    assert (2 * other["rows"], 2 * other["cols"]) == (tire["rows"], tire["cols"])
    cushion, coarser = (each.data["effects"]["seat"]["cushion"] for each in (scene, half))
    assert coarser["cell"] == 2.0 * cushion["cell"]
    assert half.data["integrator"] == scene.data["integrator"]
    assert half.data["outputs"] == scene.data["outputs"]


@pytest.mark.parametrize(
    ("scene", "where", "sides"),
    [
        ("seat_slap", ("backrest", "mat"), {"rows": (40, 20), "cols": (32, 16)}),
        (
            "roller_steady",
            ("effects", "roller", "subsurface"),
            {"cells_x": (48, 24), "cells_y": (60, 30), "cells_z": (12, 6)},
        ),
        (
            "seat_ride_full",
            ("backrest", "mat"),
            {"rows": (40, 40)},
        ),  # does not act on a cushion, which has its own cells
    ],
)
def test_a_mat_and_the_box_under_a_contact_have_half_the_cells_too(scene, where, sides):
    whole = load_resolved(scene)
    before, after = whole.data, halved(whole).data
    for key in where:
        before, after = before[key], after[key]
    assert {side: (before[side], after[side]) for side in sides} == sides


def test_the_error_is_that_of_the_steps_and_that_of_the_cells(monkeypatch):
    """On half the cells 10.3, with finer steps 10.1, the run 10: 0.2 and 0.3."""
    runs = iter(([metric(10.3)], [metric(10.1)]))
    monkeypatch.setattr(pair, "whole_run", lambda _scene, _notify: SimpleNamespace(recording=next(runs)))
    monkeypatch.setattr(pair, "all_metrics", lambda recording: recording)
    given = [
        metric(10.0, broken=("not resolved: of before", "too short")),
        metric(7.0)._replace(key="tire.b", error=0.7),
    ]
    first, second = pair.with_errors_of_pair(load_resolved("seat_ride"), given, lambda _line: None)
    assert first.error == pytest.approx(0.5)
    assert first.broken == ("too short",)
    assert second.error == 0.7


@pytest.mark.parametrize(("value", "told"), [(1.0, False), (0.1, True)])
def test_an_error_above_a_tenth_is_not_resolved(value, told):
    found = pair._with_error(metric(value), value + 0.01, value + 0.02)
    assert bool(found.broken) is told
    assert math.isclose(found.error, 0.02)


def test_the_command_tells_the_error_of_every_metric_of_a_run(tmp_path, capsys):
    """Of a footprint, whose length has none without; not below what a run on finer cells and steps shows."""
    bag = tmp_path / "bag"
    given = ["--set", "duration=0.06", "--set", "road.position=0.3", "--set", "effects.tire.contact_field.rows=36",
             "--set", "effects.tire.contact_field.cols=24"]  # fmt: skip
    assert main(["run", "tire_bump", "--offline", "--out", str(bag), *given]) == 0
    capsys.readouterr()
    main(["metrics", str(bag), "--error", "--json"])
    rows = {each["key"]: each for each in json.loads(capsys.readouterr().out)["metrics"]}
    assert {key for key, each in rows.items() if each["error"] is None} == {"energy.residual"}
    assert 0.0 < rows["tire.patch_pressure"]["error"] < 0.1 * rows["tire.patch_pressure"]["value"]
    assert rows["tire.off_the_road"]["error"] >= 1.0  # a sample of 1 ms
    assert main(["metrics", str(bag), str(bag), "--error"]) == 2
    assert main(["metrics", str(bag), "--error", "--axis", "Wb"]) == 2  # the pair has the usual weighting
