"""Belt of a rolling tire as a rigid body in the plane of the road, with the bristles under it.

Frame of the axle: x forward, y left, z up; the axle travels with V along x and drifts with V
tan(alpha) to the left. The belt has the place x, y against the axle, the yaw psi about z and the
speed omega_b about y; the rim turns with omega_w, the twist theta is the angle between them:

* ``m (x'' + V') = F_n + F_x - k_x x - c_x x'``
* ``m y'' = F_y - k_y y - c_y y'``
* ``I_b omega_b' = -R_e (F_x + psi F_y - kappa M_z - lambda M_x) - M_r - k_t theta - c_t theta'``, ``theta' = omega_b -
  omega_w``
* ``I_z psi'' = M_z - k_p psi - c_p psi'``
* ``I_w omega_w' = k_t theta + c_t theta' + M_drive - M_brake``; without the spin of the wheel
  ``omega_w = (1 + kappa) V / R_e``

R_e = R - d/3, d the deflection of the axle: under a cleat the wheel turns faster. F_n is the force of
the pressure on slopes, M_r the moment of rolling resistance by a tread with
memory, F_x, F_y, M_z those of the bristles, M_x their moment ``sum x tau_x A``. The belt bends in the plane of the road with
the curvature kappa = c_b F_y, which moves the side force to the rear: its points lie on ``-kappa x^2 / 2``. It extends along
by ``-lambda x``, lambda = c_s F_x: the road that drives it forward squeezes it ahead of the wheel and pulls it out behind. The
road slides under the belt by ``(R_e omega_b (1 - lambda x) - x' - V, R_e omega_b (psi - kappa x) - V tan(alpha) - y' - psi' x)
dt``.
With the same R_e as lever and in the slip the power of the friction is what belt and axle lose. A brake
holds a standing rim up to its moment.

Works: a force held over half a step changes the kinetic energy by force, time and mean speed before and
after, so the sum of what is in `WORKS` is the change of the kinetic energy of belt and rim to rounding,
but for the work of the bristles' force. That is what the bristles lose and store, but for the *sampling
of the shear*: the force is that of the cells' centres, the work that of each bristle; first order in
the cell.

The yielding belt gives the slip forces their relaxation: no filter stands behind the bristles.

Steps: velocity Verlet, bristles advanced with the places; error of the frequency ``(omega h)^2 /
24``. Source: Pacejka, Tire and Vehicle Dynamics, ch. 9 (rigid ring); Zegelaar, The Dynamic Response
of Tyres to Brake Torque Variations and Road Unevennesses, Delft 1998.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from numpy import uint8
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry
from contact_sim_pkg.rigs.vehicle.tire.brush.rolling_brush import (
    BrushResult,
    BrushState,
    PatchGrid,
    RollingStep,
    advance_step,
    move_onto,
    settle_on,
    sliding_brush,
    write_shear,
)
from contact_sim_pkg.rigs.vehicle.tire.brush.steps import Field
from contact_sim_pkg.rigs.vehicle.tire.parameters import Brush, Sidewalls

__all__ = ["BELT_SAMPLES", "BELT_STATES", "BY_DRIFT", "RIM", "WORKS", "BeltDrive", "advance_belt"]

X, Y, TWIST, YAW, X_RATE, Y_RATE, SPIN, YAW_RATE, RIM, FORCE_X, FORCE_Y, MOMENT_Z, MOMENT_X = range(13)
BY_AXLE, BY_DRIFT, BY_RIM, BY_SLOPES, IN_SPRINGS, TO_BRAKE, TO_DAMPERS, TO_ROLLING, TO_BRISTLES, OF_SHEAR = range(
    13, 23
)
BELT_STATES = 23
"""The belt's state: places, speeds, spin of the rim [rad/s], the force of the bristles, and `WORKS`."""

WORKS = slice(BY_AXLE, BELT_STATES)
"""Works [J] since the start: supplied by the axle along and across, by drive or rim, by the force on
slopes; kept in the springs; lost to the brake, the dampers, rolling resistance, by the bristles (friction,
and what leaves the contact strained); and of the bristles' force on belt and rim.
"""

BELT_SAMPLES = 8
"""Columns of a sample: F_x, F_y [N], M_z [N m] of the bristles; force along and across [N], moment
about y and z [N m] on the axle; spin of the rim [rad/s].
"""


