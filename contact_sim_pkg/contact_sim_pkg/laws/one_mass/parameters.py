"""Parameters of the rig of one mass, in SI units."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.laws.parameters import NormalDissipation, NormalElastic


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
