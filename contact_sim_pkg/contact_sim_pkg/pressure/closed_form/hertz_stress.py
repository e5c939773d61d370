"""Stress inside an elastic half-space under a Hertz ellipse of pressure and traction, by one smooth
integral a point.

The pressure is `p = p0 sqrt(1 - x^2/a^2 - y^2/b^2)`, the traction `q_x = f_x p`, `q_y = f_y p`.
Boussinesq's and Cerruti's potentials of the ellipse are integrals over the confocal ellipsoids,
from the one through the point to infinity. With

    P = 1/(a^2 + s),  Q = 1/(b^2 + s),  Z^2 = s (1 - x^2 P - y^2 Q),  dm = ds / sqrt((a^2 + s)(b^2 +
    s) s),  C = pi a b p0

and lambda the largest root of `x^2 P + y^2 Q + z^2/s = 1`, where Z = z:

    psi    = C/2 int (1 - x^2 P - y^2 Q - z^2/s) dm           potential of the pressure
    psi1_x = -C x int (Z - z) P dm                            psi1_z = psi
    F_x    = -C x int (Z - z)^2 / 2 P dm                      F_z = psi1

All three are harmonic, so six integrals give every derivative that the stresses need. With u = x s
P, v = y s Q:

    normal      xx  2 nu psi_z - z psi_xx - (1 - 2 nu) psi1_xx      zz  psi_z - z psi_zz      xz  -z
    psi_xz
                xy  -(1 - 2 nu) psi1_xy - z psi_xy
    along x     xx  2 (1 + nu) psi_x + 2 nu F_xxx - z psi1_xxx      zz  -z psi_xz             xz
    psi_z - z psi_xx
                yy  2 nu psi_x + 2 nu F_xyy - z psi1_xyy            yz  -z psi_xy             xy
                psi_y + 2 nu F_xxy - z psi1_xxy

each over 2 pi. The integral is taken in q with `s = lambda + (l sinh q)^2`, l the depth at which
the integrand turns, in panels of twelve Gauss points: 1e-8 of p0 in the stress at any depth, 1 to 2
us a point.

Axes: x and y along the semi-axes a and b, z into the body; stresses are positive in tension and the
surface has `zz = -p`, `xz = -q_x`, `yz = -q_y`. Sources: Johnson (1985), Contact Mechanics,
sections 3.2 and 3.6; psi1 and F come from psi by a change of the order of integration.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.pressure.closed_form.subsurface import Stress

__all__ = ["EllipseLoad", "ellipse_stress", "stress_under_ellipse"]

Values = NDArray[numpy.float64]

NODES, WEIGHTS = (tuple(float(value) for value in part) for part in numpy.polynomial.legendre.leggauss(12))

PANEL = 3.0
"""Largest length in q of a panel: 3e-10 of its integral."""

FARTHEST = 3e4
"""Times a: what lies beyond adds less than 1e-9."""

SURFACE = 1e-9
"""Of b: a point nearer to the surface lies on it."""


class EllipseLoad(NamedTuple):
    """A Hertz ellipse and what slides on it."""

    a: float  # [m] semi-axis along x, > 0
    b: float  # [m] along y, > 0; either may be the larger
    peak_pressure: float  # [Pa], >= 0
    traction_x: float  # [1] q_x / p
    traction_y: float  # [1] q_y / p


class Integrals(NamedTuple):
    """Over the ellipsoids, each without C."""

    p: float  # int P dm
    q: float  # int Q dm
    s: float  # int dm / s
    xx: float  # psi1_xx
    xy: float  # psi1_xy
    f_xxx: float
    f_xxy: float
    f_yyy: float
    f_yyx: float
    xxx: float  # psi1_xxx without its term at lambda
    xxy: float
    yyy: float
    yyx: float


def ellipse_stress(load: EllipseLoad, poisson: float, points: Values) -> Values:
    """Stresses [n, 6] [Pa] at `points` [n, 3] [m] (z >= 0); columns xx, yy, zz, xy, xz, yz.

    poisson: -1 < nu <= 0.5. Raises `ValueError` for axes that are not above 0, points above the
    surface, values not finite.
    """
    points = numpy.ascontiguousarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"Hertz ellipse: points are {points.shape}, they must be [n, 3]")
    if not (numpy.isfinite(points).all() and numpy.isfinite(load).all()):
        raise ValueError("Hertz ellipse: points and load must be finite")
    if min(load.a, load.b) <= 0.0 or load.peak_pressure < 0.0:
        raise ValueError(
            f"Hertz ellipse: a = {load.a} m and b = {load.b} m must be above 0, p0 = {load.peak_pressure} Pa at least 0"
        )
    if not -1.0 < poisson <= 0.5:
        raise ValueError(f"Hertz ellipse: Poisson's ratio is {poisson}, allowed are -1 to 0.5")
    if len(points) and points[:, 2].min() < 0.0:
        row = int(points[:, 2].argmin())
        raise ValueError(f"Hertz ellipse: point {row} has z = {points[row, 2]} m, it must be at least 0")
    # One integral a point, compiled
    out = numpy.empty((len(points), 6))
    _fill(EllipseLoad(*(float(value) for value in load)), float(poisson), points, out)
    return out


@entry
def _fill(load: EllipseLoad, poisson: float, points: Values, out: Values) -> None:
    for i in range(points.shape[0]):
        stress = stress_under_ellipse(load, poisson, points[i, 0], points[i, 1], points[i, 2])
        out[i, 0], out[i, 1], out[i, 2] = stress.xx, stress.yy, stress.zz
        out[i, 3], out[i, 4], out[i, 5] = stress.xy, stress.xz, stress.yz


@kernel
def stress_under_ellipse(load: EllipseLoad, poisson: float, x: float, y: float, z: float) -> Stress:
    """`ellipse_stress` at one point, for compiled callers. Not checked.

    x, y, z: [m], z >= 0 into the body; the result: [Pa].
    """
    # Lengths in units of the smaller semi-axis, stresses in units of p0.
    unit = min(load.a, load.b)
    a2, b2 = (load.a / unit) ** 2, (load.b / unit) ** 2
    x, y, z = x / unit, y / unit, z / unit
    outside = x * x / a2 + y * y / b2 > 1.0
    # Beside the ellipse the integrals have a layer at the surface that a depth of 0 leaves out
    if z < SURFACE:
        z = SURFACE if outside else 0.0
    root = _confocal(a2, b2, x, y, z)
    integrals = _integrate(a2, b2, x, y, z, root)
    scale = 0.5 * math.sqrt(a2 * b2) * load.peak_pressure
    if z == 0.0:
        pressure = math.sqrt(max(0.0, 1.0 - x * x / a2 - y * y / b2)) / (0.5 * math.sqrt(a2 * b2))
        return _on_surface(load, poisson, x, y, pressure, integrals, scale)
    return _inside(load, poisson, a2=a2, b2=b2, x=x, y=y, z=z, root=root, i=integrals, scale=scale)


@kernel
def _confocal(a2: float, b2: float, x: float, y: float, z: float) -> float:
    """Largest root of `x^2/(a2 + s) + y^2/(b2 + s) + z^2/s = 1`, 0 on the ellipse itself.

    Newton from above on `s (1 - x^2/(a2 + s) - y^2/(b2 + s)) = z^2`, whose left side is convex and
    rises at that root.
    """
    root = x * x + y * y + z * z
    for _ in range(200):
        p, q = 1.0 / (a2 + root), 1.0 / (b2 + root)
        left = 1.0 - x * x * p - y * y * q
        step = (root * left - z * z) / (left + root * (x * x * p * p + y * y * q * q))
        if not step > 1e-15 * root:
            break
        root -= step
    return root if z > 0.0 else 0.0


@kernel
def _integrate(a2: float, b2: float, x: float, y: float, z: float, root: float) -> Integrals:
    """The integrals from `root` to infinity."""
    # Panels of equal width in the variable that resolves the transition of the integrand.
    p0, q0 = 1.0 / (a2 + root), 1.0 / (b2 + root)
    turn = _turning(a2, b2, x, y, z, root)
    end = math.asinh(FARTHEST * math.sqrt(max(a2, b2)) / turn)
    panels = int(end / PANEL) + 1
    half = 0.5 * end / panels
    i_p = i_q = i_s = i_xx = i_xy = f_xxx = f_xxy = f_yyy = f_yyx = xxx = xxy = yyy = yyx = 0.0
    for k in range(panels):
        for i in range(len(NODES)):
            # Gauss point: the variable w, and the factors that the integrals share.
            grown = math.exp(half * (2 * k + 1 + NODES[i]))
            w, slope = 0.5 * turn * (grown - 1.0 / grown), 0.5 * turn * (grown + 1.0 / grown)
            s = root + w * w
            p, q = 1.0 / (a2 + s), 1.0 / (b2 + s)
            height = math.sqrt(z * z + w * w * (1.0 - x * x * a2 * p * p0 - y * y * b2 * q * q0))
            weight = WEIGHTS[i] * half * 2.0 * w * slope * math.sqrt(p * q / s)
            u, v, ratio = x * s * p, y * s * q, z / height
            of_p, of_q, left = weight * p, weight * q, 1.0 - ratio
            cube = 1.0 / (height * height)
            # Integrals of the pressure, then those of its derivatives.
            i_p += of_p
            i_q += of_q
            i_s += weight / s
            i_xx += (height - z - x * u / height) * of_p
            i_xy -= u / height * y * of_q
            f_xxx += (3.0 * u * left - x * u * u * ratio * cube) * of_p
            f_xxy += (v * left - x * u * v * ratio * cube) * of_p
            f_yyy += (3.0 * v * left - y * v * v * ratio * cube) * of_q
            f_yyx += (u * left - y * u * v * ratio * cube) * of_q
            xxx -= (3.0 + x * u * cube) * u / height * of_p
            xxy -= (1.0 + x * u * cube) * v / height * of_p
            yyy -= (3.0 + y * v * cube) * v / height * of_q
            yyx -= (1.0 + y * v * cube) * u / height * of_q
    return Integrals(
        p=i_p,
        q=i_q,
        s=i_s,
        xx=i_xx,
        xy=i_xy,
        f_xxx=f_xxx,
        f_xxy=f_xxy,
        f_yyy=f_yyy,
        f_yyx=f_yyx,
        xxx=xxx,
        xxy=xxy,
        yyy=yyy,
        yyx=yyx,
    )


@kernel
def _turning(a2: float, b2: float, x: float, y: float, z: float, root: float) -> float:
    """Length over which the integrand turns: the smaller of sqrt(lambda) and z / sqrt(h); p / p0
    where both are 0.
    """
    if z == 0.0:
        return max(1e-6, math.sqrt(max(0.0, 1.0 - x * x / a2 - y * y / b2)))
    p, q = 1.0 / (a2 + root), 1.0 / (b2 + root)
    steep = math.sqrt((z / root) ** 2 * root + root * (x * x * p * p + y * y * q * q))
    return min(1.0, math.sqrt(root), z / steep)


@kernel
def _inside(
    load: EllipseLoad, poisson: float, a2: float, b2: float, x: float, y: float, z: float, root: float,
    i: Integrals, scale: float,
) -> Stress:  # fmt: skip
    """Stresses below the surface from the integrals and what the moving end `root` adds."""
    p0, q0 = 1.0 / (a2 + root), 1.0 / (b2 + root)
    weight = 1.0 / math.sqrt((a2 + root) * (b2 + root) * root)
    steep = 2.0 * weight / (x * x * p0 * p0 + y * y * q0 * q0 + (z / root) ** 2)
    end_x, end_y, end_z = steep * x * p0, steep * y * q0, steep * z / root  # lambda_x dm/ds ...
    free, fx, fy = 1.0 - 2.0 * poisson, load.traction_x, load.traction_y
    psi_x, psi_y, psi_z = -x * i.p, -y * i.q, -z * i.s
    z_xx, z_yy, z_xy = z * (x * p0 * end_x - i.p), z * (y * q0 * end_y - i.q), z * x * p0 * end_y
    z_xz, z_yz = z * x * p0 * end_z, z * y * q0 * end_z
    zz = -z * (z / root) * end_z
    xx = 2.0 * poisson * psi_z - z_xx - free * i.xx
    yy = 2.0 * poisson * psi_z - z_yy - free * (z * i.s - i.xx)
    xy, xz, yz = -free * i.xy - z_xy, -z_xz, -z_yz
    # The integrand of psi1_xx at lambda is -x u / z, that of psi1_yy -y v / z.
    edge_x, edge_y = x * x * root * p0 * p0, y * y * root * q0 * q0
    xxx, xxy = z * i.xxx + edge_x * end_x, z * i.xxy + edge_x * end_y
    yyy, yyx = z * i.yyy + edge_y * end_y, z * i.yyx + edge_y * end_x
    xx += fx * (2.0 * (1.0 + poisson) * psi_x + 2.0 * poisson * i.f_xxx - xxx)
    yy += fx * (2.0 * poisson * (-i.f_xxx) + xxx + z_xz)
    zz -= fx * z_xz + fy * z_yz
    xy += fx * (psi_y + 2.0 * poisson * i.f_xxy - xxy) + fy * (psi_x + 2.0 * poisson * i.f_yyx - yyx)
    xz += fx * (psi_z - z_xx) - fy * z_xy
    yz += fy * (psi_z - z_yy) - fx * z_xy
    yy += fy * (2.0 * (1.0 + poisson) * psi_y + 2.0 * poisson * i.f_yyy - yyy)
    xx += fy * (2.0 * poisson * (-i.f_yyy) + yyy + z_yz)
    return Stress(scale * xx, scale * yy, scale * zz, scale * xy, scale * xz, scale * yz)


@kernel
def _on_surface(
    load: EllipseLoad, poisson: float, x: float, y: float, pressure: float, i: Integrals, scale: float
) -> Stress:
    """Stresses at z = 0; `pressure` is p over `scale`."""
    free, fx, fy = 1.0 - 2.0 * poisson, load.traction_x, load.traction_y
    psi_x, psi_y = -x * i.p, -y * i.q
    xx = -2.0 * poisson * pressure - free * i.xx
    yy = -2.0 * poisson * pressure - free * (pressure - i.xx)
    xx += fx * (2.0 * (1.0 + poisson) * psi_x + 2.0 * poisson * i.f_xxx) - fy * 2.0 * poisson * i.f_yyy
    yy += fy * (2.0 * (1.0 + poisson) * psi_y + 2.0 * poisson * i.f_yyy) - fx * 2.0 * poisson * i.f_xxx
    xy = -free * i.xy + fx * (psi_y + 2.0 * poisson * i.f_xxy) + fy * (psi_x + 2.0 * poisson * i.f_yyx)
    return Stress(scale * xx, scale * yy, -scale * pressure, scale * xy, -scale * fx * pressure, -scale * fy * pressure)