class BeltDrive(NamedTuple):
    """What moves a belt over a row of ``steps`` of one length; pairs are values at start and
    end, linear between.
    """

    duration: float  # [s]
    travel: float  # [m] of the axle, forward
    drift: float  # [m] of the axle, to the left
    speed_change: float  # [m/s] of the axle at the start
    rim: float  # [rad/s] spin of the rim, where it is no state
    radii: tuple[float, float]  # [m] effective rolling radius: slip and lever of the friction
    slopes: tuple[float, float]  # [N] force of the pressure on slopes
    rolling: tuple[float, float]  # [N m] moment of rolling resistance
    drive: float  # [N m] on the rim, forward
    brake: float  # [N m] on the rim, against its rotation, >= 0
    steps: int
    sample_every: int  # steps
    behind_sample: int  # steps since the last sample


@borrowing_kernel
def _turn_rim(wheel, spin, torque, drive, brake, time):
    """Spin of the rim after ``time`` [s] under a ``torque`` of the sidewalls [N m]; a brake stops it,
    never turns it.
    """
    if wheel is None:
        return spin
    free = spin + time * (torque + drive) / wheel.inertia
    stopped = time * brake / wheel.inertia
    return 0.0 if abs(free) <= stopped else free - math.copysign(stopped, free)


@borrowing_kernel
def _rim_works(wheel, spin, turned, torque, drive, time):
    """Work supplied at the rim and work of the brake [J] while its spin goes to ``turned`` [rad/s]."""
    mean = 0.5 * (spin + turned)
    if wheel is None:
        return -time * torque * mean, 0.0
    return time * drive * mean, time * (torque + drive) * mean - 0.5 * wheel.inertia * (turned**2 - spin**2)


@borrowing_kernel
def _accelerate(sidewalls, belt, drive, part, time):
    """Change the speeds over ``time`` [s] by the forces when ``part`` [1] of the row is done."""
    slopes = drive.slopes[0] + part * (drive.slopes[1] - drive.slopes[0])
    rolling = drive.rolling[0] + part * (drive.rolling[1] - drive.rolling[0])
    radius = drive.radii[0] + part * (drive.radii[1] - drive.radii[0])
    along, across, twist, yaw = _on_axle(sidewalls, belt)
    bend = sidewalls.bending * belt[FORCE_Y]
    extension = sidewalls.extension * belt[FORCE_X]
    lever = radius * (belt[FORCE_X] + belt[YAW] * belt[FORCE_Y] - bend * belt[MOMENT_Z] - extension * belt[MOMENT_X])
    x_rate, y_rate, spin, yaw_rate, rim = belt[X_RATE], belt[Y_RATE], belt[SPIN], belt[YAW_RATE], belt[RIM]
    belt[X_RATE] += time * (slopes + belt[FORCE_X] - along) / sidewalls.mass
    belt[Y_RATE] += time * (belt[FORCE_Y] - across) / sidewalls.mass
    belt[SPIN] -= time * (lever + rolling + twist) / sidewalls.inertia
    belt[YAW_RATE] += time * (belt[MOMENT_Z] - yaw) / sidewalls.yaw_inertia
    belt[RIM] = _turn_rim(sidewalls.wheel, belt[RIM], twist, drive.drive, drive.brake, time)
    # Works, with the mean speeds
    speed, drifting = drive.travel / drive.duration, drive.drift / drive.duration
    x_mean, y_mean, spin_mean = 0.5 * (x_rate + belt[X_RATE]), 0.5 * (y_rate + belt[Y_RATE]), 0.5 * (spin + belt[SPIN])
    yaw_mean, rim_mean = 0.5 * (yaw_rate + belt[YAW_RATE]), 0.5 * (rim + belt[RIM])
    belt[BY_AXLE] -= time * along * speed
    belt[BY_DRIFT] -= time * across * drifting
    belt[BY_SLOPES] += time * slopes * (speed + x_mean)
    by_rim, to_brake = _rim_works(sidewalls.wheel, rim, belt[RIM], twist, drive.drive, time)
    belt[BY_RIM] += by_rim
    belt[TO_BRAKE] += to_brake
    lost = time * (
        sidewalls.damping_x * x_rate * x_mean + sidewalls.damping_y * y_rate * y_mean
        + sidewalls.damping_twist * (spin - rim) * (spin_mean - rim_mean) + sidewalls.damping_yaw * yaw_rate * yaw_mean
    )  # fmt: skip
    belt[TO_DAMPERS] += lost
    belt[IN_SPRINGS] += (
        time * (along * x_mean + across * y_mean + twist * (spin_mean - rim_mean) + yaw * yaw_mean) - lost
    )
    belt[TO_ROLLING] += time * rolling * spin_mean
    belt[OF_SHEAR] += time * (
        belt[FORCE_X] * (speed + x_mean) + belt[FORCE_Y] * (drifting + y_mean) + belt[MOMENT_Z] * yaw_mean - lever * spin_mean
    )  # fmt: skip


