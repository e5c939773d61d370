"""Rules that tie keys of the tire's effects together."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from contact_sim_pkg.rigs.vehicle.tire.schema import (
    BrushSection,
    RigidRingSection,
    TireSection,
    TreadViscoelasticitySection,
)
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show
from contact_sim_pkg.scene.schema.scene import Scene

LOWEST_SLIP, HIGHEST_SLIP, LARGEST_ANGLE = -1.0, 10.0, 1.5
LONGEST_TIME = 3600.0  # [s]


def slip_breaches(scene: Scene) -> Iterator[Breach]:
    """A slip that nothing uses, slips given twice, points out of order or range."""
    slip = scene.slip
    if slip is None:
        return
    if scene.effect("tire", BrushSection) is None:
        yield Breach("slip", "acts through the effect brush, which the scene does not name; add effects.tire.brush: {}")
    if slip.points is None:
        return
    # Points replace the constant slips.
    for key in ("longitudinal", "angle"):
        if getattr(slip, key) is not None:
            yield Breach(f"slip.{key}", f"{key} and points are both given; keep one", ("slip.points",))
    if slip.points[0][0] != 0.0:
        yield Breach(
            "slip.points.0.0", f"the first time is {show(slip.points[0][0])} s; it must be 0", ("slip.points",)
        )
    for index, (before, after) in enumerate(pairwise(slip.points), start=1):
        if not after[0] > before[0]:
            sentence = f"time {show(after[0])} s does not come after {show(before[0])} s; times must increase"
            yield Breach(f"slip.points.{index}.0", sentence, ("slip.points",))
    # Each column has its own range.
    ranges = ((0.0, LONGEST_TIME, " s"), (LOWEST_SLIP, HIGHEST_SLIP, ""), (-LARGEST_ANGLE, LARGEST_ANGLE, " rad"))
    for index, point in enumerate(slip.points):
        for place, (value, (low, high, unit)) in enumerate(zip(point, ranges, strict=True)):
            if not low <= value <= high:
                sentence = f"{show(value)}{unit} is outside {show(low)} to {show(high)}{unit}"
                yield Breach(f"slip.points.{index}.{place}", sentence, ("slip.points",))


def tire_effect_breaches(scene: Scene) -> Iterator[Breach]:
    """A belt heavier than its wheel, kinetic friction above static, branches out of range."""
    where, wheel_mass, rigid_ring = (
        "effects.tire",
        scene.section(TireSection).wheel_mass,
        scene.effect("tire", RigidRingSection),
    )
    if rigid_ring is not None and not rigid_ring.belt_mass < wheel_mass:
        sentence = (
            f"{show(rigid_ring.belt_mass)} kg is not below tire.wheel_mass ({show(wheel_mass)} kg), which holds it"
        )
        yield Breach(f"{where}.rigid_ring.belt_mass", sentence, ("tire.wheel_mass",))
    brush = scene.effect("tire", BrushSection)
    if brush is not None and brush.coefficient_kinetic > brush.coefficient_static:
        sentence = f"{show(brush.coefficient_kinetic)} is above coefficient_static ({show(brush.coefficient_static)})"
        yield Breach(f"{where}.brush.coefficient_kinetic", sentence, (f"{where}.brush.coefficient_static",))
    # The schema bounds the number of branches, not their values.
    tread = scene.effect("tire", TreadViscoelasticitySection)
    for index, (ratio, time) in enumerate(() if tread is None else tread.branches):
        place = f"{where}.tread_viscoelasticity.branches.{index}"
        if not 0.0 <= ratio <= 100.0:
            yield Breach(f"{place}.0", f"{show(ratio)} is outside 0 to 100")
        if not 1e-6 <= time <= 1e4:
            yield Breach(f"{place}.1", f"{show(time)} s is outside 1e-06 to 10000 s")
