"""Dangerous volumes: where a stress passes its limit, for each component and for any of them (eqs
22 to 24).

`V_ij` is the volume with `|sigma_ij| > limit`, that of normal stress for i = j, of shear for i !=
j; `V_T` that of the union. The print has `sigma - limit > 0`, which is empty for the pressure. They
are measured in the box `4 a x 4 b x 3 a` under the contact (a the larger semi-axis), on columns of
cells. In each column the stress is known at depths that draw closer to the surface, from the
surface itself on. The depth at which it passes the limit is laid straight between two of them, the
stress is taken there, and the lines from there both ways decide (`INTERPOLATED`): the columns then
limit the accuracy, 1e-3 of V_T with 48 x 60 of 12 depths. Or the stress is known at the middles of
even cells, and whole cells are counted (`COUNTED`).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import (
    require,
    require_choice,
    require_count,
    require_fields,
    require_poisson_ratio,
)
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.pressure.closed_form.subsurface import Stress
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact
from contact_sim_pkg.rigs.roller.theory.parameters import Bending
from contact_sim_pkg.rigs.roller.theory.stress import add_bending, bench_stress, bench_stresses

__all__ = [
    "COUNTED",
    "INTERPOLATED",
    "Volumes",
    "box_volume",
    "dangerous_volumes",
    "fills_box",
    "largest_ratio",
    "leaves_box",
]

Values = NDArray[numpy.float64]

COUNTED, INTERPOLATED = 0, 1

COMPONENTS = 6

GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
"""Of a cell: each line of columns lies so much further along than the one before, so that the edge
of a volume does not meet them all at the same place of their cells.
"""

EDGE_PLACES = 33
"""Each way on a side of the box, where it is checked whether a volume leaves it."""

GRADING = 0.4
"""Of the smaller semi-axis: down to about it the depths of a column are even, below they grow by a
factor.
"""


class Volumes(NamedTuple):
    """[m^3]."""

    xx: float
    yy: float
    zz: float
    xy: float
    xz: float
    yz: float
    any: float  # V_T, of the union


class Loading(NamedTuple):
    """What acts beside the pressure, and what the material bears."""

    traction_x: float  # over pressure
    traction_y: float  # over pressure
    poisson: float
    normal: float  # [Pa] limit of normal stress
    shear: float  # [Pa] limit of shear stress


def _loading(poisson: float, limits: tuple[float, float], traction: tuple[float, float]) -> Loading:
    return Loading(float(traction[0]), float(traction[1]), float(poisson), float(limits[0]), float(limits[1]))


def box_volume(contact: RollingContact) -> float:
    """Volume [m^3] of the box under a contact."""
    a, b = max(contact.along_x, contact.along_y), min(contact.along_x, contact.along_y)
    return 48.0 * a * a * b


def fills_box(volumes: Volumes, contact: RollingContact) -> bool:
    """Whether a dangerous volume has filled its box: the true one reaches farther, its limit is too
    low for the box.
    """
    return contact.load > 0.0 and volumes.any > (1.0 - 1e-9) * box_volume(contact)


def dangerous_volumes(
    contact: RollingContact,
    poisson: float,
    limits: tuple[float, float],
    cells: tuple[int, int, int] = (48, 60, 12),
    bending: Bending | None = None,
    traction: tuple[float, float] = (0.0, 0.0),
    kind: int = INTERPOLATED,
) -> Volumes:
    """Volumes [m^3] where the stress of contact, traction and bending (None: without) passes the
    limits [Pa] (normal, shear).

    contact: of `contact_of_rollers`; all are 0 where its load is. cells: along x, y and depth.
    Raises `ValueError` for limits that are not above 0 (they may be infinite), fewer than two
    cells, a Poisson ratio outside -1 < nu <= 1/2 and values not finite.
    """
    _check(poisson, limits, cells, bending, traction)
    require_choice("dangerous volumes: kind", kind, (COUNTED, INTERPOLATED))
    # Volumes of each component and of their union.
    out = numpy.zeros(COMPONENTS + 1)
    if contact.load > 0.0:
        loading = _loading(poisson, limits, traction)
        _measure(contact, bending, loading, cells, kind, out)
    return Volumes(*(float(value) for value in out))


@entry
def _measure(
    contact: RollingContact, bending: Bending | None, loading: Loading, cells: tuple[int, int, int], kind: int, out: Values
) -> None:  # fmt: skip
    nx, ny, nz = cells
    length, width = 4.0 * contact.along_x, 4.0 * contact.along_y
    depth = 3.0 * max(contact.along_x, contact.along_y)
    ground = length * width / (nx * ny)
    now, above, at = numpy.zeros(COMPONENTS + 1), numpy.zeros(COMPONENTS + 1), numpy.zeros(COMPONENTS + 1)
    for i in range(nx):
        # Each column of the box, down from the surface.
        x = ((i + 0.5) / nx - 0.5) * length
        for j in range(ny):
            y = ((j + (0.5 if kind == COUNTED else _stagger(i))) / ny - 0.5) * width
            before = 0.0
            for k in range(nz + 1 if kind == INTERPOLATED else nz):
                z = _depth(contact, k, nz) if kind == INTERPOLATED else depth * (k + 0.5) / nz
                _excess(_stress_at(contact, bending, loading, x, y, z), loading, now)
                for c in range(COMPONENTS + 1):
                    # Whole cells, or the part of the depth between two values.
                    if kind == COUNTED:
                        out[c] += ground * depth / nz if now[c] > 0.0 else 0.0
                    elif k > 0 and now[c] > 0.0 and above[c] > 0.0:
                        out[c] += ground * (z - before)
                    elif k > 0 and (now[c] > 0.0) != (above[c] > 0.0):
                        # Where the straight line crosses, the stress itself: lines from there both ways.
                        part = _share(now[c], above[c])
                        place = before + (z - before) * (part if above[c] > 0.0 else 1.0 - part)
                        _excess(_stress_at(contact, bending, loading, x, y, place), loading, at)
                        inside = (place - before) * _share(at[c], above[c]) + (z - place) * _share(now[c], at[c])
                        out[c] += ground * inside
                for c in range(COMPONENTS + 1):
                    above[c] = now[c]
                before = z


def leaves_box(
    contact: RollingContact, poisson: float, limits: tuple[float, float], traction: tuple[float, float] = (0.0, 0.0)
) -> bool:
    """Whether a place on a side or the floor of the box is dangerous: the true volume is larger
    than the one in the box.

    Errors as `dangerous_volumes`.
    limits: [Pa]; traction: [1].
    """
    _check(poisson, limits, (2, 2, 2), None, traction)
    if not contact.load > 0.0:
        return False
    # Points on the four sides and the floor of the box.
    a, b, deepest = contact.along_x, contact.along_y, 3.0 * max(contact.along_x, contact.along_y)
    across, depths = numpy.linspace(-2.0, 2.0, EDGE_PLACES), deepest * numpy.linspace(0.0, 1.0, EDGE_PLACES) ** 2
    u, v = (part.ravel() for part in numpy.meshgrid(across, across))
    s, z = (part.ravel() for part in numpy.meshgrid(across, depths))
    sides = [numpy.stack([sign * 2.0 * a + 0.0 * s, b * s, z], axis=1) for sign in (-1.0, 1.0)]
    sides += [numpy.stack([a * s, sign * 2.0 * b + 0.0 * s, z], axis=1) for sign in (-1.0, 1.0)]
    points = numpy.concatenate([numpy.stack([a * u, b * v, numpy.full_like(u, deepest)], axis=1), *sides])
    stress = numpy.zeros((len(points), COMPONENTS))
    bench_stresses(contact, None, *traction, poisson, points, stress)
    return bool((abs(stress) > numpy.repeat(limits, 3)).any())


def largest_ratio(
    contact: RollingContact, poisson: float, limits: tuple[float, float], cells: tuple[int, int, int],
    bending: Bending | None = None, traction: tuple[float, float] = (0.0, 0.0),
) -> float:  # fmt: skip
    """Largest stress over its limit at the places where `dangerous_volumes` looks; without bending
    it grows as load^(1/3).

    0 without load. Errors as `dangerous_volumes`.
    limits: [Pa]; traction and the result: [1].
    """
    _check(poisson, limits, cells, bending, traction)
    if not contact.load > 0.0:
        return 0.0
    return float(_largest(contact, bending, _loading(poisson, limits, traction), cells))


def _check(
    poisson: float, limits: tuple[float, float], cells: tuple[int, int, int], bending: Bending | None,
    traction: tuple[float, float],
) -> None:  # fmt: skip
    require_poisson_ratio(poisson)
    for name, limit in zip(("normal", "shear"), limits, strict=True):
        require(f"dangerous volumes: limit of {name} stress", limit, "Pa", above=0.0, infinite=True)
    for name, count in zip(("x", "y", "depth"), cells, strict=True):
        require_count(f"dangerous volumes: cells along {name}", count, least=2)
    for name, part in zip(("x", "y"), traction, strict=True):
        require(f"dangerous volumes: traction along {name}", part)
    if bending is not None:
        finite = "load contact_distance load_distance friction"
        require_fields("bending", bending, positive="radius second_moment", finite=finite)


@entry
def _largest(contact: RollingContact, bending: Bending | None, loading: Loading, cells: tuple[int, int, int]) -> float:
    nx, ny, nz = cells
    largest, now = -1.0, numpy.zeros(COMPONENTS + 1)
    for i in range(nx):
        x = ((i + 0.5) / nx - 0.5) * 4.0 * contact.along_x
        for j in range(ny):
            y = ((j + _stagger(i)) / ny - 0.5) * 4.0 * contact.along_y
            for k in range(nz + 1):
                z = _depth(contact, k, nz)
                _excess(_stress_at(contact, bending, loading, x, y, z), loading, now)
                largest = max(largest, now[COMPONENTS])
    return 1.0 + largest


@kernel
def _stress_at(
    contact: RollingContact, bending: Bending | None, loading: Loading, x: float, y: float, z: float
) -> Stress:
    """Stress [Pa] of contact, traction and bending at a point [m]."""
    stress = bench_stress(contact, loading.traction_x, loading.traction_y, loading.poisson, x, y, z)
    return add_bending(stress, bending, x, z)


@kernel
def _excess(stress: Stress, loading: Loading, out: Values) -> None:
    """Each component over its limit, less 1, and the largest of them."""
    normal, shear = loading.normal, loading.shear
    out[0], out[1], out[2] = abs(stress.xx) / normal, abs(stress.yy) / normal, abs(stress.zz) / normal
    out[3], out[4], out[5] = abs(stress.xy) / shear, abs(stress.xz) / shear, abs(stress.yz) / shear
    largest = 0.0
    for c in range(COMPONENTS):
        out[c] -= 1.0
        largest = out[c] if c == 0 else max(largest, out[c])
    out[COMPONENTS] = largest


@kernel
def _stagger(i: int) -> float:
    """Place of the columns of line i in their cells, 0 to 1."""
    return float((0.5 + GOLDEN * i) % 1.0)


@kernel
def _depth(contact: RollingContact, k: int, nz: int) -> float:
    """Of place k of nz, from 0 to that of the box: however slender the ellipse, its smaller axis is
    resolved.
    """
    scale = GRADING * min(contact.along_x, contact.along_y)
    deepest = 3.0 * max(contact.along_x, contact.along_y)
    return scale * math.sinh(k / nz * math.asinh(deepest / scale))


@kernel
def _share(now: float, above: float) -> float:
    """Of the way between two depths: the part on which the excess, laid straight between them, is
    above 0.
    """
    if now > 0.0 and above > 0.0:
        return 1.0
    if now <= 0.0 and above <= 0.0:
        return 0.0
    return float(max(now, above) / abs(now - above))
