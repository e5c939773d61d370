"""A back on foam that remembers: against an independent integration, and its energy."""

import numpy
import pytest
from scipy.integrate import solve_ivp
from tests.rigs.backrest.backrest_runs import GRAVITY, MASS, driven, one_mass, sine

from contact_sim_pkg.laws.parameters import FoamElastic, NormalDissipative
from contact_sim_pkg.rigs.backrest import entries as columns
from contact_sim_pkg.rigs.backrest.motion import memory_offset

FOAM = FoamElastic(0.12, 0.08, 4.0e4, 3.0e3, 150.0, 3.0)
SHARE, ENERGY = 0.12, 1.0


def foam_force(approach):
    """The two terms of the hyperfoam law, as its docstring states them, at a strain below 1."""
    if approach <= 0.0:
        return 0.0
    stretch, slope = 1.0 - approach / FOAM.thickness, FOAM.modulus / FOAM.plateau
    first = FOAM.plateau * (1.0 / stretch - stretch ** (slope - 1.0))
    return FOAM.area * (first + FOAM.densification * (stretch ** (-FOAM.densification_exponent - 1.0) - 1.0 / stretch))


def slow_twin(acceleration, start, times):
    """The mass on the foam in Bouc and Wen's form, by DOP853 in steps of at most 0.1 ms."""

    def rates(time, state):
        force = foam_force(state[0])
        power = force * state[1]
        pushed = MASS * (GRAVITY + acceleration(time)) - force * (1.0 + SHARE * state[2])
        return [state[1], pushed / MASS, (power - abs(power) * state[2]) / ENERGY]

    found = solve_ivp(rates, (0.0, times[-1]), start, "DOP853", times, rtol=1e-10, atol=1e-12, max_step=1e-4)
    return found.y.T


@pytest.mark.parametrize("amplitude", [0.5, 1.5])
def test_a_back_on_foam_moves_as_its_slow_twin(amplitude):
    rig, shaking = one_mass(FOAM, None, memory=(SHARE, ENERGY)), sine(amplitude * GRAVITY, 5.25)
    times = numpy.arange(1000) / 1000.0
    found = driven(rig, shaking, 1.0, 1e-10, rate=20_000, sample_every=20)
    expected = slow_twin(shaking, [found.states[0, 0], 0.0, 0.0], times)
    assert (found.forces[:, columns.NORMAL] == 0.0).any() == (amplitude > 1.0)
    # straight pieces of the shaking leave 3.5e-7 m at the larger amplitude
    assert numpy.abs(found.states[:, 0] - expected[:, 0]).max() <= 1e-6
    memory = found.states[:, memory_offset(1, 1)]
    assert numpy.abs(memory - expected[:, 2]).max() <= 1e-4
    assert memory.max() > 0.9
    assert memory.min() < -0.9


def test_the_energy_of_a_back_on_foam_balances_with_loss_of_both_kinds():
    rig = one_mass(FOAM, NormalDissipative(0.5), memory=(SHARE, ENERGY))
    found = driven(rig, sine(1.5 * GRAVITY, 5.25), 2.0, 1e-9)
    assert len(found.episodes["end"]) >= 5
    assert abs(found.residual) <= 1e-7 * found.supplied


def test_a_slow_slap_on_foam_returns_what_the_hysteresis_leaves():
    """Of a long loading the share 2 s/(1 + s) is lost, here with U >> u_0 and no other loss."""
    rig = one_mass(FOAM, None, preload=0.0, memory=(SHARE, 1e-3))
    start = numpy.zeros(8)
    start[:2] = -0.001, 0.5
    found = driven(rig, lambda t: 0.0, 1.0, 1e-9, start=start)
    restitution = numpy.sqrt(found.episodes["opening"] / found.episodes["closing"])
    taken = 0.5 * MASS * 0.25
    assert found.episodes["closing"] == pytest.approx([taken], rel=1e-6)
    assert restitution == pytest.approx([numpy.sqrt((1.0 - SHARE) / (1.0 + SHARE))], rel=1e-3)
