"""Named occupants: frequency responses against tables of the published models and closed forms."""

import cmath
import math

import mpmath
import numpy
import pytest

from contact_sim_lab.rigs.vehicle.validation_occupant import VALIDATION
from contact_sim_pkg.rigs.vehicle.seat.biodynamics import (
    apparent_mass,
    matrices,
    natural_frequencies,
    rest_deflections,
    ringing_cautions,
    ringing_of,
    seat_to_head,
    seat_transmissibility,
)
from contact_sim_pkg.rigs.vehicle.seat.occupants import (
    OCCUPANTS,
    SEATED_MASS,
    Link,
    OccupantModel,
    scaled,
    softened,
    stiffened,
)

FREQUENCIES = (1.0, 2.0, 4.0, 5.0, 6.3, 8.0, 10.0, 16.0, 20.0)
# Apparent mass [kg] and its phase [degrees] at FREQUENCIES, computed apart from this project.
APPARENT_MASS = {
    "wei_griffin_1": (
        (52.9, 57.7, 68.4, 65.7, 54.7, 41.0, 30.8, 18.3, 15.0),
        (0, -3, -23, -37, -52, -61, -65, -61, -56),
    ),
    "wei_griffin_2": (
        (52.2, 56.6, 74.6, 75.8, 57.8, 43.2, 35.8, 17.0, 12.7),
        (0, -2, -19, -38, -57, -62, -70, -76, -68),
    ),
    "iso_5982": (
        (57.4, 64.2, 75.0, 68.6, 55.7, 42.3, 32.4, 18.8, 14.7),
        (-1, -5, -31, -46, -60, -69, -75, -79, -78),
    ),
    "boileau_rakheja": (
        (57.3, 63.7, 87.5, 88.6, 68.6, 45.1, 30.9, 16.1, 12.5),
        (0, -3, -25, -48, -72, -86, -90, -89, -87),
    ),
    "wan_schimmels": (
        (63.6, 70.8, 78.9, 73.8, 63.1, 50.0, 38.7, 19.9, 14.6),
        (-1, -6, -30, -43, -57, -68, -77, -86, -80),
    ),
}
SEAT_TO_HEAD = {
    "iso_5982": (
        (1.033, 1.123, 1.327, 1.349, 1.276, 1.113, 0.941, 0.648, 0.524),
        (0, -3, -19, -31, -45, -59, -71, -96, -111),
    ),
    "boileau_rakheja": (
        (1.043, 1.179, 1.696, 1.759, 1.401, 0.951, 0.670, 0.375, 0.308),
        (0, -3, -28, -52, -78, -96, -105, -118, -125),
    ),
    "wan_schimmels": (
        (1.052, 1.182, 1.371, 1.324, 1.194, 1.040, 0.933, 0.861, 0.739),
        (-1, -6, -30, -44, -57, -70, -81, -120, -155),
    ),
}
HEADS = {"seat to head": SEAT_TO_HEAD, "apparent mass": APPARENT_MASS}


@pytest.mark.parametrize(
    ("response", "name"), [(response, name) for response, table in HEADS.items() for name in table]
)
def test_the_responses_of_a_named_occupant_are_those_of_its_table(response, name):
    magnitude, phase = HEADS[response][name]
    found = (seat_to_head if response == "seat to head" else apparent_mass)(OCCUPANTS[name], FREQUENCIES)
    assert abs(found) == pytest.approx(magnitude, rel=5e-3)
    assert numpy.degrees(numpy.angle(found)) == pytest.approx(phase, abs=1.0)


@pytest.mark.parametrize(
    ("name", "kilograms"),
    [("wei_griffin_1", 51.2), ("wei_griffin_2", 50.8), ("iso_5982", 55.0), ("boileau_rakheja", 55.2),
     ("wan_schimmels", 60.67), ("inert_75", 75.0)],
)  # fmt: skip
def test_at_rest_an_occupant_weighs_the_sum_of_its_masses(name, kilograms):
    assert OCCUPANTS[name].mass == pytest.approx(kilograms)
    assert apparent_mass(OCCUPANTS[name], 1e-4)[0] == pytest.approx(kilograms, rel=1e-6)


