"""Hard cases of rigid bodies in time: endless bounces, rest, stops of slip, energy, two corners at
once, fast spin.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, exactly
from contact_sim_lab.rigs.body import rigid_motion
from contact_sim_pkg.rigid.bodies.body import box, placed, regular_block, slope
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.results import SPIN_TOO_FAST


def zeno() -> Finding:
    """Error of the time [s] at which endless bounces end."""
    time, impacts = rigid_motion.bounce_to_rest()
    return at_most(abs(time - rigid_motion.BOUNCE_TIME), 1e-12, hard=impacts)


def creep() -> Finding:
    """Mean speed [m/s] of a block at rest on a slope of 15 degrees."""
    return at_most(rigid_motion.creep(), 1e-15, hard=math.tan(rigid_motion.SLOPE) / rigid_motion.FRICTION)


def slide() -> Finding:
    """Relative error of the distance in which a block at 2 m/s stops."""
    body = rigid_motion.slid()
    error = abs(float(body.motion.position[0]) / rigid_motion.SLIDE - 1.0)
    return at_most(error, 1e-9, hard=abs(float(body.motion.velocity[0])))


def bounces_for_long() -> Finding:
    """Largest change of the energy of a ball over 1000 elastic bounces, of its energy."""
    drift, impacts = rigid_motion.elastic_drift()
    return at_most(drift, 1e-12, hard=impacts)


def flat_landing() -> Finding:
    """Turning speed [rad/s] of a block after it fell flat on two corners."""
    block = regular_block(0.1, 1.0, 0.3, 0.5)
    motion = placed(block, numpy.array([0.0, 0.15]), numpy.zeros(3))
    body, corners = LocatedBody(block, slope(2), motion), 0
    for _ in range(30):
        body.advance(0.01)
        corners = max([corners, *(len(impact.points) for impact in body.impacts)])
    return at_most(abs(float(motion.velocity[2])), 1e-10, hard=corners)


def free_spin() -> Finding:
    """Relative change of the energy of a box that tumbles about its middle axis for 2 s."""
    body = box((0.2, 0.3, 0.1), 2.0, 0.4, 0.5)
    motion = placed(body, numpy.array([0.0, 0.0, 100.0]), numpy.array([0.0, 0.0, 0.0, 20.0, 0.1, 0.1]))
    located = LocatedBody(body, slope(3), motion)
    start, astray = located.kinetic_energy(), 0.0
    for _ in range(2000):
        located.advance(1e-3)
        astray = max(astray, float(abs(motion.rotation.T @ motion.velocity[3:])[1:].max()))
    fallen = 0.5 * body.mass * float(motion.velocity[2]) ** 2
    return at_most(abs(located.kinetic_energy() - fallen - start) / start, 1e-11, hard=astray / 0.1)


def too_fast() -> Finding:
    """Status of an interval of 0.1 s in which the body turns by 1e8 radians."""
    block, interval = regular_block(0.1, 1.0, 0.3, 0.3), 0.1
    motion = placed(block, numpy.array([0.0, 1.0]), numpy.array([0.0, 0.0, 1e9]))
    turn = float(motion.velocity[2]) * interval
    return exactly(LocatedBody(block, slope(2), motion).advance(interval), SPIN_TOO_FAST, hard=turn)


def tunnelling() -> Finding:
    """Lowest gap [m] of a block of 1 mm that falls at 100 m/s, at the ends of intervals of 10
    ms.
    """
    block = regular_block(0.001, 1e-3, 0.3, 0.5)
    motion = placed(block, numpy.array([0.0, 0.5]), numpy.array([0.0, -100.0, 0.0]), angle=0.3)
    way = abs(float(motion.velocity[1])) * 0.01
    body, lowest = LocatedBody(block, slope(2), motion), math.inf
    for _ in range(5):
        body.advance(0.01)
        lowest = min(lowest, float(body.work.gap.min()))
    return at_most(max(0.0, -lowest), 1e-12, hard=way / 0.001)


CASES = (
    HardCase("rigid motion", "endless bounces: time of rest, error [s]", zeno, guard.impacts(50)),
    HardCase("rigid motion", "creep on a slope of 15° in 10 s [m/s]", creep,
        guard.at_least("force along the slope over the limit of stick", 0.85)),
    HardCase("rigid motion", "slide to a stop: error of the distance", slide, guard.zero("speed at the end [m/s]")),
    HardCase("rigid motion", "1000 elastic bounces: energy", bounces_for_long, guard.impacts(1000)),
    HardCase("rigid motion", "flat on two corners: turning speed [rad/s]", flat_landing,
        guard.at_least("corners in one impact", 2)),
    HardCase("rigid motion", "tumbling about the middle axis: energy", free_spin,
        guard.at_least("largest spin about another axis over that at the start", 10.0)),
    HardCase("rigid motion", "1e8 radians in an interval: status", too_fast,
        guard.above("turn in the interval [rad]", 1e5)),
    HardCase("rigid motion", "small and fast: depth below the ground [m]", tunnelling,
        guard.scales("way in an interval and side", 1000.0)),
)  # fmt: skip
