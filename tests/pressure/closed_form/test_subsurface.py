"""Stress below a loaded surface: cubature of point forces, surface limits, equilibrium, Hertz in closed form, symmetry."""

from __future__ import annotations

import math

import numpy
import pytest
import scipy.optimize

from contact_sim_lab.twins import subsurface as reference
from contact_sim_pkg.pressure.closed_form.subsurface import (
    SurfaceGrid,
    max_shear,
    principal_stresses,
    subsurface_stress,
    von_mises,
)

ONE = numpy.ones((1, 1))
GRID = SurfaceGrid(2.0, 1.0, 0.0, 0.0)  # one cell |x| < 1, |y| < 0.5
POINTS = [(0.0, 0.0, 0.3), (0.4, -0.2, 0.1), (1.0, 0.5, 0.4), (1.7, -1.1, 0.25), (-3.0, 2.0, 5.0), (1.0, 0.1, 0.2)]


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("at", POINTS)
def test_a_rectangle_equals_the_cubature_of_point_forces(at: tuple[float, float, float], poisson: float) -> None:
    point = numpy.array([at])
    expected = reference.rectangle(reference.normal_point, lambda x, y: 1.0, (1.0, 0.5), at, poisson)
    assert subsurface_stress(GRID, poisson, point, ONE)[0] == pytest.approx(expected, rel=1e-8, abs=1e-9)
    expected = reference.rectangle(reference.tangential_point, lambda x, y: 1.0, (1.0, 0.5), at, poisson)
    assert subsurface_stress(GRID, poisson, point, None, ONE)[0] == pytest.approx(expected, rel=1e-8, abs=1e-9)


@pytest.mark.parametrize("at", POINTS[:4])
def test_traction_along_y_is_traction_along_x_seen_from_the_side(at: tuple[float, float, float]) -> None:
    found = subsurface_stress(GRID, 0.3, numpy.array([at]), traction_y=ONE)[0]
    turned = (at[1], at[0], at[2])
    xx, yy, zz, xy, xz, yz = reference.rectangle(reference.tangential_point, lambda x, y: 1.0, (0.5, 1.0), turned, 0.3)
    assert found == pytest.approx([yy, xx, zz, xy, yz, xz], rel=1e-8, abs=1e-9)


def test_loads_add_up_over_cells_and_kinds() -> None:
    random = numpy.random.default_rng(4)
    grid = SurfaceGrid(0.5, 0.7, -0.6, 0.2)
    fields = random.random((3, 3, 2))
    points = numpy.array([[0.1, 0.2, 0.3], [-0.85, 0.3, 0.0], [4.0, -2.0, 1.0], [-0.35, 0.55, 0.05]])
    total = numpy.zeros((4, 6))
    for i in range(3):
        for j in range(2):
            cell = SurfaceGrid(0.5, 0.7, -0.6 + 0.5 * i, 0.2 + 0.7 * j)
            total += subsurface_stress(cell, 0.3, points, *(ONE * field[i, j] for field in fields))
    # The second point lies in the surface on the middle of an edge; no point is on a corner, where xy is infinite.
    assert subsurface_stress(grid, 0.3, points, *fields) == pytest.approx(total, abs=1e-13)


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.5])
def test_the_surface_carries_its_loads_exactly(poisson: float) -> None:
    points = numpy.array([[0.0, 0.0, 0.0], [0.9, 0.4, 0.0], [1.0, 0.2, 0.0], [1.0, 0.5, 0.0], [1.01, 0.0, 0.0]])
    share = numpy.array([1.0, 1.0, 0.5, 0.25, 0.0])  # inside, edge, corner, outside
    pressed = subsurface_stress(GRID, poisson, points, ONE)
    assert numpy.all(numpy.isfinite(pressed))
    assert pressed[:, 2] == pytest.approx(-share, abs=1e-15)
    assert numpy.all(pressed[:, 4:] == 0.0)
    drawn = subsurface_stress(GRID, poisson, points, None, ONE, 3.0 * ONE)
    assert numpy.all(numpy.isfinite(drawn))
    assert drawn[:, 4] == pytest.approx(-share, abs=1e-15)
    assert drawn[:, 5] == pytest.approx(-3.0 * share, abs=1e-15)
    assert numpy.all(drawn[:, 2] == 0.0)


def test_the_centre_of_a_square_in_the_surface() -> None:
    found = subsurface_stress(SurfaceGrid(1.0, 1.0, 0.0, 0.0), 0.3, numpy.zeros((1, 3)), ONE)[0]
    assert found == pytest.approx([-0.8, -0.8, -1.0, 0.0, 0.0, 0.0], abs=1e-15)  # -(1 + 2 nu)/2


def test_the_surface_is_the_limit_of_the_depth() -> None:
    surface = numpy.array([[0.3, -0.2, 0.0], [1.4, 0.8, 0.0], [-0.2, 0.9, 0.0]])
    below = surface + numpy.array([0.0, 0.0, 1e-9])
    loads = (ONE, 0.4 * ONE, -0.7 * ONE)
    assert subsurface_stress(GRID, 0.3, surface, *loads) == pytest.approx(
        subsurface_stress(GRID, 0.3, below, *loads), abs=1e-8
    )


