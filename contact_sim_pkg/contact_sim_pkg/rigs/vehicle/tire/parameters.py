"""Parameter tuples of the effects of tread and belt, in SI units."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Vector


class Brush(NamedTuple):
    """Bristles of a rolling tread, one a cell of its pressure field, with a Coulomb limit of their
    own.

    The sliding coefficient falls with the slip speed v: ``mu_k + (mu_s - mu_k) exp(-v / speed)``.
    """

    stiffness_x: float  # [N/m^3] shear stress per deflection, along the travel, > 0
    stiffness_y: float  # [N/m^3] sideways, > 0
    coefficient_static: float  # ratio of shear stress to pressure at which sticking ends, > 0
    coefficient_kinetic: float  # ratio while sliding fast, > 0, <= coefficient_static
    speed: float = 0.0  # [m/s] of that fall, >= 0; 0: kinetic at any speed
    along: float = 1.0  # factor of both coefficients under the present load, for slip along the travel, > 0
    across: float = 1.0  # sideways, > 0


class LoadFriction(NamedTuple):
    """Friction that falls with the load F: both coefficients times ``(F / nominal)^-exponent``."""

    nominal: float  # [N]
    along: float  # exponent for slip along the travel
    across: float  # sideways


class WheelSpin(NamedTuple):
    """Rotation of the rim as a state."""

    inertia: float  # [kg m^2] of rim, hub and what turns with them


class Sidewalls(NamedTuple):
    """Belt as a rigid body in the plane of the road and in rotation, on springs and dampers between
    it and the rim.
    """

    mass: float  # [kg] of the belt
    inertia: float  # [kg m^2] about the axle
    yaw_inertia: float  # [kg m^2] about the vertical
    stiffness_x: float  # [N/m]
    stiffness_y: float  # [N/m]
    stiffness_twist: float  # [N m/rad] belt against rim about the axle
    stiffness_yaw: float  # [N m/rad]
    damping_x: float  # [N s/m]
    damping_y: float  # [N s/m]
    damping_twist: float  # [N m s/rad]
    damping_yaw: float  # [N m s/rad]
    wheel: WheelSpin | None  # None: the slip programme turns the rim
    bending: float = 0.0  # [1/(m N)] curvature of the belt in the plane of the road per force across
    extension: float = 0.0  # [1/(m N)] fall of the belt's strain along, per metre and force along


class TreadViscoelasticity(NamedTuple):
    """Relaxation of the tread's modulus: ``E(t) / E_long = 1 + retardation_time dirac(t) + sum
    ratio exp(-t / time)``.
    """

    retardation_time: float  # [s], >= 0; Kelvin-Voigt
    ratios: Vector  # [branches] Maxwell modulus over the long-time modulus, >= 0
    times: Vector  # [branches] [s] relaxation times, > 0
