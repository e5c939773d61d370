"""What the captions of a field's pictures say where the fit of its outline stands at its bound, and what its surface is."""

import numpy
import pytest

from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.figures.contact import footprint_over_time
from contact_sim_pkg.report.figures.maps import Quantity, Window, surface_and_map
from contact_sim_pkg.report.series import FieldSeries, PressureMap


def four_patches():
    """A 40 x 24 grid with two discs and two bars, as ischia and thighs on a cushion."""
    x, y = numpy.meshgrid(numpy.arange(40) - 19.5, numpy.arange(24) - 11.5, indexing="ij")
    side = numpy.abs(numpy.abs(y) - 7.0)
    return 1000.0 * (((x + 12.0) ** 2 + side**2 < 20.0) | ((x > -4.0) & (x < 18.0) & (side < 3.0)))


def field_of(exponents):
    ones = numpy.ones(len(exponents))
    pressure = PressureMap(four_patches(), 0.01, 0.01, -0.195, -0.115)
    known = {
        "time": numpy.arange(len(exponents)) * 0.01, "peak": 1e3 * ones, "area": 0.1 * ones, "lame_a": ones, "lame_b": ones,
        "lame_n": numpy.array(exponents), "highest": pressure, "average": pressure, "highest_time": 0.0,
    }  # fmt: skip
    return FieldSeries(**{name: known.get(name) for name in FieldSeries._fields})


@pytest.mark.parametrize(
    ("exponents", "share"), [([2.0, 20.0, 20.0, 2.5], "50.0%"), ([0.3, 2.0], "50.0%"), ([2.0, 19.0], None)]
)
def test_an_exponent_at_its_bound_is_told(exponents, share):
    with style():
        caption = footprint_over_time("key", "seat", field_of(exponents)).caption
    assert ("stands at an end of its range (0.3 to 20)" in caption) == (share is not None)
    assert share is None or f"In {share} of the fields" in caption


def test_the_surface_names_its_quantity_and_unit():
    pressure = field_of([2.0]).highest
    quantity = Quantity(pressure.pressure, "pressure, kPa", "viridis")
    with style():
        figure = surface_and_map(pressure, quantity, Window(-200.0, 200.0, -120.0, 120.0), outline=False)
    assert figure.axes[0].get_zlabel() == "pressure, kPa"
