"""Metrics of a rigid body over the ground: when it rests, what it loses, what momentum says of it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from contact_sim_pkg.records.metric import EVENT, Metric
from contact_sim_pkg.report.energy import throughput
from contact_sim_pkg.report.metrics.maker import Maker, at_most, near
from contact_sim_pkg.report.series import ContactSeries, LedgerSeries, MotionSeries, Recording
from contact_sim_pkg.rigs.body.report.numbers import BLOCK, bursts, rest_from

HEIGHT = "block_z"


def block_metrics(recording: Recording) -> list[Metric]:
    """The list of a body; none without its motion."""
    contact, motion = recording.contacts.get(BLOCK), recording.motion
    if contact is None or motion is None:
        return []
    window = float(contact.time[0]), float(contact.time[-1]) + contact.sample_period
    make = Maker(BLOCK, f"{BLOCK}/force", window, basis=EVENT).make
    rests = rest_from(motion)
    found = [*_rest(make, motion, rests), *_impulses(make, recording, contact, motion, rests)]
    return [*found, *_friction(make, recording, contact), *_energy(make, recording, rests)]


def _rest(make: Any, motion: MotionSeries, rests: float | None) -> Iterator[Metric]:
    """When it comes to rest."""
    doubts = () if rests is not None else ("too short: it still moves at the end",)
    yield make("rest", "at rest from", math.nan if rests is None else rests, "s", topic="bench/motion", broken=doubts,
               error=motion.sample_period, count=motion.time.size)  # fmt: skip


def _impulses(
    make: Any, recording: Recording, contact: ContactSeries, motion: MotionSeries, rests: float | None
) -> Iterator[Metric]:
    """Contacts, their impulses until the body rests, and the balance of vertical momentum over the run: sum of
    impulses = m (g T + v_end - v_0).
    """
    found, block = bursts(contact, rests), recording.scene.get("block") or {}
    yield make("contacts", "contacts", len(found), "")
    largest = max(found, key=lambda each: each.impulse, default=None)
    yield make("impulse_largest", "largest impulse", largest.impulse if largest else 0.0, "N s", count=len(found),
               remark=f"at {largest.start:.3f} s" if largest else "")  # fmt: skip
    total = float(contact.normal.sum()) * contact.sample_period
    name = next((each for each in motion.velocity if each.endswith("z")), "")
    if not name or not block.get("mass") or (block.get("ground") or {}).get("slope") or any(block.get("force") or ()):
        yield make("impulse", "sum of the impulses", total, "N s", count=len(found))
        return
    change = float(motion.velocity[name][-1] - motion.velocity[name][0])
    weighed = float(block["gravity"]) * contact.normal.size * contact.sample_period
    needed, mass = weighed + change, float(block["mass"])
    yield make("impulse", "sum of the impulses", total, "N s", count=len(found),
               band=near(mass * needed, 0.01, "momentum, m (g T + Δv)", scale=mass * weighed))  # fmt: skip
    if total > 0.0:
        yield make("mass", "mass by momentum", total / needed, "kg", band=near(mass, 0.01, "mass of the scene"))
        first = next((float(each) for each in contact.time[contact.normal > 0.0]), math.nan)
        yield make("first", "first contact", first, "s", error=contact.sample_period)


def _friction(make: Any, recording: Recording, contact: ContactSeries) -> Iterator[Metric]:
    """Friction over the normal force, as impulses."""
    keys = ((recording.scene.get("effects") or {}).get(BLOCK) or {}).get("rigid_contact")
    total = float(contact.normal.sum())
    if not keys or total <= 0.0 or not contact.tangential.any():
        return
    ratio, coefficient = float(np.abs(contact.tangential).sum()) / total, float(keys["friction"])
    yield make("friction", "friction over normal impulse", ratio, "", count=contact.normal.size,
               band=at_most(coefficient * (1.0 + 1e-6), f"Coulomb, µ {coefficient:g}"))  # fmt: skip


def _energy(make: Any, recording: Recording, rests: float | None) -> Iterator[Metric]:
    """What it loses, which is all that it had where it rests."""
    ledger: LedgerSeries | None = recording.ledger
    if ledger is None:
        return
    lost, topic = float(ledger.dissipated[-1]), "bench/energy"
    fallen = -float(ledger.potential[-1] + ledger.kinetic[-1] + ledger.stored[-1] - ledger.supplied[-1])
    band = near(fallen, 0.01, "kinetic and potential energy given up", scale=throughput(ledger))
    yield make("loss", "energy lost", lost, "J", band=band, topic=topic, count=ledger.time.size)
