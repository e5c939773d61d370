"""Every public function of the pressure fields on a grid and the stress below: checks over its domain, refusals outside."""

from __future__ import annotations

import math

import numpy
import pytest
from hypothesis import strategies as st
from tests.properties import Table, positive, rows

from contact_sim_pkg.pressure.closed_form import hertz_stress, subsurface
from contact_sim_pkg.pressure.field import halfspace, patch
from contact_sim_pkg.pressure.field import periodic as periodic_field
from contact_sim_pkg.pressure.field import solver as field_solver
from contact_sim_pkg.pressure.field.solver import BAD_INPUT, CONVERGED, EDGE

MODULES = (
    "pressure.field.solver",
    "pressure.field.halfspace",
    "pressure.closed_form.hertz_stress",
    "pressure.field.patch",
    "pressure.field.periodic",
    "pressure.closed_form.subsurface",
)
TABLE = Table()
holds = TABLE.holds
close = pytest.approx

CELL, MODULUS = positive(1e-4, 0.1), positive(1e4, 1e11)
COUNT = st.integers(1, 9)
POISSON = st.floats(-0.9, 0.5)


def numbers(count: int, low: float, high: float) -> object:
    return rows(st.floats(low, high), count, count)


def field(count_x: int, count_y: int, low: float, high: float) -> object:
    return numbers(count_x * count_y, low, high).map(lambda v: v.reshape(count_x, count_y))


# Half-space

SIZES = {"rows": COUNT, "cols": COUNT, "cell_x": CELL, "cell_y": CELL, "modulus": MODULUS}


@holds(halfspace.make_half_space, **SIZES, outside=({"rows": 0}, {"cols": 4097}, {"rows": 2.5}, {"further": numpy.ones((1, 11))},
       {"rows": 1, "cols": 2, "further": numpy.array([[1.0, 1.1]])}))  # fmt: skip
def _(found, rows, cols, cell_x, cell_y, modulus):
    """`1/(pi E*)` times the integral of 1/r over the cell, from its own centre and from the farthest."""
    half_x, half_y = 0.5 * cell_x, 0.5 * cell_y
    own = 4.0 * (half_x * math.asinh(half_y / half_x) + half_y * math.asinh(half_x / half_y))
    assert found.influence[0, 0] * math.pi * modulus == close(own, rel=1e-12)
    x, y = (rows - 1) * cell_x, (cols - 1) * cell_y
    node, weight = numpy.polynomial.legendre.leggauss(24)
    if max(rows, cols) > 2:
        far = numpy.hypot(x + half_x * node[:, None], y + half_y * node[None, :])
        if 0.2 < cell_x / cell_y < 5.0:
            integral = half_x * half_y * float(weight @ (1.0 / far) @ weight)
            assert found.influence[-1, -1] * math.pi * modulus == close(integral, rel=1e-6)


@holds(halfspace.part_of, whole=st.builds(halfspace.make_half_space, st.just(9), st.just(8), CELL, CELL, MODULUS),
       rows=st.integers(1, 9), cols=st.integers(1, 8), outside=({"rows": 10}, {"cols": 9}, {"rows": 0}))  # fmt: skip
def _(found, whole, rows, cols):
    alone = halfspace.make_half_space(rows, cols, whole.cell_x, whole.cell_y, whole.modulus)
    assert found.influence == close(alone.influence, rel=1e-12)
    assert found.transfer == close(alone.transfer, rel=1e-12, abs=1e-12 * abs(alone.transfer).max())


EVEN = st.builds(halfspace.make_half_space, st.sampled_from([2, 6]), st.sampled_from([2, 4]), CELL, CELL, MODULUS)


