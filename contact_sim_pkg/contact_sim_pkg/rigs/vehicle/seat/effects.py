"""Effects of the contact between occupant and cushion.

A scene calls for friction where the floor moves fore and aft, with a tangential demand above about
0.3 of mu N; for a loss where the contact opens; for a softening occupant where the vibration spans
more than a factor 2 within a run. What carries the load is a choice of the model.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy

from contact_sim_pkg.records.effect import Effect, Observed, Verdict, choice_of_model, needed_where_it_opens

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["SEAT_EFFECTS"]

DEMAND = 0.3  # of mu N
SPAN, PARTS = 2.0, 4  # of the vibration's rms within a run, and the parts that it is cut into


def _friction(scene: ResolvedScene, observed: Observed) -> Verdict:
    if observed.forward == 0.0:
        return False, "no fore-aft input"
    from contact_sim_pkg.rigs.vehicle.lattice import occupant_mass
    from contact_sim_pkg.rigs.vehicle.seat.schema import SeatSection
    from contact_sim_pkg.scene.schema.laws import FrictionSection

    friction = scene.effect("seat", FrictionSection) or FrictionSection()
    limit = friction.coefficient_static * float(observed.forces["seat"].min())
    demand = occupant_mass(scene.section(SeatSection).occupant) * observed.forward
    share = demand / limit if limit > 0.0 else float("inf")
    return share > DEMAND, f"fore-aft demand up to {share:.2g} of mu N, limit {DEMAND:g}"


def _softening(_scene: ResolvedScene, observed: Observed) -> Verdict:
    force = observed.forces["seat"]
    parts = [float(part.std()) for part in numpy.array_split(force, PARTS) if len(part)]
    span = max(parts) / min(parts) if min(parts) > 0.0 else float("inf") if max(parts) > 0.0 else 1.0
    said = f"rms of the force on the seat spans a factor {span:.2g} between quarters of the run, limit {SPAN:g}"
    return span > SPAN, said


_SCHEMA, _LAWS = f"{__package__}.schema", "contact_sim_pkg.scene.schema.laws"
_LAW = choice_of_model("which law carries the load, and what it loses without rate, is a choice of the model")

SEAT_EFFECTS = (
    Effect(
        name="normal_elastic", section=f"{_SCHEMA}:PowerElastic", help="elastic force", carries=True,
        feeds=("force", "wrench"), called_for=_LAW,
    ),
    Effect(
        name="cushion", section=f"{_SCHEMA}:SeatCushion", help="foam cushion of finite thickness",
        source="Johnson, Contact Mechanics, 5.8", carries=True, excludes=("normal_elastic",),
        feeds=("force", "wrench", "patch"), called_for=_LAW, not_below={"force": 1e-3, "motion": 3e-3},
    ),
    Effect(
        name="normal_dissipative", section=f"{_SCHEMA}:SeatLoss", help="loss", source="Brogliato, Nonsmooth Mechanics, 2",
        needs=("normal_elastic",), feeds=("force", "wrench", "patch"), called_for=needed_where_it_opens("seat"),
    ),
    Effect(
        name="foam", section=f"{_LAWS}:Foam", help="foam with plateau and densification", source="Driver and Seat",
        needs=("normal_elastic",), excludes=("cushion",), feeds=("force", "wrench"), called_for=_LAW,
    ),
    Effect(
        name="foam_hysteresis", section=f"{_SCHEMA}:SeatHysteresis", help="rate-independent loss of foam",
        needs=("normal_elastic",), feeds=("force", "wrench"), called_for=_LAW,
    ),
    Effect(
        name="general_dissipative", section=f"{_LAWS}:GeneralDissipation", help="loss by the general law",
        needs=("normal_elastic",), excludes=("normal_dissipative",), feeds=("force", "wrench", "patch"),
        called_for=needed_where_it_opens("seat"),
    ),
    Effect(
        name="friction", section=f"{_LAWS}:FrictionSection", help="friction with stick and slip", needs=("normal_elastic",),
        feeds=("force", "wrench", "points"), called_for=_friction,
    ),
    Effect(
        name="contact_field", section=f"{_SCHEMA}:CushionMap", help="pressure map of the cushion",
        source="Johnson, Contact Mechanics, 5.8", needs=("cushion",), publishes="patch", feeds=("patch",),
        called_for=choice_of_model("needed where the pressure under the occupant is requested"),
        not_below={"peak": 6e-3, "area": 1.2e-2},
    ),
    Effect(
        name="half_space_field", section=f"{_SCHEMA}:HalfSpaceField", help="pressure field of a half-space",
        source="Johnson, Contact Mechanics, 5.4", needs=("normal_elastic",),
        excludes=("cushion", "foam", "foam_hysteresis", "contact_field"), publishes="patch", feeds=("patch", "force", "wrench"),
        called_for=choice_of_model("the cushion of the paper; foam on a seat shell is a cushion of finite thickness"),
    ),
    Effect(
        name="softening", section=f"{_SCHEMA}:SofteningSection", help="occupant that softens with vibration",
        source="Huang and Griffin 2006", feeds=("force", "wrench"), called_for=_softening,
    ),
)  # fmt: skip
