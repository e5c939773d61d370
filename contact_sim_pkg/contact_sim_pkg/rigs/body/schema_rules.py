"""Rules that tie keys of the rigid body together."""

from __future__ import annotations

import math
from collections.abc import Iterator

from contact_sim_pkg.rigs.body.schema import Block, CompliantContact, RigidContact
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show
from contact_sim_pkg.scene.schema.scene import Scene

FLAT = 1e-9  # volume of a hull over that of its box: below it has none


def block_breaches(scene: Scene) -> Iterator[Breach]:
    """A shape that has no volume, motion out of the plane, a friction cone without middle, a step
    that does not fit.
    """
    block = scene.section(Block)
    faults = list(_shape(block))
    yield from faults
    # a shape that is wrong has no lowest point
    if not faults:
        yield from _above_ground(block)
    if block.motion == "plane":
        yield from _plane(block)
    if block.ground.heights is not None and block.ground.slope != 0.0:
        sentence = (
            f"{show(block.ground.slope)} rad has no meaning beside heights; put the slope into them or remove one"
        )
        yield Breach("block.ground.slope", sentence, ("block.ground.heights",))
    # rules of the contact
    law = scene.effect("block", RigidContact)
    if law is None:
        return
    if block.motion == "plane" and law.facets:
        sentence = f"{law.facets} has no meaning in the plane, whose cone has two edges; take 0 or motion: space"
        yield Breach("effects.block.rigid_contact.facets", sentence, ("block.motion",))
    yield from _facets(law)
    if scene.effect("block", CompliantContact) is not None:
        yield from _compliant(law)


def _compliant(law: RigidContact) -> Iterator[Breach]:
    """What only impulses have."""
    for name, only in (("rule", "energetic"), ("facets", 0)):
        if getattr(law, name) != only:
            sentence = (
                f"{getattr(law, name)} has no meaning with compliant_contact, which has no impulses; take {only} or remove "
                "compliant_contact"
            )
            yield Breach(f"effects.block.rigid_contact.{name}", sentence, ("effects.block.compliant_contact",))


def _facets(law: RigidContact) -> Iterator[Breach]:
    if law.facets % 2 or law.facets == 2:
        sentence = f"{law.facets} is odd or too few; take an even number from 4, or 0 for the true cone"
        yield Breach("effects.block.rigid_contact.facets", sentence)


def _shape(block: Block) -> Iterator[Breach]:
    if not all(1e-4 <= side <= 100.0 for side in block.sides):
        yield Breach("block.sides", f"{block.sides} leaves 1e-4 to 100 m")
    if (block.shape == "points") != (block.points is not None):
        cure = "give points" if block.points is None else "take shape: points"
        yield Breach("block.points", f"shape and points go together; {cure}", ("block.shape",))
    elif block.points is not None:
        size = 2 if block.motion == "plane" else 3
        wrong = next((point for point in block.points if len(point) != size), None)
        if wrong is not None:
            yield Breach("block.points", f"{wrong} has {len(wrong)} numbers; motion in the {block.motion} needs {size}")
        elif not _has_volume(block.points):
            yield Breach("block.points", "the points span no volume; move one out of their line or plane")


def _above_ground(block: Block) -> Iterator[Breach]:
    # needs the compiled core, as this rig alone does
    from contact_sim_pkg.rigs.body.model import rise_at_start

    rise = rise_at_start(block)
    if rise > 0.0:
        sentence = f"puts the body into the ground at the start; raise its z by {show(rise)} m"
        yield Breach("block.position", sentence, ("block.ground",))


def _has_volume(points: list[list[float]]) -> bool:
    from contact_sim_pkg.rigs.body.hull import homogeneous_hull

    try:
        hull = homogeneous_hull(points, 1.0)
    except ArithmeticError:
        return False
    return bool(math.isfinite(hull.volume) and hull.volume > 0.0)


def _plane(block: Block) -> Iterator[Breach]:
    for name in ("rotation", "angular_velocity", "torque"):
        x, _y, z = getattr(block, name)
        if x != 0.0 or z != 0.0:
            sentence = f"{getattr(block, name)} turns out of the plane x, z; keep its y alone or take motion: space"
            yield Breach(f"block.{name}", sentence, ("block.motion",))
    for name in ("position", "velocity", "force"):
        if getattr(block, name)[1] != 0.0:
            sentence = f"{getattr(block, name)} leaves the plane x, z; make its y 0 or take motion: space"
            yield Breach(f"block.{name}", sentence, ("block.motion",))