@holds(halfspace.coarsened, fine=EVEN, outside=({"fine": halfspace.make_half_space(3, 2, 1.0, 1.0, 1.0)},))
def _(found, fine):
    """The mean displacement of a block of four cells under a unit pressure on another."""
    four = [(i, j) for i in (0, 1) for j in (0, 1)]
    a, b = fine.rows // 2 - 1, fine.cols // 2 - 1
    moved = [fine.influence[abs(2 * a + i - k), abs(2 * b + j - m)] for i, j in four for k, m in four]
    assert found.influence[a, b] == close(sum(moved) / 4.0, rel=1e-12)
    assert (found.rows, found.cols, found.cell_x) == (fine.rows // 2, fine.cols // 2, 2.0 * fine.cell_x)


def direct(half_space: halfspace.HalfSpace, pressure: numpy.ndarray) -> numpy.ndarray:
    """The displacement as a plain sum over all pairs of cells."""
    i, j = numpy.arange(half_space.rows), numpy.arange(half_space.cols)
    table = half_space.influence[abs(i[:, None] - i)][:, :, abs(j[:, None] - j)]
    return numpy.einsum("xayb,ab->xy", table, pressure)


GRID = st.builds(halfspace.make_half_space, st.just(5), st.just(4), CELL, CELL, MODULUS)


@holds(halfspace.make_buffers, half_space=GRID)
def _(found, half_space):
    for _ in range(2):  # a call leaves nothing behind
        moved, pressure = numpy.zeros((5, 4)), numpy.arange(20.0).reshape(5, 4)
        halfspace.displacement(half_space, found, pressure, moved)
        assert moved == close(direct(half_space, pressure), rel=1e-12)


def displacement(half_space, pressure):
    moved = numpy.zeros(pressure.shape)
    halfspace.displacement(half_space, halfspace.make_buffers(half_space), pressure, moved)
    return moved


PLATE = halfspace.make_half_space(5, 4, 0.02, 0.03, 1e6)


@holds(halfspace.displacement, half_space=st.just(PLATE), buffers=st.just(halfspace.make_buffers(PLATE)),
       pressure=field(5, 4, 0.0, 1e6), result=st.builds(lambda: numpy.ones((5, 4))))  # fmt: skip
def _(found, half_space, buffers, pressure, result):
    """The sum over all cells; reciprocal: the work of one field on the displacement of another is the same both ways."""
    assert result == close(direct(PLATE, pressure), rel=1e-12, abs=1e-18 * pressure.max())
    other = numpy.arange(20.0).reshape(5, 4)
    assert (other * result).sum() == close((pressure * displacement(PLATE, other)).sum(), rel=1e-12)


@holds(periodic_field.make_periodic_half_space, rows=st.sampled_from([4, 6, 8]), cols=st.sampled_from([2, 5, 8]), cell_x=CELL,
       cell_y=CELL, modulus=MODULUS, outside=({"rows": 0}, {"rows": 5}, {"rows": 14}, {"cols": 7}))  # fmt: skip
def _(found, rows, cols, cell_x, cell_y, modulus):
    """Westergaard: a wave of pressure p cos(q x) moves the surface by 2 p/(E* q) cos(q x); the mean does not count."""
    wave = 2.0 * math.pi / (rows * cell_x)
    pressure = 3.0 + numpy.cos(wave * cell_x * numpy.arange(rows))[:, None] * numpy.ones(cols)
    moved = displacement(found, pressure)
    assert moved == close(2.0 / (modulus * wave) * (pressure - 3.0), abs=1e-12 / (modulus * wave))


@pytest.mark.parametrize("load", [100.0, 4000.0])
def test_in_full_contact_the_period_of_a_wave_carries_the_mean_and_half_its_stiffness(load):
    """`p = mean + E* q h/2 cos(q x)` under a load at which it nowhere leaves 0 (Johnson 1985, eq 13.1)."""
    grid = periodic_field.make_periodic_half_space(16, 8, 0.1, 0.1, 1e6)
    wave = 2.0 * math.pi / 1.6
    gap = -1e-5 * numpy.cos(wave * 0.1 * numpy.arange(16))[:, None] * numpy.ones(8)
    contact = periodic_field.PeriodicField(grid)
    result = contact.solve_at_load(gap, load, 1e-10, 500)
    assert result.status == CONVERGED
    assert contact.pressure == close(load / 1.28 - 0.5 * 1e6 * wave * gap, rel=1e-6)


# Solver

SMALL = halfspace.make_half_space(12, 10, 2e-3, 2.5e-3, 1e6)
X, Y = (numpy.arange(12) - 5.5)[:, None] * 2e-3, (numpy.arange(10) - 4.5)[None, :] * 2.5e-3
GAPS = st.builds(
    lambda a, b, rough, datum: a * X**2 + b * Y**2 + 1e-6 * rough + datum,
    positive(0.5, 20.0), positive(0.5, 20.0), field(12, 10, -1.0, 1.0), st.floats(-0.1, 0.1),
)  # fmt: skip
SOLVER = {"half_space": st.just(SMALL), "workspace": st.just(field_solver.make_workspace(SMALL)), "gap": GAPS}
LIMITS = {
    "tolerance": st.just(1e-9), "max_iterations": st.just(400),
    "pressure": st.builds(lambda: numpy.zeros((12, 10))),
}  # fmt: skip


def refused(result):
    return result.status == BAD_INPUT


def check_contact(found, gap, pressure, tolerance):
    """Signorini's conditions, with the displacement as a plain sum."""
    assert found.status in (CONVERGED, EDGE)
    clear = direct(SMALL, pressure) + gap - found.approach
    scale = float(numpy.ptp(gap)) + abs(found.approach - gap.min())
    assert (pressure >= 0.0).all()
    assert clear.min() > -1e-6 * scale
    assert abs(clear[pressure > 0.0]).max(initial=0.0) < 1e-6 * scale
    assert pressure.sum() * 2e-3 * 2.5e-3 == close(found.load, rel=1e-12)


@holds(field_solver.solve_at_load, **SOLVER, load=st.just(0.0) | positive(0.01, 5.0), **LIMITS, infinite=True, refused=refused,
       outside=({"tolerance": -1e-9}, {"load": -1.0}, {"gap": numpy.zeros((10, 12))}, {"max_iterations": 1.5}))  # fmt: skip
def _(found, half_space, workspace, gap, load, tolerance, max_iterations, pressure):
    check_contact(found, gap, pressure, tolerance)
    assert found.load == close(load, rel=1e-9)


@holds(field_solver.solve_at_approach, **SOLVER, approach=st.floats(-0.1, 0.1005), **LIMITS, infinite=True, refused=refused,
       outside=({"tolerance": -1e-9}, {"pressure": numpy.full((12, 10), -1.0)}))  # fmt: skip
def _(found, half_space, workspace, gap, approach, tolerance, max_iterations, pressure):
    check_contact(found, gap, pressure, tolerance)
    assert found.approach == approach
    assert (found.load > 0.0) == (approach > gap.min())


REQUESTS = st.builds(field_solver.FieldRequest, positive(0.01, 5.0), st.booleans(), st.just(1e-9), st.just(400))


@holds(field_solver.solve, **SOLVER, request=REQUESTS, pressure=LIMITS["pressure"])
def _(found, half_space, workspace, gap, request, pressure):
    if found.status != field_solver.NOT_CONVERGED:
        check_contact(found, gap, pressure, request.tolerance)
        assert (found.load if request.holds_load else found.approach) == close(request.prescribed, rel=1e-9)


@holds(field_solver.make_workspace, half_space=GRID)
def _(found, half_space):
    pressure = numpy.zeros((5, 4))
    gap = numpy.abs(numpy.arange(20.0) - 9.0).reshape(5, 4) * 1e-3 * half_space.cell_x
    load = 1e-3 * half_space.modulus * half_space.cell_x**2
    result = field_solver.solve_at_load(half_space, found, gap, load, 1e-8, 200, pressure)
    assert pressure.sum() * half_space.cell_x * half_space.cell_y == close(result.load, rel=1e-12)


@holds(field_solver.refuse_bad_gap, gap=field(3, 4, -1.0, 1.0))
def _(found, gap):
    assert found is None


@holds(field_solver.first_bad_cell, gap=rows(st.floats(), 6, 6).map(lambda v: v.reshape(2, 3)))
def _(found, gap):
    bad = numpy.flatnonzero(~numpy.isfinite(gap))
    assert found == (bad[0] if bad.size else -1)


# Resultants of a patch


@holds(patch.summarise, pressure=field(4, 3, 0.0, 1e6), cell_x=CELL, cell_y=CELL, origin_x=st.floats(-1.0, 1.0),
       origin_y=st.floats(-1.0, 1.0))  # fmt: skip
def _(found, pressure, cell_x, cell_y, origin_x, origin_y):
    x, y = origin_x + cell_x * numpy.arange(4), origin_y + cell_y * numpy.arange(3)
    total, pressed = pressure.sum(), numpy.pad(pressure > 0.0, 1)
    # Each run of cells along a row or a column is longer or shorter by at most half a cell at either end
    runs = sum(numpy.count_nonzero(pressed & ~numpy.roll(pressed, 1, axis)) for axis in (0, 1))
    assert found.load == close(total * cell_x * cell_y, rel=1e-12)
    assert found.peak == pressure.max()
    assert abs(found.area / (cell_x * cell_y) - pressed.sum()) <= 0.5 * runs + 1e-12
    if total > 0.0:
        assert found.mean == close(found.load / found.area, rel=1e-12)
        assert found.centre_x == close((pressure.sum(axis=1) @ x) / total, abs=1e-9)
        assert found.centre_y == close((pressure.sum(axis=0) @ y) / total, abs=1e-9)


PLACE = numpy.arange(-20, 21) / 20.0
DISC = st.floats(0.5, 0.9).map(lambda a: numpy.sqrt(numpy.maximum(0.0, a**2 - PLACE[:, None] ** 2 - PLACE**2)))


@holds(patch.contact_area, pressure=DISC, cell_x=CELL, cell_y=CELL)
def _(found, pressure, cell_x, cell_y):
    """A Hertz ellipse: its semi-axes are as many cells as its peak has units here, times 20."""
    axes = 20.0 * pressure.max() * numpy.array([cell_x, cell_y])
    assert found == close(math.pi * axes.prod(), rel=0.03)


# Stress below the surface

GRIDS = st.builds(
    subsurface.SurfaceGrid, positive(1e-3, 1e-1), positive(1e-3, 1e-1), st.floats(-0.1, 0.1), st.floats(-0.1, 0.1)
)


@st.composite
def far_points(draw):
    way = draw(numbers(3, -1.0, 1.0))
    way[2] = 0.2 + abs(way[2])
    return (way / numpy.linalg.norm(way))[None, :]


@holds(subsurface.subsurface_stress, grid=GRIDS, poisson=POISSON, points=far_points(), pressure=field(1, 1, -1e6, 1e6),
       traction_x=field(1, 1, -1e6, 1e6), traction_y=field(1, 1, -1e6, 1e6),
       outside=({"points": numpy.array([[0.0, 0.0, -1e-9]])}, {"poisson": 0.501}, {"points": numpy.zeros(3)}))  # fmt: skip
def _(found, grid, poisson, points, pressure, traction_x, traction_y):
    """Far from one cell Boussinesq's and Cerruti's point forces (Johnson 1985, eqs 3.18 and 3.75)."""
    centre = numpy.array([grid.origin_x, grid.origin_y, 0.0])
    away = points / numpy.linalg.norm(points) * 60.0 * max(grid.cell_x, grid.cell_y)
    found = subsurface.subsurface_stress(grid, poisson, centre + away, pressure, traction_x, traction_y)[0]
    x, y, z = away[0]
    r, cell = math.sqrt(x * x + y * y + z * z), grid.cell_x * grid.cell_y
    forces = [float(part[0, 0]) * cell for part in (traction_x, traction_y, pressure)]
    along = (forces[0] * x + forces[1] * y + forces[2] * z) * -3.0 / (2.0 * math.pi * r**5)
    size = sum(abs(f) for f in forces) / r**2 + 1e-300
    xx, yy, zz, _xy, xz, yz = found
    assert (zz, xz, yz) == close((along * z * z, along * x * z, along * y * z), abs=1e-3 * size)
    trace = -(1.0 + poisson) / (math.pi * r**3) * (forces[0] * x + forces[1] * y + forces[2] * z)
    assert xx + yy + zz == close(trace, abs=1e-3 * size)


STRESS = numbers(6, -1e6, 1e6).map(lambda v: v[None, :])
NOT_SIX = ({"stress": numpy.zeros((2, 5))}, {"stress": numpy.zeros(6)})


def tensor(stress):
    xx, yy, zz, xy, xz, yz = stress[0]
    return numpy.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


@holds(subsurface.principal_stresses, stress=STRESS, outside=NOT_SIX)
def _(found, stress):
    """Same trace, same sum of squares, same determinant; the largest first."""
    own, size = tensor(stress), float(abs(stress).max()) + 1e-300
    assert found[0].sum() == close(numpy.trace(own), abs=1e-12 * size)
    assert (found[0] ** 2).sum() == close((own**2).sum(), rel=1e-12, abs=1e-300)
    assert found[0].prod() == close(numpy.linalg.det(own), abs=1e-11 * size**3)
    assert (numpy.diff(found[0]) <= 0.0).all()


@holds(subsurface.von_mises, stress=STRESS, outside=NOT_SIX)
def _(found, stress):
    """The length of the deviator."""
    own = tensor(stress)
    deviator = own - numpy.trace(own) / 3.0 * numpy.eye(3)
    assert found[0] == close(math.sqrt(1.5 * (deviator**2).sum()), rel=1e-9, abs=1e-9 * abs(own).max() + 1e-300)


@holds(subsurface.max_shear, stress=STRESS, outside=NOT_SIX)
def _(found, stress):
    """No plane has more; one at 45 degrees between two principal axes has it."""
    _, axes = numpy.linalg.eigh(tensor(stress))
    normal, along = axes[:, 0] + axes[:, 2], axes[:, 0] - axes[:, 2]
    assert found[0] == close(abs(normal @ tensor(stress) @ along) / 2.0, rel=1e-9, abs=1e-9 * abs(stress).max())


ELLIPSE = st.builds(hertz_stress.EllipseLoad, st.floats(0.5, 2.0), st.floats(0.5, 2.0), positive(1.0, 1e9), st.floats(-0.5, 0.5),
                    st.floats(-0.5, 0.5))  # fmt: skip


@holds(hertz_stress.ellipse_stress, load=ELLIPSE, poisson=POISSON, points=field(2, 3, 0.5, 2.0), examples=10,
       outside=({"points": numpy.array([[0.0, 0.0, -1.0]])}, {"points": numpy.zeros(3)}, {"poisson": 0.51}))  # fmt: skip
def _(found, load, poisson, points):
    """The closed forms of many small rectangles add up to it; at the surface it is what is put on."""
    x, y = (((numpy.arange(60) + 0.5) / 30.0 - 1.0) * half for half in (load.a, load.b))
    p = load.peak_pressure * numpy.sqrt(
        numpy.maximum(0.0, 1.0 - (x[:, None] / load.a) ** 2 - (y[None, :] / load.b) ** 2)
    )
    p *= 2.0 / 3.0 * math.pi * load.a * load.b * load.peak_pressure / (p.sum() * load.a * load.b / 900.0)
    grid = subsurface.SurfaceGrid(load.a / 30.0, load.b / 30.0, x[0], y[0])
    summed = subsurface.subsurface_stress(grid, poisson, points, p, load.traction_x * p, load.traction_y * p)
    assert found == close(summed, abs=1e-3 * load.peak_pressure)
    inside = numpy.array([[0.3 * load.a, 0.4 * load.b, 0.0]])
    there = load.peak_pressure * math.sqrt(0.75)
    on = hertz_stress.ellipse_stress(load, poisson, inside)[0]
    assert on[[2, 4, 5]] == close(
        [-there, -load.traction_x * there, -load.traction_y * there], rel=1e-9, abs=1e-9 * there
    )


@holds(hertz_stress.stress_under_ellipse, load=ELLIPSE, poisson=POISSON, x=st.floats(-3.0, 3.0), y=st.floats(-3.0, 3.0),
       z=st.floats(1e-3, 3.0))  # fmt: skip
def _(found, load, poisson, x, y, z):
    """Equilibrium below the surface, by differences."""
    step = 1e-3 * z

    def at(shift):
        place = numpy.array([[x, y, z]]) + step * numpy.array([shift, [-s for s in shift]])
        return hertz_stress.ellipse_stress(load, poisson, place)

    (dx, dy, dz) = (-numpy.diff(at(axis), axis=0)[0] / (2.0 * step) for axis in numpy.eye(3))
    size = load.peak_pressure / z * 1e-4 + abs(dz).max() * 1e-4
    assert dx[0] + dy[3] + dz[4] == close(0.0, abs=size)
    assert dx[3] + dy[1] + dz[5] == close(0.0, abs=size)
    assert dx[4] + dy[5] + dz[2] == close(0.0, abs=size)
    assert found == close(hertz_stress.ellipse_stress(load, poisson, numpy.array([[x, y, z]]))[0], rel=1e-12)


test_each_holds_over_its_domain, test_each_refuses_what_it_cannot_do, test_each_public_function_has_a_property = (
    TABLE.tests("contact_sim_pkg", MODULES, (halfspace.HalfSpace, halfspace.Buffers, field_solver.SolverWorkspace))
)
