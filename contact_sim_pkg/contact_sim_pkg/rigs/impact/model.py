"""Resolved scene of the impact rig -> sphere, machine, programme of releases, and the contact law
of any touch.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.records.fields import given
from contact_sim_pkg.rigs.impact import schema, schema_effects
from contact_sim_pkg.rigs.impact.schema_effects import (
    ContactStress,
    GaugeNoise,
    History,
    MicroFront,
    SurfaceWaves,
    ThermalVolume,
)
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere, pair, shares
from contact_sim_pkg.rigs.impact.theory.closed_form.flight import Drop, Machine, Pendulum, fall
from contact_sim_pkg.rigs.impact.theory.contact import ContactLaw
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.motion import FreeImpact, solve_impact
from contact_sim_pkg.rigs.impact.theory.shift import Arrhenius, Shift, Wlf, equivalent_temperature
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.timing import Timing, make_timing

SLOWEST_STATE = 1.0e-3  # [m/s]: below, the sample's state by a shift is that of this speed
ROUNDS = 200


class Release(NamedTuple):
    """One release of the sphere."""

    time: float  # [s]
    speed: float  # [m/s] at the first touch
    temperature: float  # [K] of the sample


class FirstContact(NamedTuple):
    """What a touch finds: the free impact at its speed, and the law that the contact follows under
    weight.
    """

    half_space: Material  # alone; that of the impact is both bodies in series
    impact: FreeImpact
    law: ContactLaw


class Recorded(NamedTuple):
    """Effects that add a topic, by its name below `impact/`."""

    stress: ContactStress | None
    wave: SurfaceWaves | None
    front: MicroFront | None
    position: ThermalVolume | None
    history: History | None


@dataclass(frozen=True)
class MaterialState:
    """The sample's E' and tan(beta) at a temperature and speed: the same everywhere, or by a table
    and a shift.
    """

    sample: Material
    shift: Shift | None = None
    table: NDArray[numpy.float64] | None = None  # [rows, 3] T [K], E' [Pa], tan(beta)
    table_rate: float = 1.0  # [m/s] or [rad/s]
    keep: bool = False

    def at(self, temperature: float, rate: float) -> Material:
        """At ``temperature`` [K] and ``rate``, a speed or a frequency. Raises ImpactError outside
        law and table.
        """
        if self.shift is None or self.table is None:
            return self.sample
        stands = equivalent_temperature(self.shift, temperature, rate, self.table_rate)
        first, last = float(self.table[0, 0]), float(self.table[-1, 0])
        if not self.keep and not first <= stands <= last:
            raise ImpactError(
                f"temperature {temperature:g} K at {rate:.4g} stands at {stands:.5g} K of the table of the shift, which holds "
                f"{first:g} to {last:g} K; extend the table, or keep its ends with beyond: keep"
            )
        logs = numpy.interp(stands, self.table[:, 0], numpy.log(self.table[:, 1]))
        return Material(math.exp(float(logs)), float(numpy.interp(stands, self.table[:, 0], self.table[:, 2])))


@dataclass(frozen=True)
class ImpactModel:
    """Everything that the simulation of one impact scene needs."""

    timing: Timing
    sphere: Sphere
    machine: Machine
    releases: tuple[Release, ...]
    bounces: int  # 0: never caught
    course_samples: int
    half_space: MaterialState
    body: Material | None
    by_frequency: bool
    lossy: bool
    end: str
    shape: str
    poisson_ratio: float
    density: float  # [kg/m^3]
    recorded: Recorded
    noise: GaugeNoise | None
    seed: int

    def touch(self, speed: float, temperature: float) -> FirstContact:
        """The contact of a touch at ``speed`` [m/s]. Raises ImpactError outside the model.

        Frequency and viscous force are those of the free impact at that speed, or at
        ``_speed_of_weight`` where that is higher.
        """
        half_space, impact = self._impact(max(speed, SLOWEST_STATE), temperature)
        gravity = self.machine.gravity if isinstance(self.machine, Drop) else 0.0
        held = max(speed, _speed_of_weight(impact, gravity))
        if held != impact.speed:
            impact = self._solve(half_space, held)
        law = ContactLaw(self.sphere.mass, gravity, impact.elastic, impact.viscous, self.end)
        return FirstContact(half_space, impact, law)

    def half_space_share(self, touch: FirstContact) -> float:
        """D1 [1], the half-space's part of the approach."""
        body = math.inf if self.body is None else self.body.storage_modulus
        return shares(touch.half_space.storage_modulus, body)[0]

    def _impact(self, speed: float, temperature: float) -> tuple[Material, FreeImpact]:
        """Material of the half-space at this touch, and the free impact; with a shift by frequency
        both settle together.
        """
        half_space = self.half_space.at(temperature, self.half_space.table_rate if self.by_frequency else speed)
        impact = self._solve(half_space, speed)
        for _ in range(ROUNDS if self.by_frequency else 0):
            half_space, before = self.half_space.at(temperature, impact.frequency), impact
            impact = self._solve(half_space, speed)
            if abs(impact.duration / before.duration - 1.0) < 1e-13:
                break
        return half_space, impact

    def _solve(self, half_space: Material, speed: float) -> FreeImpact:
        lossless = half_space if self.lossy else Material(half_space.storage_modulus, 0.0)
        body = self.body if self.lossy or self.body is None else Material(self.body.storage_modulus, 0.0)
        return solve_impact(self.sphere, pair(lossless, body), speed, self.end, self.shape)


