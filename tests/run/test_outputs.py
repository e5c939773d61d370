"""Outputs that every rig has: stamps, wrenches, energy ledger, cost."""

import numpy
import pytest

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import ContactForce
from contact_sim_pkg.run.outputs import BlockStamps, Centre, contact_outputs, energy_ledger, largest, solver_cost
from contact_sim_pkg.scene.timing import Timing

TIMING = Timing(0.01, 5, 2, 6, 1, 1, 4)  # 12 samples and 4 wrenches in 10 ms
STAMPS = BlockStamps(3, TIMING)


def force(**columns):
    given = dict.fromkeys(("normal", "tangential", "approach", "effective_height"), numpy.arange(12.0))
    return ContactForce(block=3, sample_period=STAMPS.period, **given | columns)


def test_samples_lie_evenly_in_their_block():
    assert (STAMPS.start, STAMPS.period) == (30_000_000, pytest.approx(0.01 / 12))
    assert [STAMPS.at(sample) for sample in (0, 6, 11)] == [30_000_000, 35_000_000, 39_166_666]
    assert list(STAMPS.displayed()) == [0, 3, 6, 9]


def test_a_wrench_is_the_resultant_of_its_sample_impulses_included():
    lateral = numpy.column_stack([numpy.full(12, 7.0), numpy.full(12, 8.0)])
    rows = list(contact_outputs("tire", STAMPS, force(impulses=numpy.full(12, 100.0)), lateral=lateral))
    assert [row.topic for row in rows] == ["tire/force", *["tire/wrench"] * 4]
    last = rows[-1].record.wrench
    assert (tuple(last.force), tuple(last.torque)) == ((9.0, 7.0, 109.0), (0.0, 0.0, 8.0))
    assert rows[-1].stamp == STAMPS.at(9)


def test_the_torque_is_that_of_the_normal_force_in_the_last_centre_of_pressure():
    """r x F of a force F_z at (x, y, 0): (y F_z, -x F_z, 0); the first centre comes with sample 3."""
    centres = [Centre(3, 0.1, 0.2), Centre(8, -0.5, 0.0)]
    rows = [
        row.record.wrench for row in contact_outputs("seat", STAMPS, force(), centres=centres) if "wrench" in row.topic
    ]
    assert [tuple(row.torque) for row in rows] == [
        pytest.approx(expected, abs=1e-15)
        for expected in ((0.0, 0.0, 0.0), (0.6, -0.3, 0.0), (1.2, -0.6, 0.0), (0.0, 4.5, 0.0))
    ]


def test_the_residual_is_supplied_energy_that_is_nowhere():
    ledger = energy_ledger(3, kinetic=1.0, potential=2.0, stored=4.0, dissipated=8.0, supplied=16.0)
    assert ledger.residual == 1.0


def test_missing_columns_of_cost_are_zero():
    cost = solver_cost(STAMPS, 0.005, steps=7)
    assert (cost.real_time_factor, cost.steps, cost.coupling_steps, cost.field_residual) == (2.0, 7, 0, 0.0)


def test_the_largest_of_a_column_is_over_all_topics_of_its_kind():
    outputs = [Output("tire/force", 0, force()), Output("seat/force", 0, force(normal=numpy.full(12, 50.0)))]
    assert largest(outputs, "force", "normal") == 50.0
    assert largest(outputs, "patch", "peak") == 0.0