@borrowing_kernel
def _on_axle(sidewalls, belt):
    """Force along and across [N], moment about y and z [N m] of the sidewalls on the axle."""
    return (
        sidewalls.stiffness_x * belt[X] + sidewalls.damping_x * belt[X_RATE],
        sidewalls.stiffness_y * belt[Y] + sidewalls.damping_y * belt[Y_RATE],
        sidewalls.stiffness_twist * belt[TWIST] + sidewalls.damping_twist * (belt[SPIN] - belt[RIM]),
        sidewalls.stiffness_yaw * belt[YAW] + sidewalls.damping_yaw * belt[YAW_RATE],
    )


@borrowing_kernel
def _move(sidewalls, belt, drive, middle):
    """Move the belt by a step whose ``middle`` is that part of the row; returns the ways of belt and
    road.
    """
    time = drive.duration / drive.steps
    radius = drive.radii[0] + middle * (drive.radii[1] - drive.radii[0])
    along, across, turn = time * belt[X_RATE], time * belt[Y_RATE], time * belt[YAW_RATE]
    way = radius * belt[SPIN] * time
    drift = drive.drift / drive.steps + across - way * (belt[YAW] + 0.5 * turn)
    belt[X] += along
    belt[Y] += across
    belt[TWIST] += time * (belt[SPIN] - belt[RIM])
    belt[YAW] += turn
    bend, extension = sidewalls.bending * belt[FORCE_Y], sidewalls.extension * belt[FORCE_X]
    return RollingStep(drive.travel / drive.steps, way - along, drift, time, turn, bend, extension)


@borrowing_kernel
def _sample(sidewalls, belt, out):
    out[0], out[1], out[2] = belt[FORCE_X], belt[FORCE_Y], belt[MOMENT_Z]
    out[3], out[4], out[5], out[6] = _on_axle(sidewalls, belt)
    out[7] = belt[RIM]


@entry
def advance_belt(
    brush: Brush, sidewalls: Sidewalls, state: BrushState, belt: Vector, grid: PatchGrid, pressure: Field, drive: BeltDrive,
    shear_x: Field, shear_y: Field, mode: NDArray[uint8], sampled: Field,
) -> BrushResult:  # fmt: skip
    """Advance belt and bristles over a row of steps that ends with the field `pressure` [Pa], on the
    cells of the bristles, [rows, cols], at `grid`.

    belt: [BELT_STATES], see the module; written: it, the bristles, shear_x, shear_y [Pa] and mode
    as in `advance_brush`, and sampled [samples, BELT_SAMPLES], at the start of every
    ``sample_every``-th step. Returns the bristles' force at the end and the work of the whole row.
    """
    for i in range(pressure.shape[0]):
        for j in range(pressure.shape[1]):
            shear_x[i, j], shear_y[i, j], mode[i, j] = 0.0, 0.0, 0
    time, area = drive.duration / drive.steps, grid.cell_x * grid.cell_y
    belt[X_RATE] -= drive.speed_change
    if sidewalls.wheel is None:
        belt[RIM] = drive.rim
    phase, window = move_onto(state, grid, pressure)
    dissipated, released, share, row = 0.0, 0.0, 0.0, 0
    for n in range(drive.steps):
        if (n + drive.behind_sample) % drive.sample_every == 0:
            _sample(sidewalls, belt, sampled[row])
            row += 1
        # Half of the forces, the places and with them the bristles, the other half.
        start, end = n / drive.steps, (n + 1) / drive.steps
        _accelerate(sidewalls, belt, drive, start, 0.5 * time)
        step = _move(sidewalls, belt, drive, 0.5 * (start + end))
        sliding = sliding_brush(brush, step)
        phase, work, energy = advance_step(sliding, state, grid, pressure, window, phase, step, start, end)
        belt[FORCE_X], belt[FORCE_Y], belt[MOMENT_Z], belt[MOMENT_X], share = write_shear(
            sliding, state.bristles, grid, window, phase, shear_x, shear_y, mode
        )
        _accelerate(sidewalls, belt, drive, end, 0.5 * time)
        dissipated += work * area
        released += energy * area
        belt[TO_BRISTLES] += (work + energy) * area
    settle_on(state, grid, pressure, phase)
    return BrushResult(belt[FORCE_X], belt[FORCE_Y], belt[MOMENT_Z], share, dissipated, released)
