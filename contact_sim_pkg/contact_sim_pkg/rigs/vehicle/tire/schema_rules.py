"""Rules that tie keys of the tire's effects together."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from contact_sim_pkg.rigs.vehicle.tire.magic_formula.section import MagicFormulaSection
from contact_sim_pkg.rigs.vehicle.tire.schema import (
    BrushSection,
    Inflation,
    RigidRingSection,
    RollingLossSection,
    SidewallComplianceSection,
    TireSection,
    TreadViscoelasticitySection,
    WheelSpinSection,
)
from contact_sim_pkg.rigs.vehicle.tire.size import read_size
from contact_sim_pkg.scene.errors import Breach, SceneError
from contact_sim_pkg.scene.schema.catalog import show
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.travel import points_of

LOWEST_SLIP, HIGHEST_SLIP, LARGEST_ANGLE = -1.0, 10.0, 1.5
LONGEST_TIME = 3600.0  # [s]
LARGEST_TORQUE = 1e5  # [N m]
FASTEST = 1000.0  # [Hz] of a belt on its sidewalls
USUAL_AREA = 0.02  # [m^2] of bristles


def slip_breaches(scene: Scene) -> Iterator[Breach]:
    """A slip that nothing uses, slips given twice, points out of order or range."""
    slip, programme = scene.slip, _programme_of(scene)
    if slip is None and programme is None:
        return
    given = "slip" if slip is not None else "tire.programme"
    if scene.effect("tire", BrushSection) is None and scene.effect("tire", MagicFormulaSection) is None:
        sentence = "acts through the effect brush or magic_formula, neither of which the scene names; add effects.tire.brush: {}"
        yield Breach(given, sentence)
    points = programme if slip is None else slip.points
    constant = None if slip is None else slip.longitudinal
    spins = scene.effect("tire", WheelSpinSection) is not None
    if spins and (constant is not None or any(point[1] != 0.0 for point in points or ())):
        where = "slip.longitudinal" if constant is not None else "tire.programme" if slip is None else "slip.points"
        yield Breach(where, "the rim turns by effects.tire.wheel_spin; give its drive and brake, not the slip")
    if slip is None:
        return
    yield from _points_breaches(
        "slip", slip.points, {"longitudinal": slip.longitudinal, "angle": slip.angle},
        ((0.0, LONGEST_TIME, " s"), (LOWEST_SLIP, HIGHEST_SLIP, ""), (-LARGEST_ANGLE, LARGEST_ANGLE, " rad")),
    )  # fmt: skip


def _programme_of(scene: Scene) -> list[list[float]] | None:
    """Slips over time that the programme of the tire gives; None: none, or none that can be read."""
    try:
        return points_of(scene, "slip", "slip_angle")
    except SceneError:  # said of its file
        return None


def _points_breaches(
    where: str,
    points: list[list[float]] | None,
    constant: dict[str, float | None],
    ranges: tuple[tuple[float, float, str], ...],
) -> Iterator[Breach]:
    """Values over time given twice, points out of order or out of their ``ranges``."""
    if points is None:
        return
    # Points replace the constant values.
    for key, value in constant.items():
        if value is not None:
            yield Breach(f"{where}.{key}", f"{key} and points are both given; keep one", (f"{where}.points",))
    if points[0][0] != 0.0:
        sentence = f"the first time is {show(points[0][0])} s; it must be 0"
        yield Breach(f"{where}.points.0.0", sentence, (f"{where}.points",))
    for index, (before, after) in enumerate(pairwise(points), start=1):
        if not after[0] > before[0]:
            sentence = f"time {show(after[0])} s does not come after {show(before[0])} s; times must increase"
            yield Breach(f"{where}.points.{index}.0", sentence, (f"{where}.points",))
    # Each column has its own range.
    for index, point in enumerate(points):
        for place, (value, (low, high, unit)) in enumerate(zip(point, ranges, strict=True)):
            if not low <= value <= high:
                sentence = f"{show(value)}{unit} is outside {show(low)} to {show(high)}{unit}"
                yield Breach(f"{where}.points.{index}.{place}", sentence, (f"{where}.points",))


def tire_effect_breaches(scene: Scene) -> Iterator[Breach]:
    """A belt heavier than its wheel, kinetic friction above static, torques and branches out of
    range.
    """
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
    inflation = scene.effect("tire", Inflation)
    if inflation is not None:
        yield from _share_breaches(inflation)
    brush = scene.effect("tire", BrushSection)
    if brush is not None and brush.coefficient_kinetic > brush.coefficient_static:
        sentence = f"{show(brush.coefficient_kinetic)} is above coefficient_static ({show(brush.coefficient_static)})"
        yield Breach(f"{where}.brush.coefficient_kinetic", sentence, (f"{where}.brush.coefficient_static",))
    spin = scene.effect("tire", WheelSpinSection)
    if spin is not None:
        yield from _points_breaches(
            f"{where}.wheel_spin", spin.points, {"drive": spin.drive, "brake": spin.brake},
            ((0.0, LONGEST_TIME, " s"), (-LARGEST_TORQUE, LARGEST_TORQUE, " N m"), (0.0, LARGEST_TORQUE, " N m")),
        )  # fmt: skip
    yield from _belt_breaches(scene, f"{where}.sidewall_compliance")
    # The schema bounds the number of branches, not their values.
    for name, section in (("tread_viscoelasticity", TreadViscoelasticitySection), ("rolling_loss", RollingLossSection)):
        rubber = scene.effect("tire", section)
        for index, (ratio, time) in enumerate(() if rubber is None else rubber.branches or ()):
            place = f"{where}.{name}.branches.{index}"
            if not 0.0 <= ratio <= 100.0:
                yield Breach(f"{place}.0", f"{show(ratio)} is outside 0 to 100")
            if not 1e-6 <= time <= 1e4:
                yield Breach(f"{place}.1", f"{show(time)} s is outside 1e-06 to 10000 s")


def _share_breaches(inflation: Inflation) -> Iterator[Breach]:
    """A radius that is not of the size; sidewalls that carry all of the inflation, so that none is left to the belt."""
    where = "effects.tire.inflation"
    try:
        size = read_size(inflation.size, inflation.radius)
    except ValueError as error:
        yield Breach(f"{where}.radius", str(error), (f"{where}.size",))
        return
    chord, width = inflation.sidewall_chord or size.sidewall_chord, inflation.belt_width or size.belt_width
    least = math.atan(chord / width)
    if inflation.sidewall_angle <= least:
        sentence = (
            f"the sidewalls carry all of the inflation at {show(inflation.sidewall_angle)} rad: a chord of "
            f"{show(round(chord, 4))} m beside a belt of {show(round(width, 4))} m needs more than {show(round(least, 4))} rad"
        )
        others = tuple(f"{where}.{key}" for key in ("sidewall_chord", "belt_width", "radius", "size"))
        yield Breach(f"{where}.sidewall_angle", sentence, others)


def _belt_breaches(scene: Scene, where: str) -> Iterator[Breach]:
    """A belt that swings faster than the steps of bristles and belt can follow."""
    belt, brush = scene.effect("tire", SidewallComplianceSection), scene.effect("tire", BrushSection)
    if belt is None or brush is None:
        return
    opened = belt.open_values(scene)
    mass, along = belt.belt_mass or opened["belt_mass"], belt.longitudinal or opened["longitudinal"]
    spin = scene.effect("tire", WheelSpinSection)
    lightest = belt.belt_inertia if spin is None else min(belt.belt_inertia, spin.inertia)
    swings = (
        (f"{where}.longitudinal", along, mass), (f"{where}.lateral", belt.lateral, mass),
        (f"{where}.rotational", belt.rotational, lightest), (f"{where}.yaw", belt.yaw, 0.5 * belt.belt_inertia),
        ("effects.tire.brush.stiffness_x", brush.stiffness_x * USUAL_AREA, mass),
        ("effects.tire.brush.stiffness_y", brush.stiffness_y * USUAL_AREA, mass),
    )  # fmt: skip
    for key, stiffness, inertia in swings:
        frequency = math.sqrt(stiffness / inertia) / (2.0 * math.pi)
        if frequency > FASTEST:
            sentence = f"the belt swings on it with {show(round(frequency))} Hz; it must be at most {show(FASTEST)} Hz"
            yield Breach(key, f"{sentence}: a rigid belt is written without sidewall_compliance", (where,))
