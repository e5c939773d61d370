"""The backrest rig against closed forms, and against scipy on its slow twins."""

import math

import numpy
import pytest
from tests.rigs.backrest.backrest_runs import FRICTION, GRAVITY, LAW, LOSS, MASS, driven, one_mass, sine
from tests.run.scenes import FRICTIONLESS, resolved

from contact_sim_lab.rigs.backrest.twin import (
    SlappingMass,
    SlappingPoints,
    slapping_mass,
    slapping_normal,
    slapping_points,
    sliding_friction,
)
from contact_sim_pkg.laws.parameters import Friction, GeneralDissipative, NormalElastic
from contact_sim_pkg.laws.restitution import damping_of_restitution
from contact_sim_pkg.rigs.backrest import entries as columns
from contact_sim_pkg.rigs.backrest.model import build_backrest, resting_state

SPINE = (4.75, 5.25, 5.75, 6.25)  # [Hz]
KELVIN_VOIGT = GeneralDissipative(1360.0, 0.0, 1.0, 0.0, -math.inf)
LINEAR = NormalElastic(4.5e4, 1.0)


def transmissibility(frequency):
    """T = S/(S - w^2 M), S = k + i w c."""
    w = 2.0 * math.pi * frequency
    stiffness = LINEAR.coefficient + 1j * w * KELVIN_VOIGT.coefficient
    return stiffness / (stiffness - w**2 * MASS)


def shell(*values):
    """The scene's back as a shell, without friction."""
    scene = resolved("seat_slap", *FRICTIONLESS, "effects.backrest.shell_modes={}", "backrest.preload=20", *values)
    return build_backrest(scene).rig


@pytest.mark.parametrize(("frequency", "amplitude"), [(4.75, 1.5), (5.75, 1.5), (6.25, 1.5), (6.25, 0.9)])
def test_friction_at_a_slapping_back_is_that_of_small_steps(frequency, amplitude):
    """The load falls while the sliding turns round: the force passes from one side of the limit to the other without a jump."""
    drive, speed = amplitude * GRAVITY, 2.0 * math.pi * frequency
    body = SlappingMass(MASS, MASS * GRAVITY, drive, frequency, LAW.coefficient, LAW.exponent, LOSS.damping)
    step = 2e-6
    times = numpy.arange(250_001) * step
    normal = slapping_normal(body, times)
    velocity = 0.01 * speed * numpy.cos(speed * times)
    law = (FRICTION.coefficient_kinetic, FRICTION.stiffness, FRICTION.damping)
    expected = sliding_friction(normal, velocity, step, *law)[100::100]  # each 0.2 ms, without the first instant
    rig = one_mass(friction=FRICTION, amplitude=0.01, frequency=frequency)
    found = driven(rig, sine(drive, frequency), 0.5, 1e-9, rate=20_000, sample_every=4).forces[:, columns.TANGENTIAL]
    assert found[1:] == pytest.approx(-expected[: len(found) - 1], abs=0.05)


@pytest.mark.parametrize("frequency", SPINE)
def test_the_linear_limit_has_the_closed_transmissibility_while_contact_holds(frequency):
    drive = 0.3 * GRAVITY
    found = driven(one_mass(LINEAR, KELVIN_VOIGT), sine(drive, frequency), 8.0)
    assert found.forces[:, columns.NORMAL].min() > 0.0
    window = slice(4000, 8000)  # a whole number of periods at all four
    time = numpy.arange(8000) / 1000.0
    occupant = (found.forces[:, columns.NORMAL] / MASS - GRAVITY)[window]  # acceleration of the mass, forward
    wave = 2.0 * numpy.mean(occupant * numpy.exp(-2j * math.pi * frequency * time[window]))
    measured = wave / (-1j * drive)
    assert measured == pytest.approx(transmissibility(frequency), rel=5e-3)


@pytest.mark.parametrize("frequency", SPINE)
def test_a_linear_back_lifts_off_when_the_mass_reaches_g_downwards(frequency):
    seat = GRAVITY / abs(transmissibility(frequency))
    for factor, lifts in ((0.995, False), (1.005, True)):
        found = driven(one_mass(LINEAR, KELVIN_VOIGT), sine(factor * seat, frequency), 6.0)
        assert (found.forces[4000:, columns.NORMAL].min() <= 0.0) == lifts