def test_the_middle_of_a_level_field_knows_nothing_of_its_cells() -> None:
    points = numpy.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1e-7], [0.0, 0.0, 0.3], [0.5, 0.25, 0.0]])
    fine = SurfaceGrid(0.5, 0.25, -0.75, -0.375)  # 4 x 4 cells on the same rectangle; corners at the points
    level = numpy.ones((4, 4))
    assert subsurface_stress(fine, 0.3, points, level, level, level) == pytest.approx(
        subsurface_stress(GRID, 0.3, points, ONE, ONE, ONE), abs=1e-14
    )


@pytest.mark.parametrize("depth", [0.05, 0.4, 3.0])
def test_every_plane_carries_the_whole_load(depth: float) -> None:
    """In polar coordinates to 300 depths or so; beyond, the shear of a point force still carries 1.5 z/R of Q."""
    field = numpy.array([[1.0, 3.0, 0.5], [0.2, 2.0, 4.0]])
    grid = SurfaceGrid(0.3, 0.2, -0.15, -0.2)
    cell = 0.3 * 0.2
    farthest = 300.0 * max(depth, 0.4)
    scale = min(depth, 0.2)
    stretch, weight = numpy.polynomial.legendre.leggauss(240)
    end = math.asinh(farthest / scale)
    radius = scale * numpy.sinh(0.5 * end * (stretch + 1.0))
    area = radius * scale * numpy.cosh(0.5 * end * (stretch + 1.0)) * 0.5 * end * weight
    angle = numpy.arange(96) / 96 * 2.0 * math.pi
    x, y = radius[:, None] * numpy.cos(angle), radius[:, None] * numpy.sin(angle)
    points = numpy.stack([x.ravel(), y.ravel(), numpy.full(x.size, depth)], axis=1)
    share = numpy.repeat(area * 2.0 * math.pi / 96, 96)
    force = field.sum() * cell
    pressed = share @ subsurface_stress(grid, 0.3, points, field)
    assert pressed[2] == pytest.approx(-force, rel=1e-5)
    assert pressed[4:] == pytest.approx([0.0, 0.0], abs=0.02 * force)  # its tail falls like z/R
    tail = 1.5 * depth / farthest
    for number, loads in ((4, (None, field)), (5, (None, None, field))):
        drawn = share @ subsurface_stress(grid, 0.3, points, *loads)
        assert drawn[number] == pytest.approx(-force * (1.0 - tail), rel=2e-5)


def hertz_disc(cells: int) -> tuple[SurfaceGrid, numpy.ndarray]:
    cell = 2.0 / cells
    x = (numpy.arange(cells) - 0.5 * (cells - 1)) * cell
    pressure = numpy.sqrt(numpy.maximum(1.0 - x[:, None] ** 2 - x[None, :] ** 2, 0.0))
    return SurfaceGrid(cell, cell, x[0], x[0]), pressure


@pytest.mark.parametrize("poisson", [0.3, 0.5])
def test_the_axis_below_a_sphere_is_hertz(poisson: float) -> None:
    grid, pressure = hertz_disc(121)
    depth = numpy.array([0.0, 0.05, 0.2, 0.481, 1.0, 2.5])
    found = subsurface_stress(grid, poisson, numpy.stack([0 * depth, 0 * depth, depth], axis=1), pressure)
    expected = numpy.array([reference.circle_axis(z, poisson) for z in depth])
    assert found[:, 2] == pytest.approx(expected[:, 0], abs=1e-3)
    assert found[:, 0] == pytest.approx(expected[:, 1], abs=1e-3)
    assert found[:, 1] == pytest.approx(expected[:, 1], abs=1e-3)
    assert found[:, 3:] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("poisson", "shear", "where"), [(0.3, 0.310, 0.481), (0.5, 0.266, 0.548)])
def test_the_largest_shear_below_a_sphere(poisson: float, shear: float, where: float) -> None:
    grid, pressure = hertz_disc(61)
    found = scipy.optimize.minimize_scalar(
        lambda z: -float(max_shear(subsurface_stress(grid, poisson, numpy.array([[0.0, 0.0, z]]), pressure))[0]),
        bounds=(0.2, 1.0),
        method="bounded",
    )
    assert (-found.fun, found.x) == pytest.approx((shear, where), rel=0.005)


def line(cells: int) -> tuple[SurfaceGrid, numpy.ndarray]:
    """Hertz line contact of half-width 1 along y, 4000 long."""
    cell = 2.0 / cells
    x = (numpy.arange(cells) - 0.5 * (cells - 1)) * cell
    return SurfaceGrid(cell, 4000.0, x[0], 0.0), numpy.sqrt(1.0 - x**2)[:, None]


