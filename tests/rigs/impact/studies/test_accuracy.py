"""What accuracy costs on an impact scene: the run itself is at rounding, the cheap ways as wrong as known."""

import pytest

from contact_sim_lab.rigs.impact import accuracy as accuracy_cost_impact
from contact_sim_pkg.scene.resolve import load_resolved


def quiet(_line):
    pass


def errors(scene, *values):
    rows = accuracy_cost_impact.way_rows(scene, load_resolved(scene, *values), quiet)
    return {(row["level"], row["quantity"]): row["error"] for row in rows}


def test_the_run_meets_scipy_and_the_free_impact_misses_the_weight():
    found = errors("impact_rubber_drop")
    assert max(error for (level, _quantity), error in found.items() if level.startswith("as it is run")) < 1e-10
    assert 1e-3 < found["free impact", "contact time"] < 1e-2
    assert found["closed forms", "restitution"] == pytest.approx(0.6793 / 0.5644 - 1.0, abs=5e-3)
    assert ("table", "depth") in found


def test_a_pendulum_has_no_weight_along_the_blow():
    found = errors("impact_pendulum")
    assert found["free impact", "contact time"] < 1e-11
    assert found["table", "restitution"] < 1e-10


def test_a_way_without_an_answer_has_no_row():
    found = errors("impact_rubber_drop", "impact.sample.loss_tangent=3.0")
    assert {level for level, _quantity in found} == {"free impact", "as it is run, under weight"}
