"""Hard cases of rigid bodies in time: endless bounces, rest, stops of slip, energy, two corners at
once, fast spin.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, exactly
from contact_sim_lab.rigs.body import rigid_motion
from contact_sim_pkg.rigid.body import box, placed, regular_block, slope
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.motion.stepping import SteppedBody
from contact_sim_pkg.rigid.results import SPIN_TOO_FAST


def zeno() -> Finding:
    """Error of the time [s] at which endless bounces end."""
    return at_most(abs(rigid_motion.bounce_to_rest()[0] - rigid_motion.BOUNCE_TIME), 1e-12)


def flat_landing() -> Finding:
    """Turning speed [rad/s] of a block after it fell flat on two corners."""
    block = regular_block(0.1, 1.0, 0.3, 0.5)
    motion = placed(block, numpy.array([0.0, 0.15]), numpy.zeros(3))
    body = LocatedBody(block, slope(2), motion)
    for _ in range(30):
        body.advance(0.01)
    return at_most(abs(float(motion.velocity[2])), 1e-10)


def free_spin() -> Finding:
    """Relative change of the energy of a box that tumbles about its middle axis for 2 s."""
    body = box((0.2, 0.3, 0.1), 2.0, 0.4, 0.5)
    motion = placed(body, numpy.array([0.0, 0.0, 100.0]), numpy.array([0.0, 0.0, 0.0, 20.0, 0.1, 0.1]))
    located = LocatedBody(body, slope(3), motion)
    start = located.kinetic_energy()
    for _ in range(2000):
        located.advance(1e-3)
    fallen = 0.5 * body.mass * float(motion.velocity[2]) ** 2
    return at_most(abs(located.kinetic_energy() - fallen - start) / start, 1e-11)


def too_fast() -> Finding:
    """Status of a step in which the body turns by two radians."""
    block = regular_block(0.1, 1.0, 0.3, 0.3)
    motion = placed(block, numpy.array([0.0, 1.0]), numpy.array([0.0, 0.0, 2000.0]))
    return exactly(SteppedBody(block, slope(2), motion, 1e-3).advance(1), SPIN_TOO_FAST)


def tunnelling() -> Finding:
    """Lowest gap [m] of a block of 1 mm that falls at 100 m/s, at the ends of intervals of 10
    ms.
    """
    block = regular_block(0.001, 1e-3, 0.3, 0.5)
    motion = placed(block, numpy.array([0.0, 0.5]), numpy.array([0.0, -100.0, 0.0]), angle=0.3)
    body, lowest = LocatedBody(block, slope(2), motion), math.inf
    for _ in range(5):
        body.advance(0.01)
        lowest = min(lowest, float(body.work.gap.min()))
    return at_most(max(0.0, -lowest), 1e-12)


CASES = (
    HardCase("rigid motion", "endless bounces: time of rest, error [s]", zeno),
    HardCase("rigid motion", "creep on a slope of 15° in 10 s [m/s]", lambda: at_most(rigid_motion.creep(), 1e-15)),
    HardCase(
        "rigid motion", "slide to a stop: error of the distance", lambda: at_most(rigid_motion.slide_error(None), 1e-9)
    ),
    HardCase("rigid motion", "1000 elastic bounces: energy", lambda: at_most(rigid_motion.elastic_drift(), 1e-12)),
    HardCase("rigid motion", "flat on two corners: turning speed [rad/s]", flat_landing),
    HardCase("rigid motion", "tumbling about the middle axis: energy", free_spin),
    HardCase("rigid motion", "two radians in a step: status", too_fast),
    HardCase("rigid motion", "small and fast: depth below the ground [m]", tunnelling),
)
