"""Hard cases of the occupant: a massless seat interface, lift-off and landing, softening links."""

from __future__ import annotations

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.rigs.vehicle.seat.occupants import OCCUPANTS
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of

TIGHT = "integrator.relative_tolerance=1e-7"
DROP = "vibration={kind: half_sine, axis: z, amplitude: -40, duration: 0.1, start: 0.05}"
MASSLESS = [name for name, model in OCCUPANTS.items() if model.masses[0] == 0.0]


def _drop(*values: str) -> tuple[float, int]:
    """Energy residual over the energy turned over, of an occupant that leaves the cushion and comes
    down, 1 where it is pulled; and the samples without contact.
    """
    found = outputs_of("seat_drop", 1.0, TIGHT, *values)
    ledger = records_of(found, "bench/energy")[-1]
    force = numpy.concatenate([record.normal for record in records_of(found, "seat/force")])
    residual = abs(ledger.residual) / max(abs(ledger.supplied), ledger.dissipated)
    return (1.0 if (force < 0.0).any() else residual), int((force == 0.0).sum())


def landing() -> Finding:
    """Largest energy residual over turnover of all named occupants in a drop."""
    residuals, lost = zip(*(_drop(f"seat.occupant.model={name}") for name in OCCUPANTS), strict=True)
    return at_most(max(residuals), 1e-6, hard=min(lost))


def massless_interface() -> Finding:
    """Largest force on the seat less the momentum of the masses over the weight, where the
    interface has no mass.
    """
    worst, lost = 0.0, 10**9
    for name in MASSLESS:
        found, model = outputs_of("seat_ride", 1.0, f"seat.occupant.model={name}", DROP), OCCUPANTS[name]
        force = numpy.concatenate([record.normal for record in records_of(found, "seat/force")])
        lost = min(lost, int((force == 0.0).sum()))
        motion = numpy.hstack([record.acceleration for record in records_of(found, "bench/motion")])
        moved = numpy.array(model.masses) @ (motion[1:] + GRAVITY)
        worst = max(worst, float(abs(force - moved).max()) / (model.mass * GRAVITY))
    return at_most(worst, 1e-9, hard=lost)


def softening() -> Finding:
    """Energy residual over turnover of an occupant whose links soften in a drop."""
    residual, lost = _drop("effects.seat.softening={time_constant: 0.2}")
    return at_most(residual, 1e-5, hard=lost)


def shared_weight() -> Finding:
    """Vertical force of tilted pan and seat back together over the weight of one trunk, less 1."""
    found = outputs_of("seat_ride_full", 0.1, "vibration={kind: sine, frequency: 4, amplitude: 0}")
    pan, back = (records_of(found, f"{contact}/force")[-1].normal for contact in ("seat", "backrest"))
    upward = pan * numpy.cos(0.21) + back * numpy.sin(0.384)
    return at_most(
        float(abs(upward / (OCCUPANTS["wei_griffin_2"].mass * GRAVITY) - 1.0).max()),
        1e-9,
        hard=float((back * numpy.sin(0.384) / upward).min()),
    )


CASES = (
    HardCase("occupant", "every named occupant leaves the cushion and comes down: energy residual", landing,
        guard.contact_lost(50)),
    HardCase(
        "occupant",
        "massless seat interface through lift-off: force less momentum, over weight",
        massless_interface,
        guard.contact_lost(50),
    ),
    HardCase("occupant", "softening links through lift-off: energy residual", softening, guard.contact_lost(50)),
    HardCase("occupant", "pan and seat back under one trunk: vertical force over weight, less 1", shared_weight,
        guard.at_least("share of the weight on the seat back", 0.05)),
)  # fmt: skip
