"""System *profile* beside Hertz, Sneddon's cone and the load balance of a Lamé domain."""

import math

import numpy
import pytest
from scipy.special import beta

from contact_sim_lab.papers.tire_road.system_profile import profile
from contact_sim_lab.records.paper import PaperError

MODULUS = 4e6


def table(tmp_path, names, rows):
    path = tmp_path / "shape.csv"
    path.write_text(
        "\n".join([names, *(",".join(repr(float(cell)) for cell in row) for row in rows)]), encoding="utf-8"
    )
    return path


def test_a_parabolic_tip_is_hertz(tmp_path):
    """f = r^2/(2 R): a^3 = 3 P R/(4 E*), delta = a^2/R, p0 = 3 P/(2 pi a^2)."""
    r = numpy.linspace(0.0, 0.006, 400)
    path = table(tmp_path, "r,height", zip(r, r**2 / (2.0 * 0.02), strict=True))
    result = profile(path, {"modulus": MODULUS, "load": 10.0})
    row = result.rows[-1]
    radius = (3.0 * 10.0 * 0.02 / (4.0 * MODULUS)) ** (1.0 / 3.0)
    assert row["contact_radius_m"] == pytest.approx(radius, rel=1e-5)
    assert row["approach_m"] == pytest.approx(radius**2 / 0.02, rel=1e-5)
    assert row["centre_pressure_Pa"] == pytest.approx(1.5 * 10.0 / (math.pi * radius**2), rel=1e-3)
    # p(r) of each load, from the centre to the border.
    for share in (0.1, 0.25, 0.5, 1.0):
        course = [each for each in result.course if each["load_N"] == pytest.approx(share * 10.0)]
        places, found = (numpy.array([each[name] for each in course]) for name in ("r_m", "pressure_Pa"))
        border = radius * share ** (1.0 / 3.0)
        assert places == pytest.approx(numpy.linspace(0.0, border, 11), rel=1e-5)
        peak = 1.5 * share * 10.0 / (math.pi * border**2)
        assert found == pytest.approx(
            peak * numpy.sqrt(numpy.maximum(1.0 - (places / border) ** 2, 0.0)), abs=5e-3 * peak
        )


def test_the_outline_of_a_superellipse_gives_its_exponent_and_carries_the_load(tmp_path):
    a, b, n, load = 0.06, 0.085, 3.5, 4000.0
    t = numpy.linspace(0.0, 2.0 * math.pi, 60, endpoint=False)
    x, y = (
        side * numpy.sign(part) * numpy.abs(part) ** (2.0 / n) for side, part in ((a, numpy.cos(t)), (b, numpy.sin(t)))
    )
    result = profile(table(tmp_path, "x,y", zip(x + 0.01, y, strict=True)), {"modulus": MODULUS, "load": load})
    ansatz, ellipse = result.rows
    assert (ansatz["a_m"], ansatz["b_m"], ansatz["n"]) == pytest.approx((a, b, n), rel=1e-3)
    area = 4.0 * a * b * math.gamma(1.0 + 1.0 / n) ** 2 / math.gamma(1.0 + 2.0 / n)
    assert ansatz["centre_pressure_Pa"] == pytest.approx(load / (area * (2.0 / n) * beta(2.0 / n, 1.5)), rel=1e-3)
    assert ellipse["centre_pressure_Pa"] == pytest.approx(1.5 * load / area, rel=1e-3)


def test_shapes_without_such_a_contact_are_refused(tmp_path):
    values = {"modulus": MODULUS, "load": 1e6}
    with pytest.raises(PaperError, match="columns r, height or x, y are needed"):
        profile(table(tmp_path, "r,z", [(0, 0)]), values)
    with pytest.raises(PaperError, match="give more of the profile"):
        profile(table(tmp_path, "r,height", [(0, 0), (0.001, 0.001), (0.002, 0.003)]), values)
    with pytest.raises(PaperError, match="radii must rise from 0"):
        profile(table(tmp_path, "r,height", [(0.001, 0), (0.002, 0.001), (0.003, 0.003)]), values)
    with pytest.raises(PaperError, match="fix no Lamé curve"):
        profile(table(tmp_path, "x,y", [(0, 0), (1, 1), (2, 2)]), values)
