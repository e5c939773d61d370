"""Named occupants in the rig: free simulation against closed forms, and against a twin by scipy."""

import math

import numpy
import pytest
import scipy.signal
from tests.run.scenes import resolved

from contact_sim_lab.rigs.vehicle.scene_drive import drive_of, fast_run, slow_run
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, EnergyLedger
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.seat.biodynamics import apparent_mass, seat_to_head
from contact_sim_pkg.rigs.vehicle.seat.occupants import OCCUPANTS, SEATED_MASS, OccupantModel, scaled, softened
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of

LINEAR = (
    "effects.seat={normal_elastic: {coefficient: 5e4, exponent: 1}, "
    "general_dissipative: {coefficient: 500, approach_exponent: 0, rate_exponent: 1}}"
)
HEADS = [name for name, model in OCCUPANTS.items() if model.head is not None]
SWUNG_IN = 4.0  # [s]; the slowest mode decays by e^-30 in it


def sine(frequency, amplitude):
    return f"vibration={{kind: sine, frequency: {frequency}, amplitude: {amplitude}}}"


def phasors(found, frequency, period):
    """Complex amplitudes of force, seat acceleration and head acceleration (None without a head)."""
    force = numpy.concatenate([record.normal for record in records_of(found, "seat/force")])
    motions = records_of(found, "bench/motion")
    acceleration = numpy.hstack([record.acceleration for record in motions])
    time = numpy.arange(len(force)) * period
    first = len(force) - round(2.0 / period)  # whole cycles of 0.5 Hz and its multiples
    turning = numpy.exp(-2j * math.pi * frequency * time[first:])
    return 2.0 * (force[first:] * turning).mean(), 2.0 * (acceleration[:, first:] * turning).mean(axis=1)


def shaken(name, frequency, *values):
    """Apparent mass [kg] and head over seat [1] (0 without a head) of a named occupant on a linear seat."""
    found = outputs_of(
        "seat_ride",
        SWUNG_IN + 2.0,
        f"seat.occupant.model={name}",
        sine(frequency, 0.5),
        "accuracy=1e-3",
        LINEAR,
        *values,
    )
    period = records_of(found, "seat/force")[0].sample_period
    force, motion = phasors(found, frequency, period)
    head = OCCUPANTS[name].head
    return force / motion[1], motion[1 + head] / motion[1] if head else 0.0


def test_a_link_so_stiff_that_it_is_rigid_leaves_no_noise_in_the_acceleration_of_the_frame():
    """A damper c moves its ends together but for the rate of its force over c, here 2e-3 m/s^2."""
    own = "seat.occupant={model: own, frame_mass: 6.7, masses: [33.4], stiffness: [35776], damping: [1.0e+6]}"
    found = outputs_of("seat_ride", 0.2, own)
    _floor, frame, body = numpy.hstack([record.acceleration for record in records_of(found, "bench/motion")])
    force = max(float(record.normal.max()) for record in records_of(found, "seat/force"))
    assert float(numpy.abs(frame - body).max()) < 3e-3 * force / 6.7


@pytest.mark.parametrize("name", OCCUPANTS)
@pytest.mark.parametrize("frequency", [2.0, 4.0, 5.0, 8.0, 16.0])
def test_a_named_occupant_has_its_apparent_mass_and_its_way_to_the_head_in_free_simulation(name, frequency):
    mass, head = shaken(name, frequency)
    expected = apparent_mass(OCCUPANTS[name], frequency)[0]
    assert abs(mass) == pytest.approx(abs(expected), rel=5e-3)
    assert math.degrees(abs(numpy.angle(mass / expected))) < 1.0
    if name in HEADS:
        expected = seat_to_head(OCCUPANTS[name], frequency)[0]
        assert abs(head) == pytest.approx(abs(expected), rel=5e-3)
        assert math.degrees(abs(numpy.angle(head / expected))) < 1.0


@pytest.mark.parametrize("percentile", SEATED_MASS)
def test_a_percentile_scales_the_apparent_mass_in_free_simulation(percentile):
    mass, _head = shaken("wei_griffin_2", 4.0, f"seat.occupant.percentile={percentile}")
    expected = apparent_mass(scaled(OCCUPANTS["wei_griffin_2"], SEATED_MASS[percentile]), 4.0)[0]
    assert mass == pytest.approx(expected, rel=5e-3)


