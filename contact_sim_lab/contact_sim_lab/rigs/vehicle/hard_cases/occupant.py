"""Hard cases of the occupant: a massless seat interface, lift-off and landing, softening links."""

from __future__ import annotations

import numpy

from contact_sim_lab.records.hard_case import Finding, HardCase, at_most
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.rigs.vehicle.seat.occupants import OCCUPANTS
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of

TIGHT = "integrator.relative_tolerance=1e-7"
DROP = "vibration={kind: half_sine, axis: z, amplitude: -40, duration: 0.1, start: 0.05}"
MASSLESS = [name for name, model in OCCUPANTS.items() if model.masses[0] == 0.0]


def _residual(*values: str) -> float:
    """Energy residual over the energy turned over, of an occupant that leaves the cushion and comes
    down; 1 where it does not leave it, or is pulled.
    """
    found = outputs_of("seat_drop", 1.0, TIGHT, *values)
    ledger = records_of(found, "bench/energy")[-1]
    if min(float(record.normal.min()) for record in records_of(found, "seat/force")) != 0.0:
        return 1.0
    return abs(ledger.residual) / max(abs(ledger.supplied), ledger.dissipated)


def landing() -> Finding:
    """Largest energy residual over turnover of all named occupants in a drop."""
    return at_most(max(_residual(f"seat.occupant.model={name}") for name in OCCUPANTS), 1e-6)


def massless_interface() -> Finding:
    """Largest force on the seat less the momentum of the masses over the weight, where the
    interface has no mass.
    """
    worst = 0.0
    for name in MASSLESS:
        found, model = outputs_of("seat_ride", 1.0, f"seat.occupant.model={name}", DROP), OCCUPANTS[name]
        force = numpy.concatenate([record.normal for record in records_of(found, "seat/force")])
        motion = numpy.hstack([record.acceleration for record in records_of(found, "bench/motion")])
        moved = numpy.array(model.masses) @ (motion[1:] + GRAVITY)
        worst = max(worst, float(abs(force - moved).max()) / (model.mass * GRAVITY))
    return at_most(worst, 1e-9)


def softening() -> Finding:
    """Energy residual over turnover of an occupant whose links soften in a drop."""
    return at_most(_residual("effects.seat.softening={time_constant: 0.2}"), 1e-5)


def shared_weight() -> Finding:
    """Vertical force of tilted pan and seat back together over the weight of one trunk, less 1."""
    found = outputs_of("seat_ride_full", 0.1, "vibration={kind: sine, frequency: 4, amplitude: 0}")
    pan, back = (records_of(found, f"{contact}/force")[-1].normal for contact in ("seat", "backrest"))
    upward = pan * numpy.cos(0.21) + back * numpy.sin(0.384)
    return at_most(float(abs(upward / (OCCUPANTS["wei_griffin_2"].mass * GRAVITY) - 1.0).max()), 1e-9)


CASES = (
    HardCase("occupant", "every named occupant leaves the cushion and comes down: energy residual", landing),
    HardCase(
        "occupant", "massless seat interface through lift-off: force less momentum, over weight", massless_interface
    ),
    HardCase("occupant", "softening links through lift-off: energy residual", softening),
    HardCase("occupant", "pan and seat back under one trunk: vertical force over weight, less 1", shared_weight),
)
