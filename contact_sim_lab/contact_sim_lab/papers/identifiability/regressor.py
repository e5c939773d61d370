"""A rigid body's ten inertial parameters by a regressor, batch and recursive (Identifiability eq 1).

    f = m s + (alpha x + omega x omega x) mc,     tau_O = I alpha + omega x I omega + mc x s,     s = a_O - g

Everything in body axes about the sensor's point O: s what an accelerometer reads, m c the first moment,
I about O. Both are linear in `Theta = (m, mc_x, mc_y, mc_z, Ixx, Iyy, Izz, Ixy, Ixz, Iyz)`: `tau = Phi
Theta`, Phi [6, 10] a sample. Source of the regressor: Atkeson, An, Hollerbach, Int. J. Robotics Research
5 (1986) 101.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
import scipy.linalg
from numpy.typing import NDArray

__all__ = ["NAMES", "UNITS", "BodyMotion", "InertiaFit", "batch", "recursive", "regressor"]

Array = NDArray[numpy.float64]

NAMES = ("m", "mc_x", "mc_y", "mc_z", "Ixx", "Iyy", "Izz", "Ixy", "Ixz", "Iyz")
UNITS = ("kg", *["kg m"] * 3, *["kg m^2"] * 6)
RANK = 1e-8  # of the largest singular value of the column-scaled regressor
SHARE = 0.1  # part of a parameter in what is not identified, above which it is named


class BodyMotion(NamedTuple):
    """Samples in body axes at the sensor's point O, arrays [samples, 3]."""

    specific_force: Array  # s = a_O - g [m/s^2]
    spin: Array  # omega [rad/s]
    spin_rate: Array  # alpha [rad/s^2]
    force: Array  # [N], all but the weight
    torque: Array  # [N m] about O


class InertiaFit(NamedTuple):
    """Parameters and what of them is not identified."""

    parameters: Array  # [10]; of smallest scaled norm where the rank is lower
    deviations: Array  # [10] from what is left; infinite where not identified
    rank: int
    hidden: list[str]  # parameters that are not identified, alone or together
    residual: float  # rms of what is left over the rms of the wrench


def regressor(motion: BodyMotion) -> Array:
    """Phi [samples, 6, 10]: forces, then torques about O."""
    s, w, a = motion.specific_force, motion.spin, motion.spin_rate
    phi = numpy.zeros((len(s), 6, 10))
    phi[:, :3, 0] = s
    phi[:, :3, 1:4] = _cross(a) + _cross(w) @ _cross(w)
    phi[:, 3:, 1:4] = -_cross(s)
    phi[:, 3:, 4:] = _of_inertia(a) + _cross(w) @ _of_inertia(w)
    return phi


def _cross(v: Array) -> Array:
    """Matrices [n, 3, 3] of `v x` for vectors [n, 3]."""
    zero = numpy.zeros(len(v))
    x, y, z = v.T
    return numpy.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)


def _of_inertia(v: Array) -> Array:
    """Matrices [n, 3, 6] with which (Ixx, Iyy, Izz, Ixy, Ixz, Iyz) give I v."""
    zero = numpy.zeros(len(v))
    x, y, z = v.T
    rows = [x, zero, zero, y, z, zero, zero, y, zero, x, zero, z, zero, zero, z, zero, x, y]
    return numpy.stack(rows, axis=1).reshape(-1, 3, 6)


def batch(motion: BodyMotion) -> InertiaFit:
    """Least squares over all samples by a QR with column scaling."""
    phi, wrench = regressor(motion).reshape(-1, 10), _wrench(motion)
    scale = numpy.linalg.norm(phi, axis=0)
    scale[scale == 0.0] = 1.0
    triangle, right = _reduced(phi / scale, wrench)
    left, sizes, directions = numpy.linalg.svd(triangle)
    rank = int((sizes > RANK * sizes[0]).sum()) if sizes[0] > 0.0 else 0
    scaled = directions[:rank].T @ ((left.T @ right)[:rank] / sizes[:rank])
    rest = wrench - phi @ (scaled / scale)
    freedom = max(len(wrench) - rank, 1)
    spread = (directions[:rank].T / sizes[:rank]) * numpy.sqrt(float(rest @ rest) / freedom)
    deviations = numpy.linalg.norm(spread, axis=1) / scale
    missing = directions[rank:]
    lost = numpy.linalg.norm(missing, axis=0) > SHARE
    deviations[lost] = numpy.inf
    hidden = [name for name, is_lost in zip(NAMES, lost, strict=True) if is_lost]
    size = float(numpy.sqrt(numpy.mean(wrench**2)))
    residual = float(numpy.sqrt(numpy.mean(rest**2))) / size if size > 0.0 else 0.0
    return InertiaFit(scaled / scale, deviations, rank, hidden, residual)


def recursive(motion: BodyMotion) -> Array:
    """Parameters after each sample [samples, 10], forgetting factor 1; NaN until all ten are identified.

    The triangle of all samples so far takes each new one by a QR of sixteen rows: the recursive least
    squares in the square root of the information, which needs no start. The scale of the columns serves the rank alone.
    """
    phi, wrench = regressor(motion), _wrench(motion).reshape(-1, 6)
    scale = numpy.linalg.norm(phi.reshape(-1, 10), axis=0)
    scale[scale == 0.0] = 1.0
    rows: Array = numpy.zeros((10, 11))
    found = numpy.full((len(phi), 10), numpy.nan)
    for place, (matrix, right) in enumerate(zip(phi / scale, wrench, strict=True)):
        stacked = numpy.vstack([rows, numpy.column_stack([matrix, right])])
        rows = numpy.asarray(numpy.linalg.qr(stacked, mode="r"))[:10]
        sizes = numpy.abs(numpy.diag(rows))
        if sizes.min() > RANK * sizes.max():
            found[place] = scipy.linalg.solve_triangular(rows[:, :10], rows[:, 10]) / scale
    return found


def _wrench(motion: BodyMotion) -> Array:
    return numpy.concatenate([motion.force, motion.torque], axis=1).ravel()


def _reduced(phi: Array, wrench: Array) -> tuple[Array, Array]:
    """Triangle [10, 10] of a QR and the right side [10] that belongs to it."""
    rows = numpy.asarray(numpy.linalg.qr(numpy.column_stack([phi, wrench]), mode="r"))
    square = numpy.zeros((10, 11))
    square[: min(10, len(rows))] = rows[:10]
    return square[:, :10], square[:, 10]
