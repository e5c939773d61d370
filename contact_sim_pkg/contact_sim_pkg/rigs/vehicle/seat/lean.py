"""How an occupant leans: forces of pan and seat back at rest, and the place of the seat back that
follows.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.elastic_law import approach_of_force
from contact_sim_pkg.laws.parameters import Contact
from contact_sim_pkg.rigs.vehicle.motion.parameters import Back
from contact_sim_pkg.rigs.vehicle.seat.biodynamics import rest_deflections
from contact_sim_pkg.rigs.vehicle.seat.occupants import OccupantModel


class Pose(NamedTuple):
    """Pan and seat back, and what presses the occupant against the latter."""

    pan_tilt: float  # [rad] front edge up
    back_angle: float  # [rad] from the vertical, backwards
    preload: float  # [N] that feet or hands push back with


class Lean(NamedTuple):
    """An occupant against a seat back."""

    pose: Pose
    contact: Contact  # of back and seat back; the place of its hysteresis variable is not yet known


class Rest(NamedTuple):
    """An occupant at rest, without friction."""

    pan: float  # [N] along the normal of the pan
    back: float  # [N] along that of the seat back
    heights: Vector  # [masses] [m] over the seat interface


def trunk_of(occupant: OccupantModel) -> int:
    """Number of the mass that leans: the heaviest."""
    return max(range(len(occupant.masses)), key=lambda number: occupant.masses[number])


def pose_of(lean: Lean | None) -> Pose | None:
    """Pan and seat back; None without the latter."""
    return None if lean is None else lean.pose


def rest_of(occupant: OccupantModel, pose: Pose | None, gravity: float) -> Rest:
    """Forces and deflections at rest: ``F_p cos phi + F_b sin theta = M g`` and ``F_b cos theta = F_p
    sin phi + P``; a level pan alone carries the weight.
    """
    weight = occupant.mass * gravity
    if pose is None:
        return Rest(weight, 0.0, rest_deflections(occupant, gravity))
    phi, theta = pose.pan_tilt, pose.back_angle
    pan = (weight * math.cos(theta) - pose.preload * math.sin(theta)) / math.cos(phi - theta)
    back = (weight * math.sin(phi) + pose.preload * math.cos(phi)) / math.cos(phi - theta)
    heights = rest_deflections(occupant, gravity, {trunk_of(occupant): back * math.sin(theta)})
    return Rest(pan, back, heights)


def build_back(lean: Lean, occupant: OccupantModel, pan_law: Contact, gravity: float, offset: int) -> Back:
    """The seat back; ``offset``: place of its hysteresis variable in the state vector.

    At rest x is 0 and the pan is pressed in as its force asks for.
    """
    pose, hysteresis = lean.pose, lean.contact.hysteresis
    rest, trunk = rest_of(occupant, pose, gravity), trunk_of(occupant)
    if hysteresis is not None:
        hysteresis = hysteresis._replace(offset=offset)
    height = interface_at_rest(rest, pose, pan_law) + float(rest.heights[trunk])
    place = approach_of_force(lean.contact.elastic, rest.back) + height * math.sin(pose.back_angle)
    return Back(
        trunk, math.sin(pose.pan_tilt), math.cos(pose.pan_tilt), math.sin(pose.back_angle), math.cos(pose.back_angle),
        place, pose.preload, lean.contact._replace(hysteresis=hysteresis),
    )  # fmt: skip


def interface_at_rest(rest: Rest, pose: Pose | None, pan_law: Contact) -> float:
    """Height [m] of the seat interface at rest over the unloaded pan."""
    cosine = 1.0 if pose is None else math.cos(pose.pan_tilt)
    return -float(approach_of_force(pan_law.elastic, rest.pan)) / cosine