def test_the_axis_below_a_line_contact() -> None:
    grid, pressure = line(400)
    depth = numpy.array([0.02, 0.3, 0.786, 2.0])
    found = subsurface_stress(grid, 0.3, numpy.stack([0 * depth, 0 * depth, depth], axis=1), pressure)
    expected = numpy.array([reference.line_axis(z, 0.3) for z in depth])
    assert found[:, :3] == pytest.approx(expected, abs=1e-3)
    assert max_shear(found)[2] == pytest.approx(0.3003, rel=1e-3)
    orthogonal = subsurface_stress(grid, 0.3, numpy.array([[-0.866, 0.0, 0.5], [0.866, 0.0, 0.5]]), pressure)[:, 4]
    assert abs(orthogonal) == pytest.approx([0.25, 0.25], rel=1e-3)
    assert orthogonal[0] == pytest.approx(-orthogonal[1], rel=1e-10)


def test_the_surface_of_a_sliding_line_contact() -> None:
    """Johnson eq 8.2: `xx = -2 q0 x/a` in the contact, `-2 q0 (x - sign(x) sqrt(x^2 - 1))` outside: tension behind."""
    grid, traction = line(400)
    x = numpy.array([-3.0, -1.5, -0.6025, 0.0, 0.3025, 2.0])
    points = numpy.stack([x, 0 * x, 0 * x], axis=1)
    found = subsurface_stress(grid, 0.3, points, traction_x=traction)
    expected = -2.0 * (x - numpy.sign(x) * numpy.sqrt(numpy.maximum(x**2 - 1.0, 0.0)))
    assert found[:, 0] == pytest.approx(expected, abs=5e-3)
    assert found[:, 1] == pytest.approx(0.3 * expected, abs=5e-3)  # plane strain
    assert found[1, 0] > 0.0


def test_mirrored_points_have_mirrored_stresses() -> None:
    grid, pressure = hertz_disc(15)
    x, y, z = 0.3, 0.5, 0.4
    points = numpy.array([[x, y, z], [-x, y, z], [x, -y, z], [y, x, z]])
    stress = subsurface_stress(grid, 0.3, points, pressure)
    assert stress[1] == pytest.approx(stress[0] * [1, 1, 1, -1, -1, 1], abs=1e-14)
    assert stress[2] == pytest.approx(stress[0] * [1, 1, 1, -1, 1, -1], abs=1e-14)
    assert stress[3] == pytest.approx(stress[0][[1, 0, 2, 3, 5, 4]], abs=1e-14)


def test_invariants_of_a_stress_by_hand() -> None:
    stress = numpy.array(
        [[100.0, -50.0, 20.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 30.0, 0.0, 0.0], [-7.0, -7.0, -7.0, 0, 0, 0]]
    )
    assert principal_stresses(stress) == pytest.approx(
        numpy.array([[100.0, 20.0, -50.0], [30.0, 0.0, -30.0], [-7.0, -7.0, -7.0]]), abs=1e-12
    )
    assert max_shear(stress) == pytest.approx([75.0, 30.0, 0.0], abs=1e-12)
    assert von_mises(stress) == pytest.approx([130.0, 30.0 * math.sqrt(3.0), 0.0], abs=1e-12)


def test_invariants_do_not_depend_on_the_axes() -> None:
    grid, pressure = hertz_disc(9)
    point = numpy.array([[0.3, 0.7, 0.4]])
    stress = subsurface_stress(grid, 0.3, point, pressure, 0.2 * pressure)
    turned = subsurface_stress(grid, 0.3, point[:, [1, 0, 2]], pressure.T, None, 0.2 * pressure.T)
    assert principal_stresses(stress) == pytest.approx(principal_stresses(turned), abs=1e-14)
    assert von_mises(stress) == pytest.approx(von_mises(turned), abs=1e-14)


def test_nothing_on_the_surface_is_nothing_below() -> None:
    assert numpy.all(subsurface_stress(GRID, 0.3, numpy.array([[0.0, 0.0, 1.0]])) == 0.0)
    assert subsurface_stress(GRID, 0.3, numpy.zeros((0, 3)), ONE).shape == (0, 6)


def test_impossible_input_is_refused() -> None:
    point = numpy.array([[0.0, 0.0, 1.0]])
    with pytest.raises(ValueError, match="point 0 is"):
        subsurface_stress(GRID, 0.3, -point, ONE)
    with pytest.raises(ValueError, match="must be \\[n, 3\\]"):
        subsurface_stress(GRID, 0.3, point[0], ONE)
    with pytest.raises(ValueError, match="Poisson"):
        subsurface_stress(GRID, 0.6, point, ONE)
    with pytest.raises(ValueError, match="cell_y"):
        subsurface_stress(SurfaceGrid(1.0, 0.0, 0.0, 0.0), 0.3, point, ONE)
    with pytest.raises(ValueError, match="origin"):
        subsurface_stress(SurfaceGrid(1.0, 1.0, math.nan, 0.0), 0.3, point, ONE)
    with pytest.raises(ValueError, match="traction_x of row 0, column 0"):
        subsurface_stress(GRID, 0.3, point, ONE, math.nan * ONE)
    with pytest.raises(ValueError, match="must be \\[rows, cols\\]"):
        subsurface_stress(GRID, 0.3, point, ONE[0])