@pytest.mark.parametrize(("frequency", "seat"), [*zip(SPINE, (0.73, 0.87, 1.07, 1.32), strict=True)])
def test_a_back_after_the_power_law_lifts_off_at_the_tabled_amplitude(frequency, seat):
    for factor, lifts in ((0.99, False), (1.01, True)):
        found = driven(one_mass(), sine(factor * seat * GRAVITY, frequency), 6.0, 1e-7)
        assert (found.forces[4000:, columns.NORMAL].min() <= 0.0) == lifts


@pytest.mark.parametrize(("frequency", "amplitude"), [(5.25, 1.5), (4.75, 1.2), (6.25, 2.0)])
def test_touches_and_losses_fall_on_the_instants_that_scipy_finds(frequency, amplitude):
    body = SlappingMass(
        MASS, MASS * GRAVITY, amplitude * GRAVITY, frequency, LAW.coefficient, LAW.exponent, LOSS.damping
    )
    expected = slapping_mass(body, 2.0)
    found = driven(one_mass(), sine(amplitude * GRAVITY, frequency), 2.0, 1e-11, rate=20_000, sample_every=20)
    ended = len(found.episodes["end"])
    assert ended >= 7
    assert found.end[:2] == pytest.approx(expected.end, abs=1e-6)
    touches = expected.touches[[numpy.abs(expected.touches - t).argmin() for t in found.episodes["start"][1:]]]
    losses = expected.losses[[numpy.abs(expected.losses - t).argmin() for t in found.episodes["end"]]]
    assert found.episodes["start"][1:] == pytest.approx(touches, abs=1e-7)
    assert found.episodes["end"] == pytest.approx(losses, abs=1e-7)
    apart = (found.forces[:, columns.NORMAL] == 0.0).mean()
    edges = numpy.concatenate([expected.touches, [2.0]])[: len(expected.losses)]
    assert apart == pytest.approx((edges - expected.losses).sum() / 2.0, abs=2e-3)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8, 1e-10])
@pytest.mark.parametrize("friction", [None, FRICTION])
def test_the_energy_of_slaps_and_slips_balances_to_the_requested_tolerance(friction, tolerance):
    found = driven(one_mass(friction=friction, amplitude=0.01), sine(1.5 * GRAVITY, 5.25), 2.0, tolerance)
    assert abs(found.residual) <= 10.0 * tolerance * found.supplied


@pytest.mark.parametrize("asked", [0.05, 0.3, 0.6, 0.9, 0.98])
def test_the_restitution_of_a_free_slap_is_the_ratio_of_speeds_and_the_requested_one(asked):
    speed = 0.5
    loss = LOSS._replace(damping=damping_of_restitution(asked, speed))
    rig = one_mass(loss=loss, preload=0.0)
    start = resting_state(rig)
    start[:2] = -0.01, speed
    found = driven(rig, lambda t: 0.0, 0.6, 1e-12, start)
    (closing,), (opening,) = found.episodes["closing"], found.episodes["opening"]
    assert math.sqrt(opening / closing) == pytest.approx(-found.end[1] / speed, abs=1e-9)
    assert math.sqrt(opening / closing) == pytest.approx(asked, abs=1e-9)


def test_the_largest_approach_of_a_free_slap_is_the_closed_one():
    """Depth of a free slap: A x^(n+1)/(n+1) = m (v0/l - ln(1 + l v0)/l^2), kept here in its own numbers."""
    rig = one_mass(preload=0.0)
    start = resting_state(rig)
    start[:2] = -1e-3, 0.5
    found = driven(rig, lambda t: 0.0, 0.5, 1e-12, start)
    rate = LOSS.damping
    stored = MASS * (0.5 / rate - math.log1p(0.5 * rate) / rate**2)
    deepest = (stored * (LAW.exponent + 1.0) / LAW.coefficient) ** (1.0 / (LAW.exponent + 1.0))
    assert found.episodes["deepest"] == pytest.approx([deepest], rel=1e-9)


