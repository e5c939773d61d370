"""Foam: the law against Hill's energy in many digits, the memory against its closed loop, and an occupant on both against scipy."""

import itertools
import math

import mpmath
import numpy
import pytest
from scipy.integrate import solve_ivp

from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_lab.rigs.vehicle.scene_drive import drive_of, fast_run
from contact_sim_lab.twins import impact
from contact_sim_pkg.laws.elastic_law import (
    approach_of_force,
    elastic_energy,
    elastic_force,
    elastic_order,
    elastic_stiffness,
)
from contact_sim_pkg.laws.foam_hysteresis import (
    hysteresis_energy,
    hysteresis_factor,
    hysteresis_factor_rate,
    hysteresis_rate,
)
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.parameters import FoamElastic, FoamHysteresis, NormalDissipative, NormalElastic
from contact_sim_pkg.rigs.vehicle.motion.entries import energies
from contact_sim_pkg.scene.resolve import load_resolved

FOAM = FoamElastic(0.12, 0.08, 4.0e4, 3.0e3, 150.0, 3.0)
STRAINS = (1e-6, 1e-3, 0.05, 0.2, 0.4, 0.65, 0.9, 0.99)


def hill_energy(foam, strain):
    """Two terms of Hill's hyperfoam at nu = 0: 2 mu_i = p_i a_i, a_1 = E_0/p_0, a_2 = -r; lateral stretches 1, J = l."""
    l = 1 - mpmath.mpf(strain)  # noqa: E741
    total = mpmath.mpf(0)
    for stress, a in (
        (foam.plateau, mpmath.mpf(foam.modulus) / foam.plateau),
        (foam.densification, -foam.densification_exponent),
    ):
        two_mu = stress * abs(a)
        total += two_mu / a**2 * (l**a - 1 - a * mpmath.log(l))
    return float(foam.area * foam.thickness * total)


@pytest.mark.parametrize("strain", STRAINS)
def test_the_stored_energy_is_that_of_two_terms_of_the_hyperfoam(strain):
    with mpmath.workdps(40):
        exact = hill_energy(FOAM, strain)
    assert elastic_energy(FOAM, strain * FOAM.thickness) == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize("strain", STRAINS)
def test_the_force_is_the_slope_of_the_energy_and_the_stiffness_that_of_the_force(strain):
    with mpmath.workdps(40):
        force = mpmath.diff(lambda e: _hill(e), strain) / FOAM.thickness
        slope = mpmath.diff(lambda e: _hill(e), strain, 2) / FOAM.thickness**2
    x = strain * FOAM.thickness
    assert elastic_force(FOAM, x) == pytest.approx(float(force), rel=1e-11)
    assert elastic_stiffness(FOAM, x) == pytest.approx(float(slope), rel=1e-10)


def _hill(strain):
    l = 1 - strain  # noqa: E741
    a, r = mpmath.mpf(FOAM.modulus) / FOAM.plateau, mpmath.mpf(FOAM.densification_exponent)
    first = FOAM.plateau * (-mpmath.log(l) - (1 - l**a) / a)
    return FOAM.area * FOAM.thickness * (first + FOAM.densification * ((l**-r - 1) / r + mpmath.log(l)))


def test_it_begins_linear_with_the_modulus_and_ends_in_densification():
    assert elastic_order(FOAM) == 1.0
    start = FOAM.area * (FOAM.modulus + 3.0 * 150.0) / FOAM.thickness
    assert elastic_force(FOAM, 1e-9) == pytest.approx(start * 1e-9, rel=1e-6)
    moduli = [elastic_stiffness(FOAM, e * FOAM.thickness) * FOAM.thickness / FOAM.area for e in (0.0001, 0.2, 0.65)]
    assert moduli[1] < 0.4 * moduli[0], "no plateau"
    assert moduli[2] > 3.0 * moduli[0], "no densification"