@pytest.mark.parametrize(
    ("name", "modes"),
    [("wei_griffin_1", (5.07,)), ("wei_griffin_2", (5.21, 9.53)), ("iso_5982", (4.51, 5.57, 24.3)),
     ("boileau_rakheja", (5.11, 18.6, 35.4, 42.5)), ("wan_schimmels", (4.43, 12.4, 19.4, 34.0))],
)  # fmt: skip
def test_natural_frequencies_of_a_named_occupant(name, modes):
    assert natural_frequencies(OCCUPANTS[name]) == pytest.approx(modes, rel=3e-3)


@pytest.mark.parametrize(
    ("name", "peak", "frequency"), [("iso_5982", 1.351, 4.77), ("boileau_rakheja", 1.781, 4.68), ("wan_schimmels", 1.371, 3.98)]
)  # fmt: skip
def test_peak_of_the_seat_to_head_transmissibility(name, peak, frequency):
    at = numpy.arange(2.0, 8.0, 0.01)
    found = abs(seat_to_head(OCCUPANTS[name], at))
    assert found.max() == pytest.approx(peak, rel=1e-3)
    assert at[found.argmax()] == pytest.approx(frequency, abs=0.02)


def test_one_mass_by_hand():
    """M = m_0 + m (k + i w c) / (k + i w c - w^2 m)."""
    for frequency in (0.7, 4.15, 12.0):
        w = 2.0 * math.pi * frequency
        link = 44115.0 + 1j * w * 1485.0
        by_hand = 7.8 + 43.4 * link / (link - w**2 * 43.4)
        assert apparent_mass(OCCUPANTS["wei_griffin_1"], frequency)[0] == pytest.approx(by_hand, rel=1e-12)


@pytest.mark.parametrize("frequency", [1.0, 5.0, 18.6, 60.0])
def test_a_chain_link_by_link_in_fifty_digits(frequency):
    """From the head down: what hangs on a link has the apparent mass M L/(L - w^2 M), L = k + i w
    c, plus the mass below; the head moves by the product of L/(L - w^2 M).
    """
    model = OCCUPANTS["boileau_rakheja"]
    with mpmath.workdps(50):
        w, hanging, head = 2 * mpmath.pi * frequency, mpmath.mpf(0), mpmath.mpf(1)
        for mass, link in zip(reversed(model.masses[1:]), reversed(model.links), strict=True):
            hanging, stiff = hanging + mass, link.stiffness + 1j * w * link.damping
            ratio = stiff / (stiff - w**2 * hanging)
            hanging, head = hanging * ratio, head * ratio
        assert apparent_mass(model, frequency)[0] == pytest.approx(complex(hanging), rel=1e-11)
        assert seat_to_head(model, frequency)[0] == pytest.approx(complex(head), rel=1e-11)


def test_a_closed_loop_by_cramers_rule():
    """Wan and Schimmels: five equations of motion, written out, solved by determinants."""
    at, w = 7.0, 2.0 * math.pi * 7.0
    seat, viscera, abdomen, spine, neck = (
        k + 1j * w * c for k, c in ((49340, 2475), (20000, 330), (10000, 200), (192000, 909.1), (134400, 250))
    )
    rows = mpmath.matrix([
        [seat + viscera + spine - 36 * w**2, -viscera, -spine, 0],
        [-viscera, viscera + abdomen - 5.5 * w**2, -abdomen, 0],
        [-spine, -abdomen, abdomen + spine + neck - 15 * w**2, -neck],
        [0, 0, -neck, neck - 4.17 * w**2],
    ])  # fmt: skip
    pelvis, head = rows.copy(), rows.copy()
    for row in range(4):
        pelvis[row, 0] = head[row, 3] = seat if row == 0 else 0
    whole = mpmath.det(rows)
    on_seat = seat * (1 - mpmath.det(pelvis) / whole)
    model = OCCUPANTS["wan_schimmels"]
    assert apparent_mass(model, at)[0] == pytest.approx(complex(-on_seat / w**2), rel=1e-11)
    assert seat_to_head(model, at)[0] == pytest.approx(complex(mpmath.det(head) / whole), rel=1e-11)


