"""The rigid body of the rig block, the ground under it, and the contact between them
(Identifiability).
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.records.fields import Section, choice, number, numbers

Bounded: TypeAlias = Annotated[float, Field(ge=-1e6, le=1e6)]
Load: TypeAlias = Annotated[float, Field(ge=-1e12, le=1e12)]
Point: TypeAlias = Annotated[list[float], Field(min_length=2, max_length=3)]

MOST_POINTS = 64


def _vector(unit: str, meaning: str, default: list[float], most: str = "") -> list[float]:
    allowed = f"three numbers, each -{most} to {most} {unit}" if most else "three numbers"
    found: list[float] = numbers(unit, meaning, allowed, default=default, shortest=3, longest=3)
    return found


class BlockGround(Section):
    """Ground: a plane that rises along x, or heights at even distances along x, the same across and
    straight on beyond the ends.

    In the plane corners and edges of the body meet the heights; in space its corners alone, so
    peaks between them go unseen.
    """

    fixed: ClassVar[str] = "the ground is made once"

    slope: float = number(-1.4, 1.4, "rad", "angle at which the plane rises along x", default=0.0)
    heights: list[Bounded] | None = numbers(
        "m", "heights at equal distances along x, in place of the plane; straight between them and beyond the ends",
        "2 to 10000 numbers, each -1e6 to 1e6 m", default=None, shortest=2, longest=10000,
    )  # fmt: skip
    start: float = number(-1e4, 1e4, "m", "x of the first height", default=0.0)
    distance: float = number(1e-4, 1e3, "m", "distance between heights", default=0.05)


class Block(Section):
    """A rigid body that falls, slides, sticks and rests. Positions are of its centre of mass."""

    fixed: ClassVar[str] = "body, start and known forces are given at the start"

    motion: Literal["plane", "space"] = choice("motion in the plane x, z, or in space", default="plane")
    shape: Literal["box", "sphere", "points"] = choice(
        "box of `sides`, sphere of `radius`, or the convex hull of `points` (in the plane a polygon); homogeneous",
        default="box",
    )
    sides: list[float] = _vector("m", "lengths of the box along its axes x, y, z", [0.1, 0.1, 0.1])
    radius: float = number(1e-4, 100.0, "m", "radius of the sphere", default=0.05)
    points: list[Point] | None = numbers(
        "m", "corners, [x, z] in the plane, [x, y, z] in space; shifted so that the centre of mass is the origin",
        "3 to 64 points", default=None, shortest=3, longest=MOST_POINTS,
    )  # fmt: skip
    mass: float = number(1e-6, 1e6, "kg", "mass of the body", default=1.0)
    position: list[Bounded] = _vector("m", "x, y, z of the centre of mass at the start", [0.0, 0.0, 0.2], "1e6")
    rotation: list[Bounded] = _vector(
        "rad", "rotation vector at the start, body to world; in the plane only y", [0.0] * 3, "1e6"
    )
    velocity: list[Bounded] = _vector("m/s", "velocity at the start", [0.0, 0.0, 0.0], "1e6")
    angular_velocity: list[Bounded] = _vector(
        "rad/s", "angular velocity at the start, world axes; in the plane only y", [0.0] * 3, "1e6"
    )
    gravity: float = number(0.1, 1000.0, "m/s^2", "gravity, downward", default=9.81)
    force: list[Load] = _vector("N", "known force at the centre of mass, world axes", [0.0] * 3, "1e12")
    torque: list[Load] = _vector("N m", "known torque, world axes; in the plane only y", [0.0] * 3, "1e12")
    ground: BlockGround = Field(default_factory=BlockGround, description="ground under the body")


class RigidContact(Section):
    """Rigid contact: no penetration, Coulomb friction with true stick, impacts by a rule; solved as
    complementarity.
    """

    fixed: ClassVar[str] = "the solver is made for it"

    friction: float = number(0.0, 5.0, "", "Coulomb friction μ", default=0.3, live="law")
    restitution: float = number(0.0, 1.0, "", "restitution of the rule", default=0.3, live="law")
    rule: Literal["energetic", "poisson", "newton"] = choice(
        "restitution of works (never gains energy), of impulses, or of velocities (may gain energy with friction)",
        default="energetic",
    )
    facets: int = number(0, 64, "", "facets of the friction cone in space, even; 0: the true cone", default=0)


class CompliantContact(Section):
    """Compliant contact in place of the impulses: the points press into the ground. Friction and
    restitution are those of rigid_contact.

    Hunt-Crossley force in each point, its loss set at every touch so that it ends with the
    requested restitution (below 0.01: 0.01); spring and damper along the ground that stick, with a
    Coulomb limit. Stiffer is nearer to rigid, and more expensive.
    """

    fixed: ClassVar[str] = "the points hold their depth and deflection by it"

    stiffness: float = number(1.0, 1e12, "N/m^exponent", "of a point, normal to the ground", default=1e6)
    exponent: float = number(1.0, 3.0, "", "exponent of the depth; 1 is a spring, 1.5 is Hertz", default=1.0)
    tangential_stiffness: float = number(1.0, 1e12, "N/m", "of a point that sticks, along the ground", default=1e6)
    tangential_damping: float | None = number(
        1e-6, 1e9, "N s/m", "damping along the ground; critical for the whole mass when absent", default=None
    )