LAWS = {
    "loss": "{normal_elastic: {}, normal_dissipative: {damping: 0.5}}",
    "no loss": "{normal_elastic: {}}",
    "general law": "{normal_elastic: {}, general_dissipative: {coefficient: 900, approach_exponent: 0.5, rate_exponent: 1.5}}",
    "general law, pulling": "{normal_elastic: {}, general_dissipative: {coefficient: 900, approach_exponent: 0, end: gap}}",
}
LIFTED = "vibration={kind: half_sine, axis: z, amplitude: -40, duration: 0.1, start: 0.05}"


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("name", ["wan_schimmels", "boileau_rakheja", "iso_5982"])
def test_an_occupant_follows_its_twin_through_lift_off_and_landing(name, law):
    scene = resolved("seat_ride", f"seat.occupant.model={name}", LIFTED, f"effects.seat={LAWS[law]}")
    drive = drive_of(scene, 0.6)
    asked = float(scene.data["integrator"]["relative_tolerance"])
    states, forces = fast_run(drive, drive.model.scale * (1e-10 / asked))
    assert (forces[:, 4] == 0.0).sum() > 50, "the occupant does not leave the seat"
    assert forces[-100:, 4].max() > 200.0, "it does not come back"
    count = len(drive.model.rig.seat.masses)
    heights = [
        *range(count),
        *range(count + 1, 2 * count),
    ]  # but the speed of a massless interface, of no account there
    assert states[:, heights] == pytest.approx(slow_run(drive)[:-1, heights], abs=1e-7)


@pytest.mark.parametrize("name", OCCUPANTS)
def test_energy_is_kept_through_lift_off_and_landing(name):
    found = outputs_of(
        "seat_drop", 0.8, f"seat.occupant.model={name}", "integrator.relative_tolerance=1e-7",
        "effects.seat.friction={}",
    )  # fmt: skip
    assert min(record.normal.min() for record in records_of(found, "seat/force")) == 0.0
    ledger = records_of(found, "bench/energy")[-1]
    assert isinstance(ledger, EnergyLedger)
    assert abs(ledger.residual) <= 1e-5 * max(abs(ledger.supplied), ledger.dissipated)


def test_at_rest_a_chain_stands_as_its_springs_are_pressed():
    law = f"effects.seat={LAWS['no loss']}"
    found = outputs_of("seat_ride", 0.05, "seat.occupant.model=boileau_rakheja", sine(5.0, 0.0), law)
    (first, *_rest) = records_of(found, "bench/motion")
    assert isinstance(first, BodyMotion)
    masses, springs = (12.78, 8.62, 28.49, 5.31), (90000.0, 162800.0, 183000.0, 310000.0)
    pressed = [GRAVITY * sum(masses[i:]) / spring for i, spring in enumerate(springs)]
    seat = -((GRAVITY * 55.2 / 2.73e5) ** (2.0 / 3.0))
    assert first.position[1:, 0] == pytest.approx(seat - numpy.cumsum([0.0, *pressed]), rel=1e-9)
    assert abs(first.acceleration[1:]).max() < 1e-6
    force = records_of(found, "seat/force")[0]
    assert isinstance(force, ContactForce)
    assert force.normal == pytest.approx(GRAVITY * 55.2, rel=1e-9)


SOFT = "{exponent: 0.195, time_constant: 0.5}"


@pytest.mark.parametrize(("frequency", "amplitude"), [(4.0, 1.0), (8.0, 2.0), (6.0, 0.2)])
def test_a_softening_occupant_is_the_linear_one_of_its_running_rms(frequency, amplitude):
    """Of a steady sine the mean square stands (but for a ripple), and with it the springs."""
    found = outputs_of(
        "seat_ride", 12.0, sine(frequency, amplitude), "accuracy=1e-3", LINEAR[:-1] + f", softening: {SOFT}}}"
    )
    period = records_of(found, "seat/force")[0].sample_period
    force, motion = phasors(found, frequency, period)
    rms = min(max(abs(motion[1]) / math.sqrt(2.0), 0.25), 2.5)
    soft = softened(OCCUPANTS["wei_griffin_2"], rms, 0.195)
    assert force / motion[1] == pytest.approx(apparent_mass(soft, frequency)[0], rel=0.02)


def test_a_softening_occupant_keeps_its_energy_and_its_weight():
    vibration = "vibration={kind: noise, low: 0.5, high: 20, rms: 2.0}"
    found = outputs_of(
        "seat_ride", 4.0, vibration, "integrator.relative_tolerance=1e-7",
        f"effects.seat.softening={SOFT}", "seat.occupant.model=iso_5982",
    )  # fmt: skip
    ledger = records_of(found, "bench/energy")[-1]
    assert isinstance(ledger, EnergyLedger)
    assert abs(ledger.residual) <= 1e-6 * ledger.dissipated
    first = records_of(found, "seat/force")[0]
    assert first.normal[0] == pytest.approx(55.0 * GRAVITY, rel=1e-9)


