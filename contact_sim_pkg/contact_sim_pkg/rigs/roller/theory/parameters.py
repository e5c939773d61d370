"""What a roller bench consists of.

Axes: x along shaft and spin axis, y along rolling, z from the roller's centre into the shaft.
"""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Bending", "Curvatures", "Roller"]


class Curvatures(NamedTuple):
    """Of both bodies in [1/m], positive for a convex surface; yaw turns the roller's over the
    shaft's.
    """

    roller_axial: float  # k11, of the profile, along x
    roller_rolling: float  # k12 = 1/R, along y
    shaft_rolling: float  # k21, along y
    shaft_axial: float  # k22, along x


class Bending(NamedTuple):
    """The shaft is bent: clamped at one end, a load at the other side of the contact."""

    load: float  # Q [N]; with Q (A - l) > 0 the contact lies on the stretched side
    contact_distance: float  # A [m], from the clamped end
    load_distance: float  # l [m]
    radius: float  # r [m] of the shaft
    second_moment: float  # J_y = pi r^4 / 4 [m^4]
    friction: float  # f0 [1]: the traction is -f0 times the bending stress


class Roller(NamedTuple):
    """The roller in its suspension; small tilt about y and yaw about z."""

    radius: float  # R [m]
    inertia_tilt: float  # I_y [kg m^2]
    inertia_yaw: float  # I_z [kg m^2]
    inertia_product: float  # I_yz [kg m^2], I_yz^2 < I_y I_z
    inertia_spin: float  # i [kg m^2]
    spin: float  # omega [rad/s]
    stiffness_tilt: float  # [N m/rad]
    stiffness_yaw: float  # [N m/rad]
    damping_tilt: float  # [N m s/rad]
    damping_yaw: float  # [N m s/rad]
    rolling_friction: float  # f_r [1], its sign is that of the rolling