@pytest.mark.parametrize("approach", [0.0, -0.0, -1e-300, -1.0, -math.inf])
def test_there_is_nothing_without_indentation(approach):
    assert [f(FOAM, approach) for f in (elastic_force, elastic_stiffness, elastic_energy)] == [0.0, 0.0, 0.0]


def test_no_force_closes_the_block_and_beyond_its_thickness_it_stays_finite_and_rises():
    forces = [elastic_force(FOAM, x) for x in (0.0799, 0.08, 0.081, 0.1, 1.0)]
    assert all(math.isfinite(f) for f in forces)
    assert all(later > earlier for earlier, later in itertools.pairwise(forces))


@pytest.mark.parametrize("force", [1e-9, 1.0, 498.0, 2e4, 1e8])
def test_the_approach_of_a_force_is_its_inverse(force):
    assert elastic_force(FOAM, approach_of_force(FOAM, force)) == pytest.approx(force, rel=1e-12)
    assert approach_of_force(FOAM, 0.0) == approach_of_force(FOAM, -1.0) == 0.0


SHARE, ENERGY = 0.2, 0.7
MEMORY = FoamHysteresis(0, SHARE, ENERGY)


def marched(power, z, duration, steps=4000):
    """z after `duration` [s] of a constant elastic power [W], by the kernel's rate and classic Runge-Kutta."""

    def rate(value):
        out = numpy.zeros(1)
        hysteresis_rate(MEMORY, power, numpy.array([value]), out)
        return out[0]

    h = duration / steps
    for _ in range(steps):
        k1 = rate(z)
        k2 = rate(z + 0.5 * h * k1)
        k3 = rate(z + 0.5 * h * k2)
        z += h / 6.0 * (k1 + 2 * k2 + 2 * k3 + rate(z + h * k3))
    return z


def test_the_memory_follows_the_energy_exponentially_and_not_the_time():
    for power in (0.5, 50.0):
        assert marched(power, 0.0, 1.4 / power) == pytest.approx(1.0 - math.exp(-2.0), rel=1e-9)
        assert marched(-power, 0.6, 0.7 / power) == pytest.approx(-1.0 + 1.6 * math.exp(-1.0), rel=1e-9)


def test_factor_rate_and_energy_are_what_the_docstring_says():
    state = numpy.array([0.3])
    out = numpy.zeros(1)
    hysteresis_rate(MEMORY, -4.0, state, out)
    assert out[0] == pytest.approx((-4.0 - 4.0 * 0.3) / ENERGY)
    assert hysteresis_factor(MEMORY, state) == pytest.approx(1.06)
    assert hysteresis_factor_rate(MEMORY, out) == pytest.approx(SHARE * out[0])
    assert hysteresis_energy(MEMORY, state) == pytest.approx(0.5 * SHARE * ENERGY * 0.09)
    assert (hysteresis_factor(None, state), hysteresis_energy(None, state), hysteresis_factor_rate(None, out)) == (
        1.0,
        0.0,
        0.0,
    )


@pytest.mark.parametrize("elastic", [FOAM, NormalElastic(2.73e5, 1.5)])
@pytest.mark.parametrize("depth", [0.003, 0.03])
def test_a_closed_loop_loses_what_its_closed_form_says(elastic, depth):
    """Pressed to `depth` and let go, slowly or fast; the force is integrated over the way by scipy."""

    def work(t, y):
        x, v = depth * math.sin(math.pi * t), depth * math.pi * math.cos(math.pi * t)
        carried, out = elastic_force(elastic, x), numpy.zeros(1)
        hysteresis_rate(MEMORY, carried * v, y[:1], out)
        return [out[0], carried * hysteresis_factor(MEMORY, y[:1]) * v]

    settings = {"rtol": 1e-11, "atol": 1e-13}
    pressed = solve_ivp(work, (0.0, 0.5), [0.0, 0.0], **settings).y[:, -1]
    released = solve_ivp(work, (0.5, 1.0), [pressed[0], 0.0], **settings).y[:, -1]
    u = elastic_energy(elastic, depth)
    faded = 1.0 - math.exp(-u / ENERGY)
    assert pressed[1] == pytest.approx(u + SHARE * (u - ENERGY * faded), rel=1e-8)
    assert -released[1] == pytest.approx(u - SHARE * (u - (1.0 + faded) * ENERGY * faded), rel=1e-8)
    lost = pressed[1] + released[1] - 0.5 * SHARE * ENERGY * released[0] ** 2
    assert lost > 0.0


