"""Shallow shell: frequencies against closed forms and finite differences, deflection against Levy's single series."""

from __future__ import annotations

import math

import mpmath
import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_lab.rigs.backrest.twin_shell import plate_centre_deflection, shell_frequencies
from contact_sim_pkg.rigs.backrest.shell import (
    MODE_COUNTS,
    ShallowShell,
    ShellError,
    crown_gap,
    natural_frequencies,
    shell_modes,
    static_deflection,
)

BACK = ShallowShell(0.40, 0.50, 0.030, 0.6e6, 0.45, 1050.0, 0.6, 1.5)
PLATE = BACK._replace(radius_1=math.inf, radius_2=math.inf)


def test_the_back_of_the_seat_scene_has_its_first_frequency_in_the_spine_band() -> None:
    assert natural_frequencies(BACK, 1)[0] / (2.0 * math.pi) == pytest.approx(5.49, abs=0.005)


@pytest.mark.parametrize("count", MODE_COUNTS)
def test_without_curvature_the_frequencies_are_those_of_a_plate(count: int) -> None:
    side = math.isqrt(count)
    rigidity = mpmath.mpf(PLATE.young) * PLATE.thickness**3 / (12 * (1 - mpmath.mpf(PLATE.poisson) ** 2))
    speed = mpmath.sqrt(rigidity / (PLATE.density * PLATE.thickness))
    waves = [
        mpmath.pi**2 * ((m / mpmath.mpf(PLATE.length_1)) ** 2 + (n / mpmath.mpf(PLATE.length_2)) ** 2)
        for m in range(1, side + 1)
        for n in range(1, side + 1)
    ]
    expected = [float(speed * wave) for wave in waves]
    assert natural_frequencies(PLATE, count) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("radii", [(0.6, 1.5), (math.inf, 0.7), (2.0, 2.0), (1.2, -0.9)])
def test_frequencies_are_those_of_the_shallow_shell_equations_by_finite_differences(radii: tuple[float, float]) -> None:
    shell = BACK._replace(thickness=0.006, radius_1=radii[0], radius_2=radii[1])
    lowest = numpy.sort(natural_frequencies(shell, 36))[:6]
    assert lowest == pytest.approx(shell_frequencies(shell._asdict(), 6), rel=2e-5)


def test_a_spherical_shell_adds_e_over_rho_r_squared_to_every_mode() -> None:
    shell = BACK._replace(radius_1=2.0, radius_2=2.0)
    added = natural_frequencies(shell, 25) ** 2 - natural_frequencies(PLATE, 25) ** 2
    assert added == pytest.approx(shell.young / shell.density / 4.0, rel=1e-9)


def test_a_vanishing_thickness_leaves_the_membrane() -> None:
    membrane = BACK._replace(thickness=1e-12, radius_1=2.0, radius_2=2.0)
    assert natural_frequencies(membrane, 9) == pytest.approx(math.sqrt(0.6e6 / 1050.0) / 2.0, rel=1e-12)


