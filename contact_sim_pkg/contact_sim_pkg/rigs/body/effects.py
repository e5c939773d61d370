"""Effects of the contact between a rigid body and the ground."""

from __future__ import annotations

from contact_sim_pkg.records.effect import Effect

__all__ = ["BLOCK_EFFECTS"]

_SCHEMA = f"{__package__}.schema"

BLOCK_EFFECTS = (
    Effect(
        name="rigid_contact", section=f"{_SCHEMA}:RigidContact", help="rigid contact with friction", source="Identifiability",
        carries=True, feeds=("force", "wrench", "points"),
    ),
    Effect(
        name="compliant_contact", section=f"{_SCHEMA}:CompliantContact",
        help="the same contact with springs and dampers in place of impulses", source="Brogliato, Nonsmooth Mechanics, 2",
        needs=("rigid_contact",), feeds=("force", "wrench", "points"),
    ),
)  # fmt: skip
