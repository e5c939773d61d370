"""Goals of the roller rig: time of a stress point, of a dangerous volume, and of an hour of the
rig.
"""

from __future__ import annotations

import numpy

from contact_sim_lab.records.goal import GoalPart, Measured, median_time
from contact_sim_lab.rigs.roller.paper_bench import CURVATURES, LIMITS, LOAD, MODULUS, POISSON
from contact_sim_lab.rigs.roller.work_precision_interval import hour
from contact_sim_pkg.pressure.closed_form.hertz_stress import EllipseLoad, ellipse_stress
from contact_sim_pkg.rigs.roller.theory.ellipse import contact_of_rollers
from contact_sim_pkg.rigs.roller.theory.volumes import dangerous_volumes

__all__ = ["GOALS", "goals"]

POINTS = 2000
CELLS = (32, 40, 16)
JUMP = 100


def goals() -> list[Measured]:
    """Points all through the working volume; the hour is 720 000 turns of the shaft, heave and
    wear.
    """
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, LOAD)
    largest = max(contact.along_x, contact.along_y)
    # Random points through the working volume.
    box = numpy.array([[2.0 * contact.along_x, 2.0 * contact.along_y, 1.5 * largest]])
    points = box * numpy.random.default_rng(1).uniform((-1.0, -1.0, 0.0), (1.0, 1.0, 2.0), (POINTS, 3))
    load = EllipseLoad(contact.along_x, contact.along_y, contact.peak_pressure, 0.0, 0.1)
    point = median_time(lambda: ellipse_stress(load, POISSON, points)) / POINTS
    volume = median_time(lambda: dangerous_volumes(contact, POISSON, LIMITS, CELLS))
    sizes = "x".join(map(str, CELLS))
    return [
        Measured("stress under the ellipse: a point", 1e6 * point, "µs", note="six components, pressure and traction"),
        Measured("dangerous volumes", 1e3 * volume, "ms", note=f"{sizes} cells"),
        Measured(
            "an hour of the rig, heave and wear",
            hour(JUMP),
            "s",
            most=300.0,
            note=f"a turn that is ridden stands for {JUMP}",
        ),
    ]


GOALS = (GoalPart("roller", goals),)
