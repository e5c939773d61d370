"""Stress inside an elastic half-space under a field of pressure and tangential traction on its
surface.

Each cell of the field is a uniformly loaded rectangle, whose six stresses have closed forms (Love
1929 for the pressure, integrals of Cerruti's solution for the traction). They are sums over
corners: with u, v, z the way from a corner to the point and r its length, the sum over the cells is
a sum over the corners of the grid, each weighted with the second difference D of the field there.
Pressure, times D / (2 pi), nu = Poisson's ratio:

    zz  -t(uv, zr) - z uv/r (1/(u^2+z^2) + 1/(v^2+z^2))
    xx  -2 nu t(uv, zr) - (1-2nu) t(uv (r-z), u^2 r + z v^2) + z uv / ((u^2+z^2) r),      t(s, c) = atan(s/c), c >= 0
    yy  the same with u and v exchanged
    xy  -(1-2nu) ln(r+z) - z/r,    xz  z^2 v / ((u^2+z^2) r),    yz  z^2 u / ((v^2+z^2) r)

and traction along x, from `3x^2/r^5`, … and the potential `z ln(r+z) - r`:

    zz  z^2 v / ((u^2+z^2) r)      xx  2 asinh(v/w) + u^2 v/(w^2 r) - (1-2nu) v/(r+z),       w^2 = u^2 + z^2
    yz  -z/r                       yy  2 nu asinh(v/w) - v/r + (1-2nu) v/(r+z)
    xz  z uv/(w^2 r) - t(uv, zr)   xy  asinh(u/sqrt(v^2+z^2)) - u/r + (1-2nu) u/(r+z)

Axes: x along rows, y along cols, z into the body, 0 at the surface; stresses are positive in
tension. Pressure is positive into the body, traction is what the partner does to the surface: at z
= 0 `zz = -p`, `xz = -q_x`, `yz = -q_y` in a cell, the mean of its neighbours on an edge. Where the
stress of a jump is infinite (xy at a corner, xx along an edge that crosses the traction) the
logarithm is cut at 1e-9 of a cell; with a smooth field the cut cancels to second order of the cell.
Rounding grows with (distance / cell)^2: 1e-12 of the peak at 100 cells. Stress of a field against
its smooth original: second order in the cell, and largest near the surface.

Sources: Love (1929), Phil. Trans. R. Soc. A 228, 377; Johnson (1985), Contact Mechanics, sections
3.2 and 3.6.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require_values
from contact_sim_pkg.compiled.jit import entry, kernel

__all__ = ["SurfaceGrid", "max_shear", "principal_stresses", "subsurface_stress", "von_mises"]

Field = NDArray[numpy.float64]

CUT = 1e-9
"""Of a cell: closer to a corner the logarithm stays constant."""


class SurfaceGrid(NamedTuple):
    """Where the cells of a surface field lie."""

    cell_x: float  # [m] along rows
    cell_y: float  # [m] along cols
    origin_x: float  # [m] centre of cell (0, 0)
    origin_y: float  # [m]


class Stress(NamedTuple):
    """Six components [Pa], positive in tension; also the contribution of one corner."""

    xx: float
    yy: float
    zz: float
    xy: float
    xz: float
    yz: float


def subsurface_stress(
    grid: SurfaceGrid,
    poisson: float,
    points: Field,
    pressure: Field | None = None,
    traction_x: Field | None = None,
    traction_y: Field | None = None,
) -> Field:
    """Stresses [n, 6] [Pa] at points [n, 3] [m] (x, y, z >= 0); columns xx, yy, zz, xy, xz, yz.

    pressure, traction_x, traction_y: [Pa], [rows, cols], what acts on the surface; `None` for none.
    poisson: nu of the body, -1 < nu <= 0.5. Time: about 0.1 us for each point and corner where the
    field is not level. Raises `ValueError` for wrong shapes, points above the surface and values
    that are not finite.
    """
    _refuse_grid(grid, poisson)
    points = numpy.ascontiguousarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"subsurface: points are {points.shape}, they must be [n, 3]")
    _refuse_points(points)
    stress = numpy.zeros((points.shape[0], 6))
    nu, cell_x, cell_y = float(poisson), float(grid.cell_x), float(grid.cell_y)
    start_x, start_y = float(grid.origin_x - 0.5 * grid.cell_x), float(grid.origin_y - 0.5 * grid.cell_y)
    corners = SurfaceGrid(cell_x, cell_y, start_x, start_y)
    if pressure is not None:
        weight = _corner_weights(pressure, "pressure")
        add_stresses(weight, corners, nu, False, points, stress)
    if traction_x is not None:
        weight = _corner_weights(traction_x, "traction_x")
        add_stresses(weight, corners, nu, True, points, stress)
    if traction_y is not None:
        # Along y: x and y are exchanged, in the field, the points and the stresses.
        exchanged, out = numpy.ascontiguousarray(points[:, [1, 0, 2]]), numpy.zeros(stress.shape)
        weight = numpy.ascontiguousarray(_corner_weights(traction_y, "traction_y").T)
        add_stresses(weight, SurfaceGrid(cell_y, cell_x, start_y, start_x), nu, True, exchanged, out)
        stress += out[:, [1, 0, 2, 3, 5, 4]]
    return stress


def principal_stresses(stress: Field) -> Field:
    """Principal stresses [n, 3] [Pa], largest (most tensile) first, of stresses [n, 6] in the order
    of `Stress`.

    Raises `ValueError` for another shape and values that are not finite.
    """
    xx, yy, zz, xy, xz, yz = _components(stress)
    tensor = numpy.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=-1).reshape(-1, 3, 3)
    return numpy.asarray(numpy.linalg.eigvalsh(tensor)[:, ::-1])


def von_mises(stress: Field) -> Field:
    """`sqrt(((xx-yy)^2 + (yy-zz)^2 + (zz-xx)^2)/2 + 3 (xy^2 + xz^2 + yz^2))` [n] [Pa] of stresses
    [n, 6].

    Errors as `principal_stresses`.
    """
    xx, yy, zz, xy, xz, yz = _components(stress)
    normal = 0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2)
    return numpy.asarray(numpy.sqrt(normal + 3.0 * (xy**2 + xz**2 + yz**2)))


def max_shear(stress: Field) -> Field:
    """Largest shear stress over all planes [n] [Pa]: half of the largest less the smallest
    principal stress.

    stress: [n, 6] [Pa]. Errors as `principal_stresses`.
    """
    principal = principal_stresses(stress)
    return numpy.asarray(0.5 * (principal[:, 0] - principal[:, 2]))


def _components(stress: Field) -> Field:
    """[6, n] of stresses [n, 6]."""
    return require_values("subsurface: stress", stress, "Pa", shape=(None, 6)).T


@entry
def add_stresses(
    weight: Field, corners: SurfaceGrid, poisson: float, tangential: bool, points: Field, stress: Field
) -> None:
    """Add the stresses of a pressure, or of a traction along x (`tangential`), to `stress` [n, 6]
    [Pa].

    weight: second differences D [rows+1, cols+1] [Pa] at the `corners` of the cells; points: [n, 3]
    [m].
    """
    rows, cols = weight.shape
    cell_x, cell_y, start_x, start_y = corners
    cut = CUT * min(cell_x, cell_y)
    for k in range(points.shape[0]):
        # Sum over the corners with a second difference.
        x, y, z = points[k, 0] - start_x, points[k, 1] - start_y, points[k, 2]
        xx, yy, zz, xy, xz, yz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for i in range(rows):
            for j in range(cols):
                share = weight[i, j]
                if share != 0.0:
                    u, v = x - i * cell_x, y - j * cell_y
                    corner = (
                        traction_corner(u, v, z, poisson, cut) if tangential else pressure_corner(u, v, z, poisson, cut)
                    )
                    xx += share * corner.xx
                    yy += share * corner.yy
                    zz += share * corner.zz
                    xy += share * corner.xy
                    xz += share * corner.xz
                    yz += share * corner.yz
        add_row(stress, k, Stress(xx, yy, zz, xy, xz, yz))


@kernel
def pressure_corner(u: float, v: float, z: float, poisson: float, cut: float) -> Stress:
    """Contribution of a corner, times 2 pi, for a unit second difference of the pressure.

    u, v, z: [m] from the corner to the point; cut: [m].
    """
    uu, vv, zz = u * u, v * v, z * z
    r = math.sqrt(uu + vv + zz)
    soft = 1.0 - 2.0 * poisson
    depth = math.atan2(u * v, z * r)
    lift = (uu + vv) / (r + z) if r > 0.0 else 0.0  # r - z without loss of digits
    along = math.atan2(u * v * lift, uu * r + z * vv)
    across = math.atan2(u * v * lift, vv * r + z * uu)
    spread = -soft * math.log(max(r + z, cut))
    if z == 0.0:
        return Stress(
            -2.0 * poisson * depth - soft * along, -2.0 * poisson * depth - soft * across, -depth, spread, 0.0, 0.0
        )
    bend_x, bend_y = z / ((uu + zz) * r), z / ((vv + zz) * r)
    return Stress(
        -2.0 * poisson * depth - soft * along + u * v * bend_x,
        -2.0 * poisson * depth - soft * across + u * v * bend_y,
        -depth - u * v * (bend_x + bend_y),
        spread - z / r,
        z * v * bend_x,
        z * u * bend_y,
    )


@kernel
def traction_corner(u: float, v: float, z: float, poisson: float, cut: float) -> Stress:
    """Contribution of a corner, times 2 pi, for a unit second difference of the traction along
    x.

    u, v, z: [m] from the corner to the point; cut: [m].
    """
    uu, vv, zz = u * u, v * v, z * z
    r = math.sqrt(uu + vv + zz)
    soft = 1.0 - 2.0 * poisson
    # Logarithms, cut close to the corner.
    log_v = math.asinh(v / max(math.sqrt(uu + zz), cut))
    log_u = math.asinh(u / max(math.sqrt(vv + zz), cut))
    if r == 0.0:
        return Stress(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    lean_u, lean_v = soft * u / (r + z), soft * v / (r + z)
    xy = log_u - u / r + lean_u
    yy = 2.0 * poisson * log_v - v / r + lean_v
    depth = math.atan2(u * v, z * r)
    # On the surface.
    if z == 0.0:
        return Stress(2.0 * log_v + v / r - lean_v, yy, 0.0, xy, -depth, 0.0)
    bend = 1.0 / ((uu + zz) * r)
    return Stress(
        2.0 * log_v + uu * v * bend - lean_v,
        yy,
        zz * v * bend,
        xy,
        z * u * v * bend - depth,
        -z / r,
    )


@kernel
def add_row(stress: Field, row: int, part: Stress) -> None:
    """Add one point's sums, divided by 2 pi.

    stress: [n, 6] [Pa].
    """
    scale = 0.5 / math.pi
    stress[row, 0] += scale * part.xx
    stress[row, 1] += scale * part.yy
    stress[row, 2] += scale * part.zz
    stress[row, 3] += scale * part.xy
    stress[row, 4] += scale * part.xz
    stress[row, 5] += scale * part.yz


def _corner_weights(field: Field, name: str) -> Field:
    """Second differences [rows+1, cols+1] of a field with nothing around it."""
    field = numpy.asarray(field, dtype=float)
    if field.ndim != 2:
        raise ValueError(f"subsurface: {name} is {field.shape}, it must be [rows, cols]")
    if not numpy.all(numpy.isfinite(field)):
        row, col = numpy.argwhere(~numpy.isfinite(field))[0]
        raise ValueError(f"subsurface: {name} of row {row}, column {col} is {field[row, col]}, it must be finite")
    return numpy.ascontiguousarray(numpy.diff(numpy.diff(numpy.pad(field, 1), axis=0), axis=1))


def _refuse_grid(grid: SurfaceGrid, poisson: float) -> None:
    for name, value in (("cell_x", grid.cell_x), ("cell_y", grid.cell_y)):
        if not 0.0 < value < math.inf:
            raise ValueError(f"subsurface: {name} is {value} m, it must be a finite number above 0")
    if not (math.isfinite(grid.origin_x) and math.isfinite(grid.origin_y)):
        raise ValueError(f"subsurface: origin ({grid.origin_x}, {grid.origin_y}) m, both must be finite")
    if not -1.0 < poisson <= 0.5:
        raise ValueError(f"subsurface: Poisson's ratio is {poisson}, allowed are -1 (excluded) to 0.5")


def _refuse_points(points: Field) -> None:
    bad = ~(numpy.isfinite(points).all(axis=1) & (points[:, 2] >= 0.0))
    if bad.any():
        number = int(numpy.argmax(bad))
        raise ValueError(f"subsurface: point {number} is {points[number].tolist()} m, it must be finite with z >= 0")
