"""Effects of the contact between occupant and cushion.

A scene calls for friction where the floor shakes fore and aft, for a loss where none acts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.effect import Effect, without_loss

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["SEAT_EFFECTS"]

LOOK_SECONDS = 0.005  # between two looks at a recording, which a seat follows up to some 20 Hz
NOTICED = 1.0 / 3.0
"""Fore-aft acceleration over gravity, in requested accuracies, from which on friction may carry it."""


def _friction(scene: ResolvedScene) -> str:
    from contact_sim_pkg.scene.schema.accuracy import requested

    shaken = _fore_aft(scene) > NOTICED * requested(scene.accuracy) * GRAVITY
    return "the floor shakes fore and aft" if shaken else ""


def _fore_aft(scene: ResolvedScene) -> float:
    """Fore-aft acceleration [m/s^2] of the floor during the run: amplitude, rms of noise, peak of a
    recording. None in a recording that cannot be read: the run refuses it, or has its blocks from a
    bag.
    """
    vibration = scene.vibration
    if vibration is None or "x" not in vibration.axes:
        return 0.0
    strength = vibration.strength()
    if strength is not None:
        return strength
    import numpy

    from contact_sim_pkg.excitation.errors import ExcitationError
    from contact_sim_pkg.run.sources import make_vibration
    from contact_sim_pkg.scene.errors import SceneError

    try:
        forward, _up = make_vibration(scene).signal.acceleration(
            numpy.arange(0.0, scene.duration, LOOK_SECONDS, dtype=numpy.float64)
        )
    except (ExcitationError, SceneError):
        return 0.0
    return float(numpy.abs(forward).max())


_SCHEMA, _LAWS = f"{__package__}.schema", "contact_sim_pkg.scene.schema.laws"
_LOSS = without_loss("seat", "normal_dissipative", "general_dissipative", "foam_hysteresis")

SEAT_EFFECTS = (
    Effect(
        name="normal_elastic", section=f"{_SCHEMA}:PowerElastic", help="elastic force", carries=True,
        feeds=("force", "wrench"),
    ),
    Effect(
        name="cushion", section=f"{_SCHEMA}:SeatCushion", help="foam cushion of finite thickness",
        source="Johnson, Contact Mechanics, 5.8", carries=True, excludes=("normal_elastic",),
        feeds=("force", "wrench", "patch"), not_below={"force": 1e-3, "motion": 3e-3},
    ),
    Effect(
        name="normal_dissipative", section=f"{_SCHEMA}:SeatLoss", help="loss", source="Brogliato, Nonsmooth Mechanics, 2",
        needs=("normal_elastic",), feeds=("force", "wrench", "patch"), called_for=_LOSS,
    ),
    Effect(
        name="foam", section=f"{_LAWS}:Foam", help="foam with plateau and densification", source="Driver and Seat",
        needs=("normal_elastic",), excludes=("cushion",), feeds=("force", "wrench"),
    ),
    Effect(
        name="foam_hysteresis", section=f"{_SCHEMA}:SeatHysteresis", help="rate-independent loss of foam",
        needs=("normal_elastic",), feeds=("force", "wrench"),
    ),
    Effect(
        name="general_dissipative", section=f"{_LAWS}:GeneralDissipation", help="loss by the general law",
        needs=("normal_elastic",), excludes=("normal_dissipative",), feeds=("force", "wrench", "patch"),
        called_for=_LOSS,
    ),
    Effect(
        name="friction", section=f"{_LAWS}:FrictionSection", help="friction with stick and slip", needs=("normal_elastic",),
        feeds=("force", "wrench", "points"), called_for=_friction,
    ),
    Effect(
        name="contact_field", section=f"{_SCHEMA}:CushionMap", help="pressure map of the cushion",
        source="Johnson, Contact Mechanics, 5.8", needs=("cushion",), publishes="patch", feeds=("patch",),
        not_below={"peak": 6e-3, "area": 1.2e-2},
    ),
    Effect(
        name="half_space_field", section=f"{_SCHEMA}:HalfSpaceField", help="pressure field of a half-space",
        source="Johnson, Contact Mechanics, 5.4", needs=("normal_elastic",),
        excludes=("cushion", "foam", "foam_hysteresis", "contact_field"), publishes="patch", feeds=("patch", "force", "wrench"),
    ),
    Effect(
        name="softening", section=f"{_SCHEMA}:SofteningSection", help="occupant that softens with vibration",
        source="Huang and Griffin 2006", feeds=("force", "wrench"),
    ),
    Effect(
        name="suspension", section="contact_sim_pkg.rigs.vehicle.effects.suspension:SuspensionSection",
        help="seat suspension below the cushion: spring, damper, dry friction, end stops", feeds=("force", "wrench"),
        elements="contact_sim_pkg.rigs.vehicle.effects.suspension_kernel:suspension",
    ),
)  # fmt: skip
