"""Resolved scene of the roller rig -> roller, contact over time, track; a scene that cannot run is
refused.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.pressure.closed_form.hertz import HertzError
from contact_sim_pkg.records.fields import given
from contact_sim_pkg.rigs.roller import schema
from contact_sim_pkg.rigs.roller.schema import Damage, Subsurface, TrackWaves
from contact_sim_pkg.rigs.roller.theory.ellipse import (
    EXACT,
    POLYNOMIAL,
    RollingContact,
    contact_of_rollers,
    principal_curvatures,
)
from contact_sim_pkg.rigs.roller.theory.load_split import parallel_contact_load
from contact_sim_pkg.rigs.roller.theory.motion import LARGEST_TILT
from contact_sim_pkg.rigs.roller.theory.parameters import Bending, Curvatures, Roller
from contact_sim_pkg.rigs.roller.theory.stability import RollerError, linearise
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.timing import Timing, make_timing

__all__ = ["RollerModel", "build_roller", "refused"]

LARGEST_SLOPE = 0.5
"""Semi-axis over the radius of the gap along it: Hertz takes the bodies as flat; at 0.5 a circle
lies 7 % off its parabola.
"""


@dataclass(frozen=True)
class Programme:
    """Loads and curvatures over time."""

    time: Vector  # [rows] [s]
    load: Vector  # [rows] [N]
    bending_load: Vector | None  # [rows] [N] Q; None: constant
    curvatures: NDArray[numpy.float64]  # [rows, 4] [1/m] as `Curvatures`
    steps: bool

    def loads(self, times: Vector) -> Vector:
        """Pressed on at `times` [s], in [N]."""
        if self.steps:
            return numpy.asarray(self.load[self._rows(times)])
        return numpy.interp(times, self.time, self.load)

    def bending_load_at(self, time: float, constant: float) -> float:
        """Q [N] at one time [s]; `constant` where the programme gives none."""
        if self.bending_load is None:
            return constant
        if self.steps:
            return float(self.bending_load[self._rows(numpy.array([time]))[0]])
        return float(numpy.interp(time, self.time, self.bending_load))

    def curvatures_at(self, time: float) -> Curvatures:
        """At one time [s]. Radii go straight from row to row, not the curvatures."""
        if self.steps:
            return Curvatures(*(float(value) for value in self.curvatures[self._rows(numpy.array([time]))[0]]))
        return Curvatures(*(_straight(time, self.time, column) for column in self.curvatures.T))

    def curvatures_over(self, times: Vector) -> NDArray[numpy.float64]:
        """At many times [s], [times, 4], columns as `Curvatures`."""
        if not self.turns_bodies:
            return numpy.tile(self.curvatures[0], (len(times), 1))
        return numpy.array([self.curvatures_at(float(time)) for time in times])

    @property
    def turns_bodies(self) -> bool:
        """Whether the curvatures change."""
        return bool((self.curvatures != self.curvatures[0]).any())

    @property
    def bends_shaft(self) -> bool:
        """Whether Q changes."""
        return self.bending_load is not None and float(numpy.ptp(self.bending_load)) > 0.0

    def _rows(self, times: Vector) -> NDArray[numpy.int64]:
        return numpy.maximum(numpy.searchsorted(self.time, times, side="right") - 1, 0)


def _straight(time: float, times: Vector, curvatures: Vector) -> float:
    if (curvatures == 0.0).any():
        return float(numpy.interp(time, times, curvatures))
    return float(1.0 / numpy.interp(time, times, 1.0 / curvatures))


@dataclass(frozen=True)
class RollerModel:
    """Everything that the simulation of one roller scene needs."""

    timing: Timing
    roller: Roller  # spin and friction are 0 where their effects are absent
    modulus: float  # E* [Pa]
    poisson_ratio: float
    mass: float  # [kg]
    shaft_radius: float  # [m]
    turn_time: float  # [s] of the shaft; inf: it stands
    bending: Bending | None  # its load is that of the effect, see `bending_at`
    bending_compliance: float  # k_b [m/N]; 0: the shaft does not bend
    programme: Programme
    kind: int  # of the ellipse
    shares_load: bool
    start: tuple[float, float]  # tilt and yaw [rad] from the static angles
    acceleration: float
    turns: bool  # tilt and yaw are free
    track_waves: TrackWaves | None
    subsurface: Subsurface | None
    damage: Damage | None
    seed: int

    def bending_at(self, time: float) -> Bending | None:
        """The bent shaft under Q(t) of a time [s] (eq 19 of Rolling Contact)."""
        bent = self.bending
        return None if bent is None else bent._replace(load=self.programme.bending_load_at(time, bent.load))

    def contact_load(self, load: float, curvatures: Curvatures) -> float:
        """F_c [N] of the load pressed on."""
        if not self.shares_load:
            return load
        coefficient = contact_of_rollers(curvatures, self.held_yaw, self.modulus, 1.0, self.kind).approach
        return parallel_contact_load(coefficient, self.bending_compliance, load)

    def contact(self, load: float, yaw: float, curvatures: Curvatures) -> RollingContact:
        """Contact under a load [N] on it, at a yaw [rad]."""
        return contact_of_rollers(curvatures, yaw, self.modulus, load, self.kind)

    @property
    def held_yaw(self) -> float:
        """[rad] where the roller does not yaw; 0, about its place at rest, where it does."""
        return 0.0 if self.turns else self.start[1]

    @property
    def traction(self) -> tuple[float, float]:
        """Over the pressure, along x and y: as `subsurface` sets it; along rolling by default that
        of the rolling friction.

        The result: [1].
        """
        below, along = self.subsurface, self.roller.rolling_friction
        if below is None:
            return 0.0, along
        return below.traction_x, along if below.traction_y is None else below.traction_y

    @property
    def largest_load(self) -> float:
        """[N] pressed on over the run."""
        return float(self.programme.load.max())


def build_roller(scene: ResolvedScene) -> RollerModel:
    """Model of a resolved scene. Raises SceneError where it cannot run (`build_roller_checks`)."""
    rig, law = scene.section(schema.RollerRig), given(scene.effect("roller", schema.RollerElastic))
    bending, compliance = _bending(rig, scene.effect("roller", schema.ShaftBending))
    modulus = 0.5 * rig.young_modulus / (1.0 - rig.poisson_ratio**2)
    # Turns of the shaft per second.
    turns = rig.speed * rig.radius / rig.shaft_radius
    model = RollerModel(
        timing=make_timing(scene, False),
        roller=_roller(scene, rig),
        modulus=modulus,
        poisson_ratio=rig.poisson_ratio,
        mass=rig.mass,
        shaft_radius=rig.shaft_radius,
        turn_time=1.0 / turns if turns > 0.0 else math.inf,
        bending=bending,
        bending_compliance=compliance,
        programme=_programme(rig),
        kind=POLYNOMIAL if law.ellipse == "polynomial" else EXACT,
        shares_load=law.split == "parallel" and compliance > 0.0,
        start=(rig.tilt, rig.yaw),
        acceleration=rig.acceleration,
        turns=scene.effect("roller", schema.TiltYawSection) is not None,
        track_waves=scene.effect("roller", TrackWaves),
        subsurface=scene.effect("roller", Subsurface),
        damage=scene.effect("roller", Damage),
        seed=scene.seed,
    )
    # A model that cannot run is refused here, before anything starts.
    _refuse_impossible(model)
    return model


def _roller(scene: ResolvedScene, rig: schema.RollerRig) -> Roller:
    gyroscope, friction = (
        scene.effect("roller", schema.Gyroscope),
        scene.effect("roller", schema.RollingFrictionSection),
    )
    return Roller(
        radius=rig.radius,
        inertia_spin=0.0 if gyroscope is None else gyroscope.inertia_spin,
        spin=2.0 * math.pi * rig.speed,
        rolling_friction=0.0 if friction is None else friction.coefficient,
        inertia_tilt=rig.inertia_tilt,
        inertia_yaw=rig.inertia_yaw,
        inertia_product=rig.inertia_product,
        stiffness_tilt=rig.stiffness_tilt,
        stiffness_yaw=rig.stiffness_yaw,
        damping_tilt=rig.damping_tilt,
        damping_yaw=rig.damping_yaw,
    )


def _bending(rig: schema.RollerRig, effect: schema.ShaftBending | None) -> tuple[Bending | None, float]:
    """The bent shaft, and its compliance A^3 / 3 E J [m/N] at the contact."""
    if effect is None:
        return None, 0.0
    radius, distance = rig.shaft_radius, effect.contact_distance
    moment = 0.25 * math.pi * radius**4
    bending = Bending(effect.load, distance, effect.load_distance, radius, moment, effect.friction)
    return bending, distance**3 / (3.0 * rig.young_modulus * moment)


def _programme(rig: schema.RollerRig) -> Programme:
    """Loads and radii over time; what the programme does not give is constant."""
    rows = rig.programme
    times = numpy.array([0.0] if rows is None else rows.time, float)

    def column(values: list[float] | None, constant: float) -> Vector:
        return numpy.array(values or [constant] * len(times), float)

    columns = [
        column(None if rows is None else rows.profile_radius, rig.profile_radius),
        column(None if rows is None else rows.rolling_radius, rig.radius),
        column(None if rows is None else rows.shaft_radius, rig.shaft_radius),
        column(None if rows is None else rows.shaft_profile_radius, rig.shaft_profile_radius),
    ]
    radii = numpy.stack(columns, axis=1)
    curvatures = numpy.divide(1.0, radii, out=numpy.zeros_like(radii), where=radii > 0.0)
    load = column(None if rows is None else rows.load, rig.load)
    bend = None if rows is None or rows.bending_load is None else numpy.array(rows.bending_load, float)
    return Programme(times, load, bend, curvatures, rows is not None and rows.between == "steps")


def refused(sentence: str) -> SceneError:
    """The error of a roller that cannot run as a whole."""
    return SceneError([Fault("scene", 0, 0, "roller", sentence)])


def _refuse_impossible(model: RollerModel) -> None:
    """Refuse a roller without an ellipse, with a contact larger than the bodies, or without static
    angles.

    Raises SceneError with what is wrong and what to change.
    """
    for row, load in zip(model.programme.curvatures, model.programme.load, strict=True):
        curvatures = Curvatures(*(float(value) for value in row))
        _refuse_no_ellipse(model, curvatures)
        _refuse_large_contact(model, curvatures, model.contact_load(float(load), curvatures))
    if model.turns:
        _refuse_no_static_angles(model)


def _refuse_no_ellipse(model: RollerModel, curvatures: Curvatures) -> None:
    try:
        model.contact(1.0, model.held_yaw, curvatures)
    except HertzError as error:
        raise refused(f"{error}; give profile_radius or shaft_profile_radius a value that is not 0") from None


def _refuse_large_contact(model: RollerModel, curvatures: Curvatures, load: float) -> None:
    contact = model.contact(load, model.held_yaw, curvatures)
    gap = principal_curvatures(curvatures, model.held_yaw)
    bends = (("x", contact.along_x, 2.0 * gap.near_x), ("y", contact.along_y, 2.0 * gap.near_y))
    for axis, semi_axis, curvature in bends:
        if not semi_axis * curvature <= LARGEST_SLOPE:
            raise refused(
                f"under {load:.6g} N the contact reaches {semi_axis:.4g} m nearly along {axis}, more than {LARGEST_SLOPE:g} of the "
                f"radius of {1.0 / curvature:.4g} m that both bodies have there together: no contact of nearly flat bodies; give "
                "a lower load, larger radii or a larger young_modulus"
            )


def _refuse_no_static_angles(model: RollerModel) -> None:
    """Under the load at the start."""
    curvatures = Curvatures(*(float(value) for value in model.programme.curvatures[0]))
    load = model.contact_load(float(model.programme.load[0]), curvatures)
    try:
        linear = linearise(model.roller, curvatures, model.bending_at(0.0), model.modulus, load)
    except RollerError as error:
        about_y = model.roller.stiffness_tilt - load * model.roller.radius
        raise refused(
            f"{error}; stiffness_tilt less load times radius is {about_y:.6g} N m/rad, stiffness_yaw "
            f"{model.roller.stiffness_yaw:.6g} N m/rad: neither may be 0; give stiffer springs or another load, or "
            "leave tilt_yaw out"
        ) from None
    if not abs(linear.tilt) <= LARGEST_TILT:
        raise refused(
            f"under {load:.6g} N the static tilt is {linear.tilt:.4g} rad, the roller tips over at {LARGEST_TILT:g} rad; give a "
            "stiffer stiffness_tilt, a lower load or less bending, or leave tilt_yaw out"
        )
