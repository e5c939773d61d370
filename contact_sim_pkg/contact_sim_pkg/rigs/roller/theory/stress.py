"""State of stress in the shaft under the rolling contact, in the axes of the bench: contact,
traction and bending (eq 21).

x along the shaft, y along rolling, z into the shaft from its surface. The contact part is that of
`pressure/closed_form/hertz_stress.py` in the axes of the ellipse, turned back; bending adds `xx = Q
(A - l + x) (r - z) / J_y`. Traction follows the directions of the bench.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.pressure.closed_form.hertz_stress import EllipseLoad, stress_under_ellipse
from contact_sim_pkg.pressure.closed_form.subsurface import Stress
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact
from contact_sim_pkg.rigs.roller.theory.parameters import Bending

__all__ = ["add_bending", "bench_stress", "bench_stresses"]

Values = NDArray[numpy.float64]


@kernel
def bench_stress(
    contact: RollingContact, traction_x: float, traction_y: float, poisson: float, x: float, y: float, z: float
) -> Stress:
    """Contact stress [Pa] at a point [m]; traction_x, traction_y: q / p along the axes of the
    bench. Not checked.
    """
    if contact.load <= 0.0:
        return Stress(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    c, s = math.cos(contact.angle), math.sin(contact.angle)
    load = EllipseLoad(
        contact.along_x, contact.along_y, contact.peak_pressure, c * traction_x + s * traction_y,
        c * traction_y - s * traction_x,
    )  # fmt: skip
    own = stress_under_ellipse(load, poisson, c * x + s * y, c * y - s * x, z)
    return Stress(
        c * c * own.xx + s * s * own.yy - 2.0 * c * s * own.xy, s * s * own.xx + c * c * own.yy + 2.0 * c * s * own.xy,
        own.zz, c * s * (own.xx - own.yy) + (c * c - s * s) * own.xy, c * own.xz - s * own.yz, s * own.xz + c * own.yz,
    )  # fmt: skip


@kernel
def add_bending(stress: Stress, bending: Bending | None, x: float, z: float) -> Stress:
    """The stress with the bending of the shaft; zero below its middle is not treated separately.
    Not checked.

    x, z: [m]; the result: [Pa].
    """
    if bending is None:
        return stress
    arm = bending.contact_distance - bending.load_distance + x
    more = bending.load * arm * (bending.radius - z) / bending.second_moment
    return Stress(stress.xx + more, stress.yy, stress.zz, stress.xy, stress.xz, stress.yz)


@entry
def bench_stresses(
    contact: RollingContact, bending: Bending | None, traction_x: float, traction_y: float, poisson: float,
    points: Values, out: Values,
) -> None:  # fmt: skip
    """Stresses [n, 6] [Pa] (xx, yy, zz, xy, xz, yz) at `points` [n, 3] [m], into `out`. Not
    checked.
    """
    for i in range(points.shape[0]):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        stress = add_bending(bench_stress(contact, traction_x, traction_y, poisson, x, y, z), bending, x, z)
        out[i, 0], out[i, 1], out[i, 2] = stress.xx, stress.yy, stress.zz
        out[i, 3], out[i, 4], out[i, 5] = stress.xy, stress.xz, stress.yz