def _speed_of_weight(impact: FreeImpact, gravity: float) -> float:
    """Speed in [m/s] whose free impact has the frequency of the swing on the static depth x_s,
    ``w^2 = 3/2 g/x_s``.

    A slower touch is a swing under the weight rather than a blow: it is no slower than that, and
    with the frequency of its free impact the viscous force would grow without bound as the speed
    falls. 0 without weight. By ``tau ~ V^(-1/5)``.
    """
    if gravity == 0.0:
        return 0.0
    static = (impact.sphere.mass * gravity / impact.elastic) ** (2.0 / 3.0)
    return float(impact.speed * (math.sqrt(1.5 * gravity / static) / impact.frequency) ** 5)


def build_impact(scene: ResolvedScene) -> ImpactModel:
    """Model of a resolved scene. Raises SceneError where a release is outside the model."""
    impact, loss = scene.section(schema.ImpactSection), scene.effect("impact", schema_effects.SphereLoss)
    sample, shift = impact.sample, scene.effect("impact", schema_effects.Shift)
    body = sample.body_modulus
    recorded = Recorded(
        scene.effect("impact", ContactStress), scene.effect("impact", SurfaceWaves), scene.effect("impact", MicroFront),
        scene.effect("impact", ThermalVolume), scene.effect("impact", History),
    )  # fmt: skip
    model = ImpactModel(
        timing=make_timing(scene, False),
        sphere=Sphere(impact.mass, impact.radius),
        machine=_machine(impact),
        releases=_releases(impact),
        bounces=impact.bounces,
        course_samples=impact.course_samples,
        half_space=_material(sample, shift),
        body=None if body is None else Material(body, sample.body_loss_tangent),
        by_frequency=shift is not None and shift.rate == "frequency",
        lossy=loss is not None,
        end="force" if loss is None else loss.end,
        shape=impact.shape_factor,
        poisson_ratio=given(sample.poisson_ratio),
        density=given(sample.density),
        recorded=recorded,
        noise=scene.effect("impact", GaugeNoise),
        seed=scene.seed,
    )
    # Each release once, so that an impossible one is refused before the run.
    for release in dict.fromkeys((release.speed, release.temperature) for release in model.releases):
        try:
            fall(model.machine, release[0])
            model.touch(*release)
        except ImpactError as error:
            where = "effects.impact" if shift is not None or "loss tangent" in str(error) else "impact"
            sentence = f"a release at {release[0]:g} m/s and {release[1]:g} K: {error}"
            raise SceneError([Fault("scene", 0, 0, where, sentence)]) from None
    return model


def _machine(impact: schema.ImpactSection) -> Machine:
    return Drop(impact.gravity) if impact.machine == "drop" else Pendulum(impact.gravity, impact.arm)


def _releases(impact: schema.ImpactSection) -> tuple[Release, ...]:
    states = [
        (speed, temperature)
        for temperature in impact.temperatures
        for speed in impact.speeds
        for _ in range(impact.repeats)
    ]
    return tuple(Release(number * (impact.period or 0.0), *state) for number, state in enumerate(states))


def _material(sample: schema.Sample, shift: schema_effects.Shift | None) -> MaterialState:
    alone = Material(given(sample.storage_modulus), given(sample.loss_tangent))
    if shift is None:
        return MaterialState(alone)
    law: Shift = (
        Wlf(shift.glass_temperature, shift.c1, shift.c2)
        if shift.law == "wlf"
        else Arrhenius(shift.glass_temperature, shift.activation_energy)
    )
    rate = shift.table_frequency if shift.rate == "frequency" else shift.table_speed
    return MaterialState(alone, law, numpy.array(shift.table, dtype=numpy.float64), rate, shift.beyond == "keep")
