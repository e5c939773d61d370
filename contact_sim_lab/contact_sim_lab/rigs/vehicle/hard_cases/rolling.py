"""Hard cases of bristles, belt and spin: locked wheel, standstill and reversal, lift-off and landing,
no load, long steps.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most
from contact_sim_pkg.rigs.vehicle.machines.flat_track import Track, flat_track
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of

SCENE = "tire_cleat"
LOAD = 4000.0
BELT = "effects.tire.sidewall_compliance={}"
SPIN = (BELT, "effects.tire.wheel_spin={}")
KINETIC = 0.8


def _spinning(speed: float, duration: float, *values: str) -> Track:
    return flat_track(LOAD, speed, duration, *SPIN, *values)


def locked_wheel() -> Finding:
    """Force of a wheel that a brake holds against Coulomb's, from 0.1 to 60 m/s, and what its rim turns
    backward.
    """
    worst, rim = 0.0, 0.0
    for speed in (0.1, 5.0, 60.0):
        values = ("effects.tire.wheel_spin={brake: 20000}", "effects.tire.brush.coefficient_static=0.8")
        track = _spinning(speed, max(0.4, 0.4 / speed), *values)
        error = abs(float(track.force[-1, 0]) / (-KINETIC * LOAD) - 1.0)
        rim = max(rim, abs(float(track.spin[-1])) * track.radius / speed)
        worst = max(worst, error, float(-track.spin.min()))
    return at_most(worst, 1e-3, hard=rim)


def standstill_and_reversal() -> Finding:
    """Energy that friction gains from a tire whose wheel stops, stands and rolls back on a rough road,
    over the energy it takes; infinite where a force is not finite.
    """
    values = (
        "travel={points: [[0, 2], [0.3, 0], [0.5, 0]]}", "effects.tire.wheel_spin={points: [[0, 0, 0], [0.5, -300, 50]]}",
        "road={kind: iso8608, roughness_class: C, length: 20, shortest_wavelength: 0.1, longest_wavelength: 10}",
    )  # fmt: skip
    outputs = outputs_of(SCENE, 0.8, *values)
    lost = numpy.array([record.dissipated for record in records_of(outputs, "tire/shear")])
    spin = min(float(record.spin.min()) for record in records_of(outputs, "tire/axle"))
    forces = numpy.concatenate([record.longitudinal for record in records_of(outputs, "tire/axle")])
    if not numpy.isfinite(forces).all():
        return at_most(float("inf"), 1e-12, hard=spin)
    return at_most(float(-lost[lost < 0.0].sum() / lost.sum()), 1e-12, hard=spin)


def held_at_rest() -> Finding:
    """Speed of the rim [rad/s] under a drive below its brake, standing, within a second."""
    drive, brake = 900, 1000
    track = _spinning(0.0, 1.0, f"effects.tire.wheel_spin={{drive: {drive}, brake: {brake}}}")
    return at_most(float(abs(track.spin).max()), 1e-12, hard=drive / brake)


def landing() -> Finding:
    """Friction over the load where a driven wheel is thrown off a bump of 0.1 m and lands: at most
    static, none in the air.
    """
    values = ("road={kind: bump, position: 3, length: 0.5, height: 0.1}", "effects.tire.wheel_spin={drive: 400}")
    outputs = outputs_of(SCENE, 0.8, *values)
    blocks = records_of(outputs, "tire/shear"), records_of(outputs, "tire/patch")
    worst, in_air = 0.0, 0
    for shear, patch in zip(*blocks, strict=True):
        load = float(patch.pressure.sum()) * patch.cell_x * patch.cell_y
        force = float(numpy.hypot(shear.force_x, shear.force_y))
        in_air += load == 0.0
        worst = max(worst, force if load == 0.0 else force / (1.15 * load) - 1.0)
    return at_most(worst, 1e-9, hard=in_air)


def _steady(track: Track) -> NDArray[numpy.float64]:
    mean: NDArray[numpy.float64] = track.force[-200:].mean(axis=0)
    return mean


def any_speed() -> Finding:
    """Relative change of side force and moment at one slip angle from 1 to 80 m/s, rigid belt and
    friction without a fall.
    """
    values = (
        "effects.tire.sidewall_compliance=null",
        "slip={angle: 0.03}",
        "effects.tire.brush={coefficient_static: 1, coefficient_kinetic: 1}",
    )
    speeds = (1.0, 10.0, 80.0)
    found = numpy.array([_steady(flat_track(LOAD, speed, 1.0 / speed + 0.1, *values))[1:] for speed in speeds])
    return at_most(float((numpy.ptp(found, axis=0) / abs(found[1])).max()), 0.02, hard=max(speeds) / min(speeds))


CASES = (
    HardCase(
        "rolling tire",
        "locked wheel at 0.1 to 60 m/s: error of Coulomb's force, rim that turns back",
        locked_wheel,
        guard.at_most("speed of the rim over that of the road", 1e-3),
    ),
    HardCase("rolling tire", "stopped, standing, turned back: energy gained from friction", standstill_and_reversal,
        guard.below("least spin of the rim [rad/s]", 0.0)),
    HardCase("rolling tire", "a standing wheel under a brake above its drive: spin", held_at_rest,
        guard.at_least("drive over brake", 0.9)),
    HardCase("rolling tire", "driven wheel thrown off a bump, landing: friction above its limit", landing,
        guard.at_least("pressure maps without load", 1)),
    HardCase("rolling tire", "one slip angle at 1 to 80 m/s: change of force and moment", any_speed,
        guard.scales("speeds", 80.0)),
)  # fmt: skip
