"""Parameter tuples of every effect and of the parts of a rig, in SI units.

An effect that a scene does not call for is ``None`` in place of its tuple (decision 0001). All numbers are ``float``
unless said otherwise; the tuples are built in ``scene/build.py`` only.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy
from numpy.typing import NDArray

Vector = NDArray[numpy.float64]
Modes = NDArray[numpy.int64]  # what each friction contact of a rig does: see effects/friction.py


class NormalElastic(NamedTuple):
    """Elastic normal law F = coefficient * approach**exponent."""

    coefficient: float  # [N/m^exponent], > 0
    exponent: float  # 1 (linear) to 3; 3/2 is Hertz


class FoamElastic(NamedTuple):
    """Elastic law of a foam block with plateau and densification (``effects/foam_elastic.py``), in place of a power law."""

    area: float  # S [m^2], > 0
    thickness: float  # h [m], > 0
    modulus: float  # E_0 [Pa] of the soft start, > plateau
    plateau: float  # p_0 [Pa], > 0
    densification: float  # p_d [Pa], >= 0
    densification_exponent: float  # r, > 0


ElasticLaw: TypeAlias = NormalElastic | FoamElastic


class NormalDissipative(NamedTuple):
    """Hunt-Crossley loss: the elastic force is multiplied by 1 + damping * approach_rate, and never pulls."""

    damping: float  # [s/m], >= 0


class GeneralDissipative(NamedTuple):
    """Loss of the general law: ``B x**p sgn(x') |x'|**q`` is added to the elastic force (``effects/general_dissipative.py``)."""

    coefficient: float  # B [N/m^p/(m/s)^q], >= 0
    approach_exponent: float  # p, 0 to 4; 0 is a plain damper
    rate_exponent: float  # q, 0 to 3; 1 is linear, 0 dry friction
    smoothing_speed: float  # [m/s], 0 for q >= 1; |x'|**(q-1) is evaluated at sqrt(x'^2 + smoothing_speed^2)
    lowest_force: (
        float  # [N], 0: contact is lost where the force reaches 0; -inf: it lasts, pulling, until the gap opens
    )


NormalLoss: TypeAlias = NormalDissipative | GeneralDissipative


class FoamHysteresis(NamedTuple):
    """Loss of foam without rate: an internal variable that follows the loading (``effects/foam_hysteresis.py``)."""

    offset: int  # of the internal variable in the state vector
    share: float  # s, 0 to below 1: force over elastic force is 1 + s on a long loading, 1 - s on a long unloading
    energy: float  # u_0 [J] over which a reversal is passed, > 0


class Friction(NamedTuple):
    """Spring-damper that sticks, with a Coulomb limit."""

    stiffness: float  # [N/m], > 0
    damping: float  # [N s/m], >= 0
    coefficient_static: float  # ratio of limit to normal force at which sticking ends, > 0
    coefficient_kinetic: float  # ratio while slipping, <= coefficient_static


class Brush(NamedTuple):
    """Bristles of a rolling tread, one a cell of its pressure field, with a Coulomb limit of their own."""

    stiffness_x: float  # [N/m^3] shear stress per deflection, along the travel, > 0
    stiffness_y: float  # [N/m^3] sideways, > 0
    coefficient_static: float  # ratio of shear stress to pressure at which sticking ends, > 0
    coefficient_kinetic: float  # ratio while sliding, > 0, <= coefficient_static


class Contact(NamedTuple):
    """One contact: the effects that act in it. ``elastic`` is always there, the others may be ``None``."""

    elastic: ElasticLaw
    dissipative: NormalLoss | None
    friction: Friction | None
    hysteresis: FoamHysteresis | None = None


class Tire(NamedTuple):
    """Quarter vehicle on a tire; state [wheel_z, body_z, wheel_v, body_v], first in the state vector."""

    wheel_mass: float  # [kg]
    body_mass: float  # [kg]
    suspension_stiffness: float  # [N/m]
    suspension_damping: float  # [N s/m]


class Carcass(NamedTuple):
    """Belt and tread as one rigid ring that the sidewalls carry; state [belt_z, belt_v] from ``offset``.

    Without load the belt's height equals the wheel's. Tread contact and sidewalls then stand in series.
    """

    offset: int  # index of belt_z in the state vector
    belt_mass: float  # [kg], not counted in Tire.wheel_mass
    stiffness: float  # [N/m] of the sidewalls
    damping: float  # [N s/m]


class Seat(NamedTuple):
    """Occupant on a cushion: a frame mass in contact, and masses that hang on it by spring and damper, in parallel.

    State, from ``offset``: frame_z, masses_z..., frame_v, masses_v...; with friction also occupant_x, occupant_vx and
    the deflection of the friction spring.
    """

    offset: int  # index of frame_z in the state vector
    frame_mass: float  # [kg]
    masses: Vector  # [kg], may be empty
    stiffness: Vector  # [N/m], one a mass
    damping: Vector  # [N s/m], one a mass


class Vehicle(NamedTuple):
    """Rig of seat and tire: each part and its contact may be absent (``None``), not both.

    Without a tire the motion is relative to the floor, which is then an accelerated frame.
    """

    gravity: float  # [m/s^2], > 0
    tire: Tire | None
    carcass: Carcass | None
    tire_contact: Contact | None
    seat: Seat | None
    seat_contact: Contact | None


class PointContact(NamedTuple):
    """One mass above a support that moves as a sine: x = support - z is the approach. State [z, v].

    The free impact (no gravity, no motion), the drop and the slap are its cases.
    """

    mass: float  # [kg]
    gravity: float  # [m/s^2], >= 0
    support_amplitude: float  # [m]
    support_frequency: float  # [rad/s]
    elastic: NormalElastic
    dissipative: NormalLoss | None


class ImpactWorks(NamedTuple):
    """A point contact whose force's works are integrated with it. State [z, v, work of closing, work of opening] in [m, m/s, J, J].

    Both works are counted from the start of the run: ``W = -integral F x' dt``, the first over all closing phases (W_c <= 0), the
    second over all opening ones (W_r >= 0 where the contact never pulls).
    """

    contact: PointContact


class BeltSlider(NamedTuple):
    """One mass on a spring, rubbed by a belt under a constant load. State [x, v, deflection of the friction spring]."""

    mass: float  # [kg]
    spring: float  # [N/m]
    belt_speed: float  # [m/s]
    load: float  # [N]
    friction: Friction


class Drive(NamedTuple):
    """What moves a rig during one segment: values that change linearly from its start to its end."""

    start: float  # [s]
    length: float  # [s]
    height_0: float  # [m] effective height of the road under the tire at the start
    height_1: float  # [m] the same at the end
    cushion_0: float  # [m] effective height of the unloaded cushion above the floor at the start
    cushion_1: float  # [m]
    acceleration_x_0: float  # [m/s^2] of the floor
    acceleration_x_1: float
    acceleration_z_0: float  # [m/s^2] of the floor (seat rig) or of the free body (car)
    acceleration_z_1: float
    push_0: float | None = None  # [N] that road asperities add to the tire's force while it is in contact
    push_1: float | None = None


class Belt(NamedTuple):
    """A belt under tension on an elastic foundation, rigid across its width: what bends over an obstacle."""

    tension: float  # [N], > 0
    foundation: float  # [N/m^2] radial stiffness per length of circumference, > 0


class TreadViscoelasticity(NamedTuple):
    """Relaxation of the tread's modulus: ``E(t) / E_long = 1 + retardation_time dirac(t) + sum ratio exp(-t / time)``."""

    retardation_time: float  # [s], >= 0; Kelvin-Voigt
    ratios: Vector  # [branches] Maxwell modulus over the long-time modulus, >= 0
    times: Vector  # [branches] [s] relaxation times, > 0


class FieldSettings(NamedTuple):
    """Grid and accuracy of one pressure field."""

    rows: int
    cols: int
    cell_x: float  # [m]
    cell_y: float  # [m]
    modulus: float  # [Pa], plane-strain contact modulus E*
    tolerance: float  # complementarity residual asked of the solver
    maximum_iterations: int
    corrector_passes: int  # most repetitions of a stretch with the field found at its end
    belt: Belt | None = None  # yields in series with the half-space


def widened(settings: FieldSettings) -> FieldSettings:
    """The same cells on twice the extent: the grid that takes over where the contact outgrows the first."""
    return settings._replace(
        rows=settings.rows + 2 * (settings.rows // 2), cols=settings.cols + 2 * (settings.cols // 2)
    )
