"""A tire on a flat-track test machine: constant load on a level road at constant speed, bristles and
belt by the slip or torque of the scene; no vertical motion.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.rigs.vehicle.field.contact_field import PressureField
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.tire.body import body_of
from contact_sim_pkg.rigs.vehicle.tire.brush.rolling_shear import RollingShear, TireStep, Works
from contact_sim_pkg.rigs.vehicle.tire.force_table import gap_over_level_road
from contact_sim_pkg.rigs.vehicle.tire.lattice import standing_load
from contact_sim_pkg.rigs.vehicle.tire.schema import TireSection
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["Track", "flat_track", "track_of"]

SCENE = "tire_braking"
WHEEL = 40.0  # [kg]
GRAVITY = 9.80665
INTERVAL = 5e-3  # [s] from one change of the slip to the next
USUAL_STEP = 2.5e-4  # [s]
TIGHT = 1e-8  # tolerance of the field

Samples = NDArray[numpy.float64]


class Track(NamedTuple):
    """Forces over time, at the contact and on the axle."""

    time: Samples  # [s]
    force: Samples  # [samples, 3] F_x, F_y [N], M_z [N m] of the bristles
    axle: Samples  # [samples, 4] force along, across [N], moment about y, z [N m]
    spin: Samples  # [rad/s] of the rim
    length: float  # [m] of the contact
    dissipated: float  # [J] by the bristles
    radius: float  # [m] effective rolling radius
    works: list[Works]  # [intervals + 1] since the start


def flat_track(load: float, speed: float, duration: float, *values: str) -> Track:
    """Roll the tire of ``tire_braking`` with ``values`` set under a ``load`` [N] at a ``speed`` [m/s]
    for a ``duration`` [s].
    """
    body = f"tire.body_mass={load / GRAVITY - WHEEL}"
    return track_of(load_resolved(SCENE, f"tire.wheel_mass={WHEEL}", body, "slip=null", *values), speed, duration)


def track_of(scene: ResolvedScene, speed: float, duration: float, step: float = USUAL_STEP) -> Track:
    """The same of the tire of a scene under its standing load, with samples and steps of ``step``
    [s].
    """
    model = build(scene)
    friction, grids = model.rolling_friction, model.tire_field
    assert friction is not None
    assert grids is not None
    settings = grids.wide.settings
    x = (numpy.arange(settings.rows) - settings.rows // 2) * settings.cell_x
    y = (numpy.arange(settings.cols) - 0.5 * (settings.cols - 1)) * settings.cell_y
    field = PressureField(settings, "tire")
    gap = gap_over_level_road(body_of(scene).form, x, y)
    field.solve_load(gap, standing_load(scene.section(TireSection), None), TIGHT)
    pressure, origin = field.pressure.copy(), (float(x[0]), float(y[0]))
    friction = replace(friction, longest_step=step)
    rows, count, segments = [], round(duration / INTERVAL), round(INTERVAL / step)
    shear = RollingShear(friction, settings)
    shear.start(pressure, origin, 0.0, 0.0)
    works = [shear.works()]
    for n in range(1, count + 1):
        tire_step = TireStep(
            (n - 1) * INTERVAL, step, segments, speed * n * INTERVAL, 0.0, 0.0, friction.deflection, 1, 0
        )  # fmt: skip
        rows.append(shear.roll(tire_step, pressure, origin)[:segments].copy())
        works.append(shear.works())
    samples, result = numpy.concatenate(rows), shear.publish(pressure).result
    length = float(pressure.any(axis=1).sum()) * settings.cell_x
    return Track(
        step * numpy.arange(len(samples), dtype=numpy.float64), samples[:, :3], samples[:, 3:7], samples[:, 7], length,
        result.dissipated + result.released, friction.radius, works,
    )  # fmt: skip