def test_shapes_are_orthogonal_with_the_modal_mass_as_norm() -> None:
    nodes, weights = numpy.polynomial.legendre.leggauss(40)
    x, y = 0.5 * BACK.length_1 * (nodes + 1.0), 0.5 * BACK.length_2 * (nodes + 1.0)
    points = numpy.stack(numpy.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    area = numpy.outer(weights, weights).ravel() * BACK.length_1 * BACK.length_2 / 4.0
    modes = shell_modes(BACK, 25, points)
    gram = BACK.density * BACK.thickness * modes.shapes.T @ (area[:, None] * modes.shapes)
    numpy.testing.assert_allclose(gram, modes.modal_mass * numpy.eye(25), atol=1e-12)


def test_slopes_are_the_derivatives_of_the_shapes() -> None:
    points, step = numpy.array([[0.13, 0.27], [0.31, 0.05], [0.0, 0.5]]), 1e-5
    inner = numpy.clip(points, 2.0 * step, [0.4 - 2.0 * step, 0.5 - 2.0 * step])
    modes = shell_modes(BACK, 9, inner)
    for axis, slopes in enumerate((modes.slopes_x, modes.slopes_y)):
        moved = numpy.zeros(2)
        moved[axis] = step
        above, below = shell_modes(BACK, 9, inner + moved).shapes, shell_modes(BACK, 9, inner - moved).shapes
        numpy.testing.assert_allclose(slopes, (above - below) / (2.0 * step), atol=1e-6)


def test_modes_stand_by_m_then_n_and_name_the_shapes_at_the_crown() -> None:
    modes = shell_modes(BACK, 4, numpy.array([[0.2, 0.25], [0.1, 0.25]]))
    assert modes.orders.tolist() == [[1, 1], [1, 2], [2, 1], [2, 2]]
    assert modes.shapes[0] == pytest.approx([1.0, 0.0, 0.0, 0.0], abs=1e-15)
    assert modes.shapes[1] == pytest.approx([math.sqrt(0.5), 0.0, 1.0, 0.0], abs=1e-15)


def test_levy_s_series_has_the_factor_of_the_textbook_and_knows_no_first_side() -> None:
    assert plate_centre_deflection(1.0, 1.0, rigidity=1.0, load=1.0) == pytest.approx(0.01160, abs=5e-6)
    assert plate_centre_deflection(1.0, 2.0, 1.0, 1.0) == pytest.approx(plate_centre_deflection(2.0, 1.0, 1.0, 1.0))


def test_the_static_deflection_converges_to_levy_s_series() -> None:
    middle = numpy.array([[0.2, 0.25]])
    rigidity = PLATE.young * PLATE.thickness**3 / (12.0 * (1.0 - PLATE.poisson**2))
    exact = plate_centre_deflection(PLATE.length_1, PLATE.length_2, rigidity, 20.0)
    load = numpy.array([20.0])
    errors = [1.0 - static_deflection(PLATE, count, load, middle, middle)[0] / exact for count in (1, 9, 25, 10_201)]
    assert errors == sorted(errors, reverse=True)
    assert errors == pytest.approx([0.1237, 0.0359, 0.0165, 4e-5], abs=5e-5)


@settings(max_examples=50)
@given(st.floats(0.1, 0.3), st.floats(0.1, 0.4), st.floats(0.1, 0.3), st.floats(0.1, 0.4), st.sampled_from(MODE_COUNTS))
def test_deflections_are_reciprocal(x_1: float, y_1: float, x_2: float, y_2: float, count: int) -> None:
    one, other = numpy.array([[x_1, y_1]]), numpy.array([[x_2, y_2]])
    there, back = (static_deflection(BACK, count, numpy.ones(1), *pair)[0] for pair in ((one, other), (other, one)))
    assert there == pytest.approx(back, rel=1e-12, abs=1e-18)


def test_the_gap_of_the_crown_is_that_of_two_parabolas() -> None:
    gap = crown_gap(BACK, numpy.array([[0.2, 0.25], [0.0, 0.25], [0.2, 0.5]]))
    assert gap == pytest.approx([0.0, 0.04 / 1.2, 0.0625 / 3.0])
    assert crown_gap(PLATE, numpy.array([[0.0, 0.0]])) == pytest.approx([0.0])


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"thickness": 0.0401}, "above 0.1 of the shorter side"),
        ({"thickness": 0.0}, "thickness is 0.0"),
        ({"radius_1": 0.2}, "radius_1 is 0.2 m"),
        ({"radius_2": 0.0}, "radius_2 is 0 m"),
        ({"radius_2": math.nan}, "radius_2 is nan"),
        ({"poisson": 0.6}, "poisson is 0.6"),
        ({"young": math.inf}, "young is inf"),
    ],
)
def test_what_is_no_thin_shallow_shell_is_refused(change: dict[str, float], reason: str) -> None:
    with pytest.raises(ShellError, match=reason):
        shell_modes(BACK._replace(**change), 1, numpy.zeros((1, 2)))


def test_wrong_counts_and_points_are_refused() -> None:
    for count, reason in ((0, "at least 1"), (-1, "at least 1"), (2, "square numbers"), (24, "square numbers")):
        with pytest.raises(ShellError, match=reason):
            natural_frequencies(BACK, count)
    with pytest.raises(ShellError, match="outside the sides"):
        shell_modes(BACK, 1, numpy.array([[0.2, 0.51]]))
    with pytest.raises(ShellError, match=r"must be \(points, 2\)"):
        shell_modes(BACK, 1, numpy.zeros(2))
    with pytest.raises(ShellError, match="one load a point"):
        static_deflection(BACK, 1, numpy.ones(2), numpy.array([[0.2, 0.2]]), numpy.array([[0.2, 0.2]]))