@pytest.mark.parametrize(
    ("stiffness", "damping", "peak", "frequency", "at_10_hz", "at_20_hz"),
    [(20e3, 1000.0, 1.463, 2.41, 0.333, 0.401), (30e3, 300.0, 2.913, 3.16, 0.232, 0.211),
     (50e3, 500.0, 2.109, 3.62, 0.359, 0.320), (75e3, 500.0, 1.850, 4.00, 0.487, 0.392)],
)  # fmt: skip
def test_a_linear_seat_under_the_two_mass_occupant(stiffness, damping, peak, frequency, at_10_hz, at_20_hz):
    at = numpy.arange(1.0, 8.0, 0.01)
    found = abs(seat_transmissibility(OCCUPANTS["wei_griffin_2"], at, stiffness, damping))
    assert found.max() == pytest.approx(peak, rel=2e-3)
    assert at[found.argmax()] == pytest.approx(frequency, abs=0.03)
    high = abs(seat_transmissibility(OCCUPANTS["wei_griffin_2"], (10.0, 20.0), stiffness, damping))
    assert high == pytest.approx((at_10_hz, at_20_hz), rel=5e-3)


@pytest.mark.parametrize(("percentile", "stiffness", "peak"), [(5, 25705, 55.6), (50, 40142, 86.8), (95, 52467, 113.5)])
def test_scaling_keeps_frequencies_and_ratios(percentile, stiffness, peak):
    model = OCCUPANTS["wei_griffin_2"]
    found = scaled(model, SEATED_MASS[percentile])
    assert found.links[0].stiffness == pytest.approx(stiffness, abs=1.0)
    at = numpy.arange(3.0, 7.0, 0.01)
    magnitude = abs(apparent_mass(found, at))
    assert magnitude.max() == pytest.approx(peak, rel=5e-3)
    assert at[magnitude.argmax()] == pytest.approx(4.59, abs=0.02)
    assert natural_frequencies(found) == pytest.approx(natural_frequencies(model), rel=1e-12)


def test_a_stiffer_posture_raises_frequencies_by_the_root_and_keeps_the_ratio_of_the_peak():
    model, at = OCCUPANTS["wei_griffin_1"], numpy.arange(2.0, 9.0, 0.002)
    erect = abs(apparent_mass(stiffened(model, 1.21), 1.1 * at))
    assert erect == pytest.approx(abs(apparent_mass(model, at)), rel=1e-9)


@pytest.mark.parametrize(("rms", "peak"), [(0.25, 6.02), (0.5, 5.26), (1.0, 4.59), (2.0, 4.01)])
def test_an_exponent_of_0_195_takes_the_peak_of_the_apparent_mass_from_6_to_4_hz(rms, peak):
    model, at = OCCUPANTS["wei_griffin_2"], numpy.arange(2.0, 8.0, 0.005)
    magnitude = abs(apparent_mass(softened(model, rms, 0.195), at))
    assert at[magnitude.argmax()] == pytest.approx(peak, abs=0.02)
    assert magnitude.max() == pytest.approx(1.523 * model.mass, rel=1e-3)


def test_the_published_figures_on_the_occupant_hold():
    outside = [row for row in VALIDATION if not row.band[0] <= row.ours() <= row.band[1]]
    assert all("iso_5982" in row.quantity or "wan_schimmels" in row.quantity for row in outside)
    assert all(row.note for row in outside)
    peak = next(row for row in VALIDATION if row.unit == "Hz" and "wei_griffin_2" in row.quantity)
    assert peak.ours() == pytest.approx(4.59, abs=0.01)


