"""Figures of seat and occupant for `bench validation` against closed forms and against sums of the published parts."""

import math

import pytest

from contact_sim_lab.rigs.vehicle import validation_occupant, validation_seat
from contact_sim_lab.rigs.vehicle.validation_seat import FLOOR, SEAT
from contact_sim_pkg.records.metric import Published
from contact_sim_pkg.rigs.vehicle.seat.biodynamics import seat_transmissibility
from contact_sim_pkg.rigs.vehicle.seat.occupants import OCCUPANTS

LINEAR = (
    "effects.seat={normal_elastic: {coefficient: 5e4, exponent: 1}, "
    "general_dissipative: {coefficient: 500, approach_exponent: 0, rate_exponent: 1}}"
)


def published(quantity) -> Published:
    found = [*validation_seat.VALIDATION, *validation_occupant.VALIDATION]
    return next(each for each in found if each.quantity.startswith(quantity))


def test_the_lines_are_narrow_enough_for_the_peak_of_a_linear_seat():
    """Lines of 1/4 Hz miss the closed form by 3 %, one noise alone by 2 %."""
    densities = validation_seat._ride(1.0, LINEAR)
    way = densities.response(FLOOR, SEAT)
    around = (way.frequency > 2.5) & (way.frequency < 6.0)
    exact = abs(seat_transmissibility(OCCUPANTS["wei_griffin_2"], way.frequency[around], 5.0e4, 500.0))
    assert way.magnitude[around] == pytest.approx(exact, rel=0.01)
    assert densities.segments == 8 * 6


def test_buttocks_and_thighs_of_the_office_chair_are_compared_together():
    """Sums of the published parts, their scatter by propagation; the bands are two standard deviations wide."""
    buttocks, thighs = (527.0, 64.0, 8.1, 1.0), (342.0, 95.0, 3.5, 0.6)
    area = buttocks[0] + thighs[0]
    mean = (buttocks[0] * buttocks[2] + thighs[0] * thighs[2]) / area
    scatter_of_area = math.hypot(buttocks[1], thighs[1])
    scatter_of_mean = math.hypot(
        *(part[0] / area * part[3] for part in (buttocks, thighs)),
        *((part[2] - mean) / area * part[1] for part in (buttocks, thighs)),
    )
    row = published("area under buttocks and thighs")
    assert row.band == pytest.approx((area - 2 * scatter_of_area, area + 2 * scatter_of_area), abs=1.0)
    assert row.value == f"{area:.0f} ± {scatter_of_area:.0f}"
    row = published("mean pressure under buttocks and thighs")
    assert row.band == pytest.approx((mean - 2 * scatter_of_mean, mean + 2 * scatter_of_mean), abs=0.06)
    assert row.value == f"{mean:.1f} ± {scatter_of_mean:.1f}"
    ours = published("area under buttocks and thighs").ours() * row.ours()
    assert ours == pytest.approx(buttocks[0] * buttocks[2] + thighs[0] * thighs[2], rel=0.01)


@pytest.mark.parametrize(
    ("person", "area", "mean", "largest"),
    [("5th", 826.0, 4.331, 10.29), ("50th", 1176.0, 4.752, 11.29), ("95th", 1490.0, 4.901, 11.76)],
)
def test_people_of_several_sizes_have_their_area_and_pressure(person, area, mean, largest):
    """The same layer by other means: body and energy in plain numpy, minimised by scipy's L-BFGS-B with bounds."""
    assert published(f"loaded area, {person} percentile, ").ours() == pytest.approx(area, rel=0.005)
    assert published(f"mean pressure of the loaded area, {person} percentile, ").ours() == pytest.approx(
        mean, rel=0.005
    )
    assert published(f"largest pressure, {person} percentile, ").ours() == pytest.approx(largest, rel=0.01)


@pytest.mark.parametrize(
    ("model", "frequency", "largest"),
    [("wei_griffin_1", 4.15, 1.339), ("wei_griffin_2", 4.59, 1.523), ("iso_5982", 3.78, 1.369),
     ("boileau_rakheja", 4.57, 1.639), ("wan_schimmels", 3.68, 1.306)],
)  # fmt: skip
def test_every_model_has_its_apparent_mass_on_the_page(model, frequency, largest):
    row = published(f"frequency of the largest apparent mass, rigid seat, about 1 m/s² rms, `{model}`")
    assert row.ours() == pytest.approx(frequency, abs=0.006)
    assert published(f"largest apparent mass over that at rest, `{model}`").ours() == pytest.approx(largest, abs=6e-4)


@pytest.mark.parametrize(
    ("model", "frequency", "largest"),
    [("iso_5982", 4.77, 1.351), ("boileau_rakheja", 4.68, 1.781), ("wan_schimmels", 3.98, 1.371)],
)
def test_every_model_with_a_head_has_its_way_to_it_on_the_page(model, frequency, largest):
    assert published(f"frequency of the largest seat-to-head transmissibility, `{model}`").ours() == pytest.approx(
        frequency, abs=0.006
    )
    assert published(f"largest seat-to-head transmissibility, `{model}`").ours() == pytest.approx(largest, abs=6e-4)
