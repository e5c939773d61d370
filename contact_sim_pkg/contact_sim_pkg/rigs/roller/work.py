"""Work of the rig roller, estimated before the run."""

from __future__ import annotations

import math
from collections.abc import Iterator

from contact_sim_pkg.records.work import STEP_COST, Work
from contact_sim_pkg.rigs.roller.schema import Damage, Gyroscope, RollerRig, Subsurface, TiltYawSection, TrackWaves
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

CELL_COST = 3e-6  # [s] of a cell of the volume below a contact
# [s] of an interval of a track, a cell of it, a step of the heave
TURN_COST, TRACK_COST, HEAVE_COST = 6e-5, 3e-8, 2e-7
HEAVE_PHASE = 0.06  # [rad] of a step


def work_of_roller(scene: ResolvedScene) -> Iterator[Work]:
    """Turns of the track, steps of the heave over its cells, tilt and yaw, and the volumes below
    the contact.
    """
    rig, duration = scene.section(RollerRig), scene.duration
    below, damage = scene.effect("roller", Subsurface), scene.effect("roller", Damage)
    waves, gyroscope = scene.effect("roller", TrackWaves), scene.effect("roller", Gyroscope)
    bodies = 2 if waves is not None and waves.track == "both" else 1
    # Stress below the surface.
    if below is not None:
        cells = below.cells_x * below.cells_y * below.cells_z
        yield Work("cells of subsurface", 2.0 * cells * len(below.instants), CELL_COST)
        if damage is not None and waves is not None:
            yield Work("cells of damage.table_rows", float(bodies * cells * damage.table_rows), CELL_COST)
    outputs = duration * scene.outputs.force_rate
    # Wear of the track.
    if waves is not None and rig.speed > 0.0:
        radii = (rig.shaft_radius, rig.radius)
        turned = {"shaft": radii[0], "roller": radii[1]}.get(waves.track, max(radii))
        cells = waves.cells * (round(max(radii) / min(radii)) if bodies == 2 else 1)
        length = turned / (rig.speed * rig.radius)
        intervals = duration / length
        if damage is not None and rig.acceleration > 1.0:
            intervals += damage.checks * min(4.0 * rig.acceleration, 1000.0)
        yield Work("turns of the track", intervals, TURN_COST)
        outputs = intervals * cells
        steps = max(1.0, _heave_frequency(rig) * length / cells / HEAVE_PHASE)
        yield Work("cells of the track", outputs, TRACK_COST + steps * HEAVE_COST)
    # Tilt and yaw.
    if scene.effect("roller", TiltYawSection) is not None:
        inertia = min(rig.inertia_tilt, rig.inertia_yaw)
        spin = (0.0 if gyroscope is None else gyroscope.inertia_spin) * 2.0 * math.pi * rig.speed
        rate = math.sqrt(max(rig.stiffness_tilt, rig.stiffness_yaw) / inertia) + spin / inertia
        yield Work("steps of tilt and yaw", max(outputs, rate * duration / 0.15), 4.0 * STEP_COST)


def _heave_frequency(rig: RollerRig) -> float:
    """In [rad/s], of a contact of spheres: kappa^2 = k/m, k = 3 F / 2 d."""
    modulus = 0.5 * rig.young_modulus / (1.0 - rig.poisson_ratio**2)
    radius = 1.0 / (1.0 / rig.radius + 1.0 / rig.shaft_radius)
    depth = (0.75 * rig.load / (modulus * math.sqrt(radius))) ** (2.0 / 3.0)
    return math.sqrt(1.5 * rig.load / (depth * rig.mass))