def test_rest_deflections_of_a_chain_carry_what_is_above():
    model = OCCUPANTS["boileau_rakheja"]
    heights = rest_deflections(model, 9.81)
    above = [sum(model.masses[i:]) for i in range(1, 5)]
    squeezed = [9.81 * mass / link.stiffness for mass, link in zip(above, model.links, strict=True)]
    assert -heights == pytest.approx(numpy.cumsum([0.0, *squeezed]), rel=1e-12)


def test_a_force_that_lifts_a_node_takes_load_off_the_links_under_it():
    """Each link of the chain carries what hangs above it less what is lifted there."""
    model, lifted = OCCUPANTS["boileau_rakheja"], {2: 120.0, 4: -30.0}
    carried = [
        9.81 * sum(model.masses[i:]) - sum(lift for node, lift in lifted.items() if node >= i) for i in range(1, 5)
    ]
    squeezed = [force / link.stiffness for force, link in zip(carried, model.links, strict=True)]
    assert -rest_deflections(model, 9.81, lifted) == pytest.approx(numpy.cumsum([0.0, *squeezed]), rel=1e-12)


def test_matrices_of_a_loop_hold_no_force_where_all_move_together():
    mass, damping, stiffness = matrices(OCCUPANTS["wan_schimmels"])
    assert stiffness.sum(axis=0) == pytest.approx(numpy.zeros(5), abs=1e-9)
    assert damping.sum(axis=1) == pytest.approx(numpy.zeros(5), abs=1e-9)
    assert mass.sum() == pytest.approx(60.67)


def test_a_rigid_occupant_and_one_without_a_head():
    assert apparent_mass(OCCUPANTS["inert_75"], (0.5, 40.0)) == pytest.approx((75.0, 75.0))
    with pytest.raises(ValueError, match="without a head"):
        seat_to_head(OCCUPANTS["inert_75"], 4.0)


def test_an_occupant_of_ones_own():
    """Two equal masses in a row over a rigid seat, undamped: at w^2 = k/m the upper one stands in
    for an infinite mass."""
    own = OccupantModel((1.0, 2.0, 2.0), (Link(0, 1, 800.0, 0.0), Link(1, 2, 800.0, 0.0)), 2, "")
    golden = (math.sqrt(5.0) + 1.0) / 2.0
    expected = 20.0 * numpy.array([1.0 / golden, golden]) / (2.0 * math.pi)
    assert natural_frequencies(own) == pytest.approx(expected, rel=1e-12)
    # At w^2 = k/m the lower mass moves by 0 of the seat's, the upper by -1.
    assert cmath.isclose(seat_to_head(own, 20.0 / (2.0 * math.pi))[0], -1.0, rel_tol=1e-9)


def test_a_link_that_rings_faster_than_samples_follow_is_named():
    """Two masses on a spring: w² = k (1/m + 1/M), damped by c (1/m + 1/M) / (2 w)."""
    share = 1.0 / 6.0 + 1.0 / 40.0
    for damping in (0.0, 1e3):
        model = OccupantModel((6.0, 40.0), (Link(0, 1, 1e8, damping),), 1, "own")
        frequency, damped = ringing_of(model)
        assert frequency == pytest.approx(math.sqrt(1e8 * share) / (2.0 * math.pi), rel=1e-9)
        assert damped == pytest.approx(0.5 * damping * share / math.sqrt(1e8 * share), abs=1e-9)
        (caution,) = ringing_cautions(model, 1000.0)
        assert "rings at 697 Hz" in caution
        assert ringing_cautions(model, 7000.0) == ()
    assert ringing_cautions(OccupantModel((6.0, 40.0), (Link(0, 1, 1e8, 5e4),), 1, "own"), 1000.0) == ()
    for model in OCCUPANTS.values():
        assert ringing_cautions(model, 1000.0) == ()