@pytest.mark.parametrize("slides", [0.008, 0.010, 0.02])
def test_a_sliding_back_encloses_the_loop_of_coulomb_friction(slides):
    """Dissipation without damper: 4 mu N (X - mu N/C) a period."""
    friction = Friction(3.19e4, 0.0, 0.4, 0.4)
    found = driven(one_mass(friction=friction, amplitude=slides, frequency=5.0), lambda t: 0.0, 1.0, 1e-10)
    period = found.points[-400:, 0]
    force, place = -period[:, columns.POINT_TANGENTIAL], period[:, columns.POINT_DISPLACEMENT]
    loop = float(numpy.sum(0.5 * (force + numpy.roll(force, -1)) * (numpy.roll(place, -1) - place))) / 2.0
    limit = 0.4 * MASS * GRAVITY
    assert loop == pytest.approx(4.0 * limit * (slides - limit / friction.stiffness), rel=2e-3)


def test_a_back_that_slides_less_than_its_spring_gives_sticks():
    friction = Friction(3.19e4, 0.0, 0.4, 0.4)
    found = driven(one_mass(friction=friction, amplitude=0.005), lambda t: 0.0, 1.0, 1e-10)
    rows = found.points[:, 0]
    assert rows[:, columns.POINT_STATE] == pytest.approx(columns.STICKS)
    spring = -friction.stiffness * rows[:, columns.POINT_DISPLACEMENT]
    assert rows[:, columns.POINT_TANGENTIAL] == pytest.approx(spring, abs=1e-6)


@pytest.mark.parametrize("modes", [1, 4, 9])
def test_a_slapping_shell_moves_as_its_slow_twin(modes):
    small = ("effects.backrest.shell_modes.points_up=8", "effects.backrest.shell_modes.points_across=6")
    rig = shell(f"effects.backrest.shell_modes.modes={modes}", *small)
    times = numpy.arange(500) / 1000.0
    shaking = sine(1.5 * GRAVITY, 5.25)
    found = driven(rig, shaking, 0.5, 1e-10, size=1e-3, rate=40_000, sample_every=40)
    body = SlappingPoints(*rig.modal, rig.shapes, rig.gaps, rig.shares, LAW.coefficient, LAW.exponent, LOSS.damping)
    expected = slapping_points(body, resting_state(rig)[: 2 * modes], shaking, times)
    assert (found.forces[:, columns.NORMAL] == 0.0).any(), "the shell does not leave the seat back"
    error = numpy.abs(found.states[:, :modes] - expected[:, :modes]).max()
    assert error <= 2e-6 * numpy.abs(expected[:, :modes]).max()


@pytest.mark.parametrize("modes", [1, 9, 25])
def test_the_energy_of_a_slapping_and_slipping_shell_balances(modes):
    rig = shell(
        f"effects.backrest.shell_modes.modes={modes}", "effects.backrest.shell_modes.points_up=8",
        "effects.backrest.shell_modes.points_across=6", "effects.backrest.friction={}", "backrest.sliding.amplitude=0.01",
    )  # fmt: skip
    found = driven(rig, sine(1.5 * GRAVITY, 5.25), 0.5, 1e-8, size=1e-3)
    assert len(found.episodes["end"]) >= 2
    assert abs(found.residual) <= 1e-6 * found.supplied


def test_a_shell_at_rest_bends_as_the_modes_say_where_nothing_touches():
    rig = shell(
        "backrest.back.radius_across=0.25",
        "backrest.back.radius_up=0.32",
        "effects.backrest.normal_elastic.coefficient=1",
    )
    q = resting_state(rig)[: len(rig.mass)]
    assert rig.stiffness * q == pytest.approx(rig.preload, rel=1e-3)
    assert (rig.shapes @ q - rig.gaps).max() > 0.0


def test_a_shell_at_rest_holds_its_preload():
    rig = shell()
    found = driven(rig, lambda t: 0.0, 0.05, 1e-9, size=1e-3)
    q = resting_state(rig)[: len(rig.mass)]
    assert found.end[: len(q)] == pytest.approx(q, abs=1e-12)
    carried = found.points[0, :, columns.POINT_NORMAL]
    assert rig.shapes.T @ carried == pytest.approx(rig.preload - rig.stiffness * q, abs=1e-9)
