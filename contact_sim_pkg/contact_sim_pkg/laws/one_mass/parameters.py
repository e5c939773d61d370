"""Parameter tuples of the rigs of one mass, in SI units."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.laws.parameters import Friction, NormalDissipation, NormalElastic


class PointContact(NamedTuple):
    """One mass above a support that moves as a sine: x = support - z is the approach. State [z, v].

    The free impact (no gravity, no motion), the drop and the slap are its cases.
    """

    mass: float  # [kg]
    gravity: float  # [m/s^2], >= 0
    support_amplitude: float  # [m]
    support_frequency: float  # [rad/s]
    elastic: NormalElastic
    dissipative: NormalDissipation | None


class ImpactWorks(NamedTuple):
    """A point contact whose force's works are integrated with it. State [z, v, work of closing,
    work of opening] in [m, m/s, J, J].

    Both works are counted from the start of the run: ``W = -integral F x' dt``, the first over all
    closing phases (W_c <= 0), the second over all opening ones (W_r >= 0 where the contact never
    pulls).
    """

    contact: PointContact


class BeltSlider(NamedTuple):
    """One mass on a spring, rubbed by a belt under a constant load. State [x, v, deflection of the
    friction spring].
    """

    mass: float  # [kg]
    spring: float  # [N/m]
    belt_speed: float  # [m/s]
    load: float  # [N]
    friction: Friction
