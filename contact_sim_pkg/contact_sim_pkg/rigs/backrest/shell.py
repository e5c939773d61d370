"""Doubly curved shallow shell with simply supported edges in modal form: frequencies, mode shapes,
static deflection.

Sides L1, L2 from a corner (x along L1, y along L2), thickness h, radii of curvature R1 along L1 and
R2 along L2. With `alpha = m pi / L1`, `beta = n pi / L2`, `D = E h^3 / (12 (1 - nu^2))` and a
deflection w, positive outwards,

    w(x, y, t) = sum q_mn(t) phi_mn(x, y),   phi_mn = sin(alpha x) sin(beta y),   modal mass M = rho
    h L1 L2 / 4 omega_mn^2 = (D (alpha^2 + beta^2)^2 + E h ((alpha^2 / R2 + beta^2 / R1) / (alpha^2
    + beta^2))^2) / (rho h) M (q_mn'' + 2 zeta omega_mn q_mn' + omega_mn^2 q_mn) = sum of point
    forces times phi_mn at their points

R = inf is the flat plate, exactly. A shape counts to the first power, so q_mn is the deflection at
the crest of its mode.

Range: thin (h at most 0.1 of the shorter side, where transverse shear already lowers a plate's
frequencies by some percent), shallow (rise L^2 / (8 R) at most 0.2 L) and w small against h and the
rise: the theory is linear in w. Source: Driver and Seat eqs 3 and 6, reduced by Donnell, Mushtari
and Vlasov; Soedel (2004), Vibrations of Shells and Plates, sections 6.7 and 8; Timoshenko and
Woinowsky-Krieger (1959), section 34, for the plate.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require_count, require_values

__all__ = [
    "MODE_COUNTS",
    "ShallowShell",
    "ShellError",
    "ShellModes",
    "crown_gap",
    "natural_frequencies",
    "shell_modes",
    "static_deflection",
]

Field = NDArray[numpy.float64]

MODE_COUNTS = (1, 4, 9, 25)
"""m, n <= 1, 2, 3, 5: the counts that scenes offer. The functions take any square number."""

THICKEST = 0.1
"""Thickness over the shorter side."""

STEEPEST = 0.2
"""Rise L^2/(8 R) over the side L."""


class ShellError(ValueError):
    """The shell, a number of modes or a point is not possible."""


class ShallowShell(NamedTuple):
    length_1: float  # [m] side along x
    length_2: float  # [m] side along y
    thickness: float  # [m]
    young: float  # [Pa]
    poisson: float  # [1] 0 to 0.5
    density: float  # [kg/m^3]
    radius_1: float  # [m] of curvature along x; inf: straight; negative: curved the other way
    radius_2: float  # [m] of curvature along y


class ShellModes(NamedTuple):
    """What a rig needs of the shell; modes by m, then n: (1, 1), (1, 2), …, (2, 1), …"""

    orders: NDArray[numpy.int64]  # [modes, 2] m and n
    frequencies: Field  # [modes] [rad/s]
    shapes: Field  # [points, modes] phi [1]
    slopes_x: Field  # [points, modes] d phi / dx [1/m]
    slopes_y: Field  # [points, modes] d phi / dy [1/m]
    modal_mass: float  # [kg] the same for every mode


def shell_modes(shell: ShallowShell, count: int, points: Field) -> ShellModes:
    """The first `count` modes (1, 4, 9, 25 or another square number) at points of the shell.

    points: [points, 2], x in 0..L1 and y in 0..L2 [m]. A point of the face that touches the seat
    moves tangentially by -(h/2) dw/dx, -(h/2) dw/dy with the rotation of the director. Raises
    `ShellError`.
    """
    orders, alpha, beta = _wave_numbers(shell, count)
    points = _points(shell, points)
    x, y = points[:, :1], points[:, 1:]
    along_x, along_y = numpy.sin(alpha * x), numpy.sin(beta * y)
    return ShellModes(
        orders,
        _frequencies(shell, alpha, beta),
        along_x * along_y,
        alpha * numpy.cos(alpha * x) * along_y,
        beta * along_x * numpy.cos(beta * y),
        shell.density * shell.thickness * shell.length_1 * shell.length_2 / 4.0,
    )


def natural_frequencies(shell: ShallowShell, count: int) -> Field:
    """omega_mn [rad/s] of the first `count` modes, by m, then n. Raises `ShellError`."""
    _, alpha, beta = _wave_numbers(shell, count)
    return _frequencies(shell, alpha, beta)


def static_deflection(shell: ShallowShell, count: int, loads: Field, load_points: Field, points: Field) -> Field:
    """Deflection [m] at `points` [points, 2] under constant point loads [N] at `load_points`
    [loads, 2].

    `w = sum_mn phi_mn sum_k P_k phi_mn(k) / (M omega_mn^2)` over the first `count` modes. Raises
    `ShellError`, also for loads that are not finite.
    """
    at_loads = shell_modes(shell, count, load_points)
    at_points = shell_modes(shell, count, points)
    forces = require_values("shell: loads", loads, "N", error=ShellError)
    if forces.shape != at_loads.shapes.shape[:1]:
        raise ShellError(
            f"shell: {forces.shape} loads at {at_loads.shapes.shape[0]} points, one load a point is needed"
        )
    amplitudes = forces @ at_loads.shapes / (at_loads.modal_mass * at_loads.frequencies**2)
    return numpy.asarray(at_points.shapes @ amplitudes)


def crown_gap(shell: ShallowShell, points: Field) -> Field:
    """Gap [m] at `points` [points, 2] to a flat seat that touches the crown: `dx^2/(2 R1) + dy^2/(2
    R2)`.

    dx, dy: from the middle of the shell. Raises `ShellError`.
    """
    _refuse_shell(shell)
    points = _points(shell, points)
    from_x, from_y = points[:, 0] - 0.5 * shell.length_1, points[:, 1] - 0.5 * shell.length_2
    return numpy.asarray(0.5 * from_x**2 / shell.radius_1 + 0.5 * from_y**2 / shell.radius_2)


def _wave_numbers(shell: ShallowShell, count: int) -> tuple[NDArray[numpy.int64], Field, Field]:
    """Orders [modes, 2], alpha [modes] and beta [modes] [1/m]."""
    _refuse_shell(shell)
    side = math.isqrt(require_count("shell: modes", count, error=ShellError))
    if side * side != count:
        raise ShellError(f"shell: {count} modes, allowed are square numbers (1, 4, 9, 25, …): m and n count alike")
    orders = numpy.indices((side, side)).reshape(2, -1).T.astype(numpy.int64) + 1
    alpha, beta = math.pi * orders[:, 0] / shell.length_1, math.pi * orders[:, 1] / shell.length_2
    return orders, numpy.asarray(alpha), numpy.asarray(beta)


def _frequencies(shell: ShallowShell, alpha: Field, beta: Field) -> Field:
    """omega_mn [rad/s], written without a division by the thickness, which may be tiny."""
    modulus = shell.young / shell.density
    waves = alpha**2 + beta**2
    bending = modulus * shell.thickness**2 / (12.0 * (1.0 - shell.poisson**2)) * waves**2
    membrane = modulus * ((alpha**2 / shell.radius_2 + beta**2 / shell.radius_1) / waves) ** 2
    return numpy.asarray(numpy.sqrt(bending + membrane))


def _points(shell: ShallowShell, points: Field) -> Field:
    points = numpy.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ShellError(f"shell: points have the shape {points.shape}, it must be (points, 2)")
    sides = (shell.length_1, shell.length_2)
    outside = ~((points >= 0.0) & (points <= sides)).all(axis=1)
    if outside.any():
        x, y = points[outside][0]
        raise ShellError(f"shell: the point ({x:g}, {y:g}) m is outside the sides 0..{sides[0]:g} by 0..{sides[1]:g} m")
    return points


def _refuse_shell(shell: ShallowShell) -> None:
    for name in ("length_1", "length_2", "thickness", "young", "density"):
        value = getattr(shell, name)
        if not 0.0 < value < math.inf:
            raise ShellError(f"shell: {name} is {value}, it must be a finite number above 0")
    if not 0.0 <= shell.poisson <= 0.5:
        raise ShellError(f"shell: poisson is {shell.poisson}, allowed 0 to 0.5")
    shorter = min(shell.length_1, shell.length_2)
    if shell.thickness > THICKEST * shorter:
        raise ShellError(
            f"shell: thickness {shell.thickness:g} m is above {THICKEST:g} of the shorter side {shorter:g} m: not a thin shell"
        )
    for name, side, radius in (("1", shell.length_1, shell.radius_1), ("2", shell.length_2, shell.radius_2)):
        least = side / (8.0 * STEEPEST)
        if not abs(radius) >= least:
            raise ShellError(
                f"shell: radius_{name} is {radius:g} m, for a shallow shell of side {side:g} m it must be at least {least:g} m"
            )