SHAKEN = "vibration={kind: sine, frequency: 4.0, amplitude: 12.0}"
RIGID = "seat.occupant={frame_mass: 50.0, masses: [], stiffness: [], damping: []}"
ON_FOAM = "effects.seat={normal_elastic: {}, foam: {thickness: 0.1}, foam_hysteresis: {share: 0.15}}"


def test_an_occupant_on_foam_follows_scipy_through_lift_off():
    drive = drive_of(load_resolved("seat_ride", SHAKEN, RIGID, ON_FOAM), 0.6)
    states, forces = fast_run(drive, drive.model.scale * 1e-5)
    foam, memory = drive.model.rig.seat_contact.elastic, drive.model.rig.seat_contact.hysteresis
    assert foam == FoamElastic(0.12, 0.1, 4e4, 3e3, 150.0, 3.0)
    assert memory == FoamHysteresis(2, 0.15, 1.0)
    assert (forces[:, 4] == 0.0).any(), "the occupant does not leave the seat"
    times = numpy.arange(len(drive.acceleration_z)) * drive.segment

    def rate(t, y):
        carried = elastic_force(foam, -y[0])
        power = -carried * y[1]
        force = carried * (1.0 + memory.share * y[2])
        shake = numpy.interp(t, times, drive.acceleration_z)
        return [y[1], force / 50.0 - 9.81 - shake, (power - abs(power) * y[2]) / memory.energy]

    exact = solve_ivp(
        rate, (0.0, times[-2]), drive.start[:3], "DOP853", times[:-1], rtol=1e-9, atol=1e-11, max_step=2e-3
    ).y.T
    assert states[: len(exact), :3] == pytest.approx(exact, abs=2e-5)


def test_the_energy_balance_of_foam_closes_and_what_is_lost_never_decreases():
    scene = load_resolved("seat_ride", SHAKEN, ON_FOAM)
    drive = drive_of(scene, 1.0)
    states, _forces = fast_run(drive, drive.model.scale * 1e-4)
    mode = numpy.zeros(1, dtype=numpy.int64)
    ledger = numpy.array([energies(drive.model.rig, mode, state, 0.0, 0.0) for state in states])
    held = ledger[:, :3].sum(axis=1)
    supplied, lost = ledger[:, 3] - ledger[0, 3], ledger[:, 4] - ledger[0, 4]
    residual = held - held[0] + lost - supplied
    assert numpy.abs(residual).max() < 1e-6 * lost[-1]
    assert lost[-1] > 1.0
    assert numpy.diff(lost).min() > -1e-8 * lost[-1]


@pytest.mark.parametrize("loss", [0.3, 1.43275, 9.0])
def test_the_restitution_of_hunt_crossley_holds_on_foam_as_on_any_elastic_law(loss):
    """v dv/(1 + c v) = -F dx/m: what F is drops out of d (1 + e) = ln[(1 + d)/(1 - d e)]."""
    speed, mass = 0.5, 30.0
    rig = PointContact(mass, 0.0, 0.0, 0.0, FOAM, NormalDissipative(loss / speed))
    scale = numpy.array([0.05, speed]) * 1e-12
    end = integrate(rig, numpy.array([1e-3, -speed]), scale, numpy.array([0.0, 20.0])).states[-1]
    assert end[1] / speed == pytest.approx(impact.restitution(loss), abs=1e-10)
