"""Dangerous volumes: where a stress passes its limit, for each component and for any of them (eqs 22 to 24).

`V_ij` is the volume with `|sigma_ij| > limit`, that of normal stress for i = j, of shear for i != j; `V_T` that of the union. The
print has `sigma - limit > 0`, which is empty for the pressure. They are measured in the box `4 a x 4 b x 3 a` under the contact
(a the larger semi-axis), on columns of cells: in each column the stress is known at the cells' middles, and the depth at which it
passes the limit is laid straight between two of them (`MARCHED`), or whole cells are counted (`COUNTED`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.core.jit import entry, kernel
from contact_sim_pkg.core.roller.ellipse import RollingContact
from contact_sim_pkg.core.roller.parameters import Bending
from contact_sim_pkg.core.roller.stress import add_bending, bench_stress
from contact_sim_pkg.core.subsurface import Stress

__all__ = ["COUNTED", "MARCHED", "Volumes", "box_volume", "dangerous_volumes", "fills_box"]

Values = NDArray[numpy.float64]

COUNTED, MARCHED = 0, 1

COMPONENTS = 6


class Volumes(NamedTuple):
    """[m^3]."""

    xx: float
    yy: float
    zz: float
    xy: float
    xz: float
    yz: float
    any: float  # V_T, of the union


def box_volume(contact: RollingContact) -> float:
    """Volume [m^3] of the box under a contact."""
    a, b = max(contact.along_x, contact.along_y), min(contact.along_x, contact.along_y)
    return 48.0 * a * a * b


def fills_box(volumes: Volumes, contact: RollingContact) -> bool:
    """Whether a dangerous volume has filled its box: the true one reaches farther, its limit is too low for the box."""
    return contact.load > 0.0 and volumes.any > (1.0 - 1e-9) * box_volume(contact)


def dangerous_volumes(
    contact: RollingContact,
    poisson: float,
    limits: tuple[float, float],
    cells: tuple[int, int, int] = (32, 40, 16),
    bending: Bending | None = None,
    traction: tuple[float, float] = (0.0, 0.0),
    kind: int = MARCHED,
) -> Volumes:
    """Volumes [m^3] where the stress of contact, traction and bending (None: without) passes the limits [Pa] (normal, shear).

    cells: along x, y and depth. Raises `ValueError` for limits that are not above 0 and fewer than two cells.
    """
    if not min(limits) > 0.0:
        raise ValueError(f"dangerous volumes: the limits are {limits[0]} and {limits[1]} Pa, they must be above 0")
    if min(cells) < 2:
        raise ValueError(f"dangerous volumes: {cells} cells, at least 2 each way")
    out = numpy.zeros(COMPONENTS + 1)
    if contact.load > 0.0:
        normal, shear = float(limits[0]), float(limits[1])
        _measure(contact, bending, float(traction[0]), float(traction[1]), poisson, normal, shear, *cells, kind, out)
    return Volumes(*(float(value) for value in out))


@entry
def _measure(
    contact: RollingContact, bending: Bending | None, traction_x: float, traction_y: float, poisson: float,
    normal: float, shear: float, nx: int, ny: int, nz: int, kind: int, out: Values,
) -> None:  # fmt: skip
    length, width = 4.0 * contact.along_x, 4.0 * contact.along_y
    depth = 3.0 * max(contact.along_x, contact.along_y)
    cell = length * width * depth / (nx * ny * nz)
    now, above = numpy.zeros(COMPONENTS + 1), numpy.zeros(COMPONENTS + 1)
    for i in range(nx):
        x = ((i + 0.5) / nx - 0.5) * length
        for j in range(ny):
            y = ((j + 0.5) / ny - 0.5) * width
            for k in range(nz):
                z = (k + 0.5) / nz * depth
                stress = add_bending(bench_stress(contact, traction_x, traction_y, poisson, x, y, z), bending, x, z)
                _excess(stress, normal, shear, now)
                for c in range(COMPONENTS + 1):
                    out[c] += cell * _share(now[c], above[c], k, nz, kind)
                    above[c] = now[c]


@kernel
def _excess(stress: Stress, normal: float, shear: float, out: Values) -> None:
    """Each component over its limit, less 1, and the largest of them."""
    out[0], out[1], out[2] = abs(stress.xx) / normal, abs(stress.yy) / normal, abs(stress.zz) / normal
    out[3], out[4], out[5] = abs(stress.xy) / shear, abs(stress.xz) / shear, abs(stress.yz) / shear
    largest = 0.0
    for c in range(COMPONENTS):
        out[c] -= 1.0
        largest = out[c] if c == 0 else max(largest, out[c])
    out[COMPONENTS] = largest


@kernel
def _share(now: float, above: float, k: int, nz: int, kind: int) -> float:
    """Of a cell: counted, or the part of the way from the middle above to this one; half cells at both ends of the column."""
    if kind == COUNTED:
        return 1.0 if now > 0.0 else 0.0
    if k == 0:
        return 0.5 if now > 0.0 else 0.0
    end = 0.5 if k == nz - 1 and now > 0.0 else 0.0
    if now > 0.0 and above > 0.0:
        return 1.0 + end
    if now <= 0.0 and above <= 0.0:
        return 0.0
    return max(now, above) / abs(now - above) + end
