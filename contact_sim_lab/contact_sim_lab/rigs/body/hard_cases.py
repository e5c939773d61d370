"""Hard cases of a body on the ground: no friction, parting while sliding is wedged, restitution at
rest; and the compliant twin.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most
from contact_sim_lab.rigs.body.hard_cases_contact import denominator
from contact_sim_lab.rigs.body.rigid_motion import SLIDE
from contact_sim_lab.rigs.body.rigid_problem import block_corner
from contact_sim_pkg.compiled.results import DONE, SENTENCES
from contact_sim_pkg.laws.parameters import NormalElastic
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody, box, placed, regular_block, slope
from contact_sim_pkg.rigid.contact.planar_impact import planar_impact
from contact_sim_pkg.rigid.motion.compliant import CompliantMotion, compliant_contact
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.parameters import ENERGETIC, PlanarContact
from contact_sim_pkg.rigid.results import SOLVED

__all__ = ["CASES"]

SIDE, STIFFNESS, TICK = 0.1, 1e6, 1e-3


def without_friction() -> Finding:
    """Tangential velocity [m/s] that a frictionless block which slides on its face at 2 m/s loses
    in 1 s.
    """
    block = regular_block(SIDE, 1.0, 0.0, 0.3)
    motion = placed(block, numpy.array([0.0, 0.5 * SIDE]), numpy.array([2.0, 0.0, 0.0]))
    body = LocatedBody(block, slope(2), motion)
    solved = all(body.advance(0.01) == SOLVED for _ in range(100))
    return at_most(abs(float(motion.velocity[0]) - 2.0) if solved else math.inf, 1e-15, hard=block.friction)


def parting() -> Finding:
    """Impulse [N s] on a contact that parts while sliding on has a negative denominator: of three
    answers the one without.
    """
    rows, inverse = block_corner(math.pi / 4 - math.atan(0.5))
    mobility = rows * inverse @ rows.T
    contact = PlanarContact(float(mobility[0, 0]), float(mobility[0, 1]), float(mobility[1, 1]), 1.6, 0.2)
    c = planar_impact(contact, ENERGETIC, 0.01, math.copysign(3.0, contact.coupling))
    return at_most(abs(c.normal) + abs(c.tangential), 1e-15, hard=denominator(contact))


def restitution_at_rest() -> Finding:
    """Largest speed [m/s] of a block with restitution 0.9 that lies on the ground for 1 s."""
    block = regular_block(SIDE, 1.0, 0.3, 0.9)
    motion = placed(block, numpy.array([0.0, 0.5 * SIDE]), numpy.zeros(3))
    body, worst, resting = LocatedBody(block, slope(2), motion), 0.0, 0
    for _ in range(1000):
        worst = max(worst, float(numpy.abs(motion.velocity).max())) if body.advance(TICK) == SOLVED else math.inf
        resting += int((body.work.gap <= 1e-9 * SIDE).sum()) >= 2
    return at_most(worst, 1e-15, hard=resting)


def _moved(body: RigidBody, ground: Ground, motion: Motion) -> CompliantMotion:
    contact = compliant_contact(body, NormalElastic(STIFFNESS, 1.0), STIFFNESS)
    return CompliantMotion(body, ground, motion, contact, 1e-7)


def _advance(body: CompliantMotion) -> None:
    status = body.advance(TICK)
    if status != DONE:
        raise ArithmeticError(SENTENCES[status])


def compliant_energy() -> Finding:
    """Largest gain of energy in 1 ms of a box that tumbles over a compliant ground for 1 s, over
    the energy at the start.
    """
    shape = box((0.2, 0.3, 0.1), 2.0, 0.4, 0.5)
    motion = placed(shape, numpy.array([0.0, 0.0, 0.4]), numpy.array([1.0, 0.3, 0.0, 3.0, 5.0, 0.3]))
    body, worst, lowest = _moved(shape, slope(3), motion), 0.0, []
    start = last = _energy(body)
    for _ in range(1000):
        _advance(body)
        now = _energy(body)
        worst, last = max(worst, now - last), now
        heights = (motion.rotation @ shape.points.T)[2]
        first, second = heights.argsort()[:2]
        lowest += [int(first)] if heights[second] - heights[first] > 1e-4 else []
    return at_most(worst / start, 1e-9, hard=int(numpy.count_nonzero(numpy.diff(lowest))))


def _energy(body: CompliantMotion) -> float:
    shape, motion = body.body, body.motion
    spin = motion.rotation.T @ motion.velocity[3:]
    kinetic = 0.5 * shape.mass * motion.velocity[:3] @ motion.velocity[:3] + 0.5 * shape.inertia @ spin**2
    return float(kinetic - shape.load[2] * motion.position[2] + body.stored)


def compliant_slide() -> Finding:
    """Relative difference of the stopping distance on 1e6 N/m from Coulomb's."""
    block = regular_block(SIDE, 1.0, 0.3, 0.0)
    motion = placed(block, numpy.array([0.0, 0.5 * SIDE]), numpy.array([2.0, 0.0, 0.0]))
    body = _moved(block, slope(2), motion)
    for _ in range(1000):
        _advance(body)
    return at_most(abs(float(motion.position[0]) / SLIDE - 1.0), 1e-5, hard=SLIDE * STIFFNESS / (block.mass * 9.81))


def compliant_creep() -> Finding:
    """Mean speed [m/s] in the second after the first of a block on a compliant slope of 15
    degrees.
    """
    angle = math.radians(15.0)
    block = regular_block(SIDE, 1.0, 0.3, 0.3)
    at = 0.5 * SIDE * numpy.array([-math.sin(angle), math.cos(angle)])
    motion = placed(block, at, numpy.zeros(3), angle=angle)
    body, settled = _moved(block, slope(2, angle), motion), at
    for tick in range(2000):
        _advance(body)
        settled = motion.position.copy() if tick == 999 else settled
    return at_most(float(numpy.abs(motion.position - settled).max()), 1e-15, hard=math.tan(angle) / block.friction)


CASES = (
    HardCase("rigid contact", "no friction: speed lost [m/s]", without_friction, guard.zero("friction")),
    HardCase("rigid contact", "Painlevé, parting: impulse [N s]", parting, guard.denominator_below_0()),
    HardCase("rigid motion", "restitution 0.9 at rest: speed [m/s]", restitution_at_rest,
        guard.at_least("ticks on both corners", 1000)),
    HardCase("compliant contact", "tumbling box: energy gained, of it", compliant_energy,
        guard.at_least("changes of the lowest corner", 4)),
    HardCase("compliant contact", "slide to a stop: difference from Coulomb", compliant_slide,
        guard.scales("distance and indentation", 1e4)),
    HardCase("compliant contact", "creep on a slope of 15° [m/s]", compliant_creep,
        guard.at_least("force along the slope over the limit of stick", 0.85)),
)  # fmt: skip