def test_an_occupant_without_softening_has_none():
    assert build(resolved("seat_ride")).rig.seat.softening is None
    softened = build(resolved("seat_ride", "effects.seat.softening={}")).rig.seat.softening
    assert (softened.exponent, softened.time_constant, softened.least, softened.most) == (0.195, 5.0, 0.25, 2.5)


def test_a_users_own_occupant_arrives_as_given():
    given = (
        "{model: own, frame_mass: 1.5, masses: [40, 8], links: [[0, 1], [1, 2]], stiffness: [4e4, 5e4], "
        "damping: [900, 90], head: 2}"
    )
    made = build(resolved("seat_ride", f"seat.occupant={given}"))
    assert made.occupant == OccupantModel((1.5, 40.0, 8.0), ((0, 1, 4e4, 900.0), (1, 2, 5e4, 90.0)), 2, "own")
    assert made.rig.seat.masses.tolist() == [1.5, 40.0, 8.0]
    assert made.rig.seat.ends.tolist() == [[0, 1], [1, 2]]
    assert made.rig.seat.springs.tolist() == [[4e4, 5e4], [900.0, 90.0]]
    assert made.rig.seat.node is None
    assert build(resolved("seat_ride", "seat.occupant.model=wan_schimmels")).rig.seat.node.damping == 2475.0


BAND = numpy.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0])  # [Hz]


def signals(name, duration, vibration):
    """Force [N] less its mean, accelerations [m/s^2] of seat and head (None without one) and sample rate [Hz]."""
    found = outputs_of("seat_ride", duration, f"seat.occupant.model={name}", vibration, "accuracy=1e-3", LINEAR)
    force = numpy.concatenate([record.normal for record in records_of(found, "seat/force")])
    motions = records_of(found, "bench/motion")
    acceleration = numpy.hstack([record.acceleration for record in motions])
    head = OCCUPANTS[name].head
    moved = acceleration[1 + head] if head else None
    return force - force[0], acceleration[1], moved, 1.0 / motions[0].sample_period


def assert_within_half_a_per_cent_and_a_degree(found, expected):
    assert abs(found) == pytest.approx(abs(expected), rel=5e-3)
    assert numpy.degrees(abs(numpy.angle(found / expected))).max() < 1.0


@pytest.mark.parametrize("name", OCCUPANTS)
def test_by_a_sweep_a_named_occupant_has_its_responses(name):
    """The sweep ends and the occupant comes to rest: the quotient of both transforms is the response, without leakage."""
    force, seat, head, rate = signals(
        name, 30.0, "vibration={kind: sweep, start_frequency: 0.5, end_frequency: 22, amplitude: 0.5, duration: 24}"
    )
    assert abs(seat[-100:]).max() < 1e-6
    at = numpy.round(BAND * len(seat) / rate).astype(int)
    transformed = numpy.fft.rfft(seat)[at]
    frequency = at * rate / len(seat)
    assert_within_half_a_per_cent_and_a_degree(
        numpy.fft.rfft(force)[at] / transformed, apparent_mass(OCCUPANTS[name], frequency)
    )
    if head is not None:
        found = numpy.fft.rfft(head)[at] / transformed
        assert_within_half_a_per_cent_and_a_degree(found, seat_to_head(OCCUPANTS[name], frequency))


@pytest.mark.parametrize("name", ["wei_griffin_2", "boileau_rakheja"])
def test_by_noise_a_named_occupant_has_its_responses_with_coherence(name):
    """Welch's method in segments of 16 s, whose Hann window hides little of a resonance 1 Hz wide."""
    force, seat, head, rate = signals(name, 160.0, "vibration={kind: noise, low: 0.5, high: 20, rms: 1.0}")
    length = round(16.0 * rate)
    for target, response in ((force, apparent_mass), (head, seat_to_head)):
        if target is None:
            continue
        frequency, power = scipy.signal.welch(seat, rate, nperseg=length)
        _, cross = scipy.signal.csd(seat, target, rate, nperseg=length)
        _, coherence = scipy.signal.coherence(seat, target, rate, nperseg=length)
        at = numpy.searchsorted(frequency, BAND)
        assert coherence[at].min() > 0.95
        found = cross[at] / power[at]
        expected = response(OCCUPANTS[name], frequency[at])
        assert abs(found) == pytest.approx(abs(expected), rel=1e-2)
        assert numpy.degrees(abs(numpy.angle(found / expected))).max() < 1.0
