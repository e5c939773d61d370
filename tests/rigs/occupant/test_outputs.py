"""Outputs of seat and backrest, combined before they are encoded."""

import numpy
import pytest

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import BodyMotion
from contact_sim_pkg.rigs.occupant.outputs import combined
from contact_sim_pkg.run.outputs import BlockStamps, energy_ledger, solver_cost, wrench_of
from contact_sim_pkg.scene.timing import Timing

STAMPS = BlockStamps(3, Timing(0.01, 5, 2, 6, 1, 1, 4))  # blocks of 10 ms


def part(body, height, cost):
    rows = numpy.full((1, 12), height)
    motion = BodyMotion(
        block=3,
        sample_period=STAMPS.period,
        bodies=(body,),
        position=rows,
        velocity=2.0 * rows,
        acceleration=3.0 * rows,
    )
    ledger = energy_ledger(3, kinetic=height, potential=0.0, stored=1.0, dissipated=0.0, supplied=height + 1.5)
    return [
        Output(f"{body}/wrench", STAMPS.start, wrench_of((0.0, 0.0, height), (0.0, 0.0, 0.0))),
        Output("bench/motion", STAMPS.start, motion), Output("bench/energy", STAMPS.start, ledger),
        Output("bench/cost", STAMPS.start, cost),
    ]  # fmt: skip


@pytest.fixture(scope="module")
def both():
    seat = solver_cost(STAMPS, 0.002, steps=3, events=1, field_residual=1e-8, coupling_error=2e-3)
    back = solver_cost(STAMPS, 0.003, steps=4, field_residual=3e-8)
    return {each.topic: each for each in combined([part("seat", 1.0, seat), part("backrest", 2.0, back)])}


def test_each_topic_comes_once_at_its_stamp(both):
    assert set(both) == {"seat/wrench", "backrest/wrench", "bench/motion", "bench/energy", "bench/cost"}
    assert {each.stamp for each in both.values()} == {STAMPS.start}


def test_motions_are_side_by_side(both):
    motion = both["bench/motion"].record
    assert motion.bodies == ("seat", "backrest")
    assert motion.acceleration[:, 0].tolist() == [3.0, 6.0]


def test_energies_add_up(both):
    ledger = both["bench/energy"].record
    assert (ledger.block, ledger.kinetic, ledger.stored, ledger.supplied, ledger.residual) == (3, 3.0, 2.0, 6.0, 1.0)


def test_costs_add_up_but_of_residuals_and_errors_the_largest_counts(both):
    cost = both["bench/cost"].record
    assert (cost.block, cost.steps, cost.events, cost.field_residual, cost.coupling_error) == (3, 7, 1, 3e-8, 2e-3)
    assert (cost.wall_time, cost.real_time_factor) == (pytest.approx(0.005), pytest.approx(2.0))
