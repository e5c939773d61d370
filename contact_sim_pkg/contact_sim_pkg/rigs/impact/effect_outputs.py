"""What the effects of the impact rig say of one impact; one function an effect, none where the
scene does not name it.

Frequency, damping and k_p are those of the free impact that the touch finds; depth, speed and
forces those of the contact itself.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.messages import ImpactFront, ImpactHistory, ImpactPosition, ImpactStress, ImpactWave
from contact_sim_pkg.rigs.impact.model import ImpactModel
from contact_sim_pkg.rigs.impact.motion import FinishedImpact, course_of
from contact_sim_pkg.rigs.impact.schema_effects import ContactStress, History, MicroFront, SurfaceWaves, ThermalVolume
from contact_sim_pkg.rigs.impact.theory import micro_front, position, stress, surface_wave
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.viscoelastic import creep, hereditary
from contact_sim_pkg.rigs.impact.theory.viscoelastic.relaxation import maxwell_time, retardation_time
from contact_sim_pkg.run.errors import RunError

FINE = 401  # instants of the force that the hereditary integral takes


def stress_of(model: ImpactModel, effect: ContactStress, block: int, impact: FinishedImpact) -> ImpactStress:
    """Stress over the contact radius, elastic and viscous."""
    times, depth, speed, _elastic, _viscous = course_of(impact, effect.instants)
    limit = micro_front.front_time(impact.touch.impact, _shear_speed(model, impact)).depth
    places: Vector = numpy.linspace(0.0, 1.0, effect.places, dtype=numpy.float64)
    free, shape = impact.touch.impact, effect.shape
    centres = [stress.centre_stress(free, float(x), float(v), limit, shape) for x, v in zip(depth, speed, strict=True)]
    over = stress.distribution(1.0, places, shape)
    radius: Vector = free.shape * numpy.sqrt(free.sphere.radius * numpy.maximum(depth, 0.0))
    return ImpactStress(
        block=block, number=impact.number, start=impact.start, shape=shape, time=times, radius=radius, place=places,
        elastic=numpy.array([each.elastic for each in centres])[:, None] * over,
        viscous=numpy.array([each.viscous for each in centres])[:, None] * over,
        limited=numpy.array([each.limited for each in centres], dtype=numpy.uint8),
    )  # fmt: skip


def wave_of(model: ImpactModel, effect: SurfaceWaves, block: int, impact: FinishedImpact) -> ImpactWave:
    """Ring and circular wave."""
    half_space, free = impact.touch.half_space, impact.touch.impact
    wave = surface_wave.surface_wave(free, _shear_modulus(model, impact), model.density, model.poisson_ratio)
    turns = impact.phases[0].turns
    assert turns is not None
    # Ring around the contact at its largest force.
    radius = free.shape * math.sqrt(free.sphere.radius * turns.depth)
    loose = 1.0 - 2.0 * model.poisson_ratio
    bulk = half_space.storage_modulus / (3.0 * loose) if loose > 0.0 else math.inf
    try:
        ring = surface_wave.ring(radius, turns.peak_force / (math.pi * radius**2), bulk)
    except ImpactError as error:
        raise RunError(f"{impact.start:.6g} s, surface_waves of impact {impact.number}: {error}") from None
    # Height over times and radii.
    times: Vector = numpy.linspace(0.0, effect.times * impact.duration, effect.instants, dtype=numpy.float64)
    far = wave.start_radius + effect.lengths * wave.length
    radii: Vector = numpy.linspace(0.0, far, effect.places, dtype=numpy.float64)
    height = surface_wave.wave_height(wave, radii, times, effect.spread)
    return ImpactWave(
        block=block, number=impact.number, start=impact.start, amplitude=wave.amplitude, length=wave.length,
        frequency=wave.frequency, damping=wave.damping, speed=wave.speed, relative_speed=wave.relative_speed,
        start_time=wave.start_time, start_radius=wave.start_radius, ring_ratio=ring.ratio, time=times, radius=radii,
        height=height,
    )  # fmt: skip


def front_of(model: ImpactModel, effect: MicroFront, block: int, impact: FinishedImpact) -> ImpactFront:
    """Border and front of the micro-impact."""
    shear, free = _shear_speed(model, impact), impact.touch.impact
    front = micro_front.front_time(free, shear)
    times, depth, speed, _elastic, _viscous = course_of(impact, effect.instants)
    states = [(float(x), float(v)) for x, v in zip(depth, speed, strict=True)]
    fronts = [micro_front.front_speed(free, x, v, shear) for x, v in states]
    borders = [micro_front.border_speed(free, x, v, shear)[0] for x, v in states]
    return ImpactFront(
        block=block, number=impact.number, start=impact.start, shear_speed=shear, front_time=front.time,
        front_depth=front.depth, front_heat=front.heat, time=times, border_speed=numpy.array(borders),
        front_speed=numpy.array([speed for speed, _supersonic in fronts]),
        supersonic=numpy.array([supersonic for _speed, supersonic in fronts], dtype=numpy.uint8),
    )  # fmt: skip


def position_of(model: ImpactModel, effect: ThermalVolume, block: int, impact: FinishedImpact) -> ImpactPosition:
    """Depth of the contact surface and volumes."""
    half_space = position.SampleHalfSpace(
        model.half_space_share(impact.touch), model.poisson_ratio, effect.expansion, effect.heating
    )
    # Position at each instant of the course.
    times, depth, _speed, _elastic, _viscous = course_of(impact, effect.instants)
    radius = model.sphere.radius
    try:
        found = [
            None if x <= 0.0
            else position.position_variant_2(float(x), radius, half_space) if effect.variant == 2
            else position.position_variant_1(float(x), radius, half_space, effect.border_factor)
            for x in depth
        ]  # fmt: skip
    except ImpactError as error:
        raise RunError(f"{impact.start:.6g} s, thermal_volume of impact {impact.number}: {error}") from None
    # Columns of the message, 0 without contact.
    names = {
        "surface_depth": "surface_depth", "compression": "alpha", "volume": "volume",
        "compression_volume": "compression_volume", "heating_volume": "heating_volume",
    }  # fmt: skip
    columns = {
        column: numpy.array([0.0 if each is None else getattr(each, name) for each in found])
        for column, name in names.items()
    }
    return ImpactPosition(
        block=block, number=impact.number, start=impact.start, variant=effect.variant, time=times, **columns
    )


def history_of(model: ImpactModel, effect: History, block: int, impact: FinishedImpact) -> ImpactHistory:
    """Depth by the hereditary integral, with the elastic limit that the impact's own law has."""
    free = impact.touch.impact
    material, frequency = free.material, free.frequency
    # elastic limit of Lee and Radok, x^1.5 = 3 (1 - nu) F/(8 sqrt(R) G), made that of F = A x^1.5
    modulus = 0.5 * free.shape * material.storage_modulus * (1.0 - model.poisson_ratio)
    tangent = max(material.loss_tangent, 1.0e-12)
    if effect.model == "kelvin_voigt":
        law = creep.kelvin_voigt(modulus, retardation_time(frequency, tangent))
    elif effect.model == "standard_solid":
        law = creep.standard_solid_at(modulus, tangent, frequency, effect.instant_ratio)
    else:
        stiff = modulus * (1.0 + tangent**2)
        law = creep.maxwell(stiff, stiff * maxwell_time(frequency, tangent))
    times, _depth, _speed, elastic, viscous = course_of(impact, FINE)
    found = hereditary.indentation(
        law, times, numpy.maximum(elastic + viscous, 0.0), model.sphere.radius, model.poisson_ratio
    )
    return ImpactHistory(
        block=block,
        number=impact.number,
        start=impact.start,
        model=effect.model,
        time=times,
        depth=found.depth,
        valid=found.growing.astype(numpy.uint8),
    )


def gauge_readings(model: ImpactModel, number: int, *values: float) -> list[float]:
    """Readings of the gauges: speed [m/s], duration [s] and restitution [1] with noise.

    The noise follows from the scene's seed and the impact's number, so it is the same in every run.
    """
    noise = model.noise
    if noise is None:
        return list(values)
    spread = numpy.array([noise.speed, noise.duration, noise.restitution])
    drawn = numpy.random.Generator(numpy.random.Philox(key=[model.seed, number])).standard_normal(3)
    return [float(v) for v in numpy.array(values) * numpy.maximum(1.0 + spread * drawn, 1.0e-3)]


def _shear_modulus(model: ImpactModel, impact: FinishedImpact) -> float:
    """``G' = E'/(2 (1 + nu))`` of the half-space in [Pa]."""
    return impact.touch.half_space.storage_modulus / (2.0 * (1.0 + model.poisson_ratio))


def _shear_speed(model: ImpactModel, impact: FinishedImpact) -> float:
    return surface_wave.shear_speed(_shear_modulus(model, impact), model.density)


def effect_outputs(
    model: ImpactModel, block: int, impact: FinishedImpact
) -> Iterator[tuple[str, ImpactStress | ImpactWave | ImpactFront | ImpactPosition | ImpactHistory]]:
    """Topic below `impact/` and record of each effect that the scene calls for."""
    recorded = model.recorded
    if recorded.stress is not None:
        yield "stress", stress_of(model, recorded.stress, block, impact)
    if recorded.wave is not None:
        yield "wave", wave_of(model, recorded.wave, block, impact)
    if recorded.front is not None:
        yield "front", front_of(model, recorded.front, block, impact)
    if recorded.position is not None:
        yield "position", position_of(model, recorded.position, block, impact)
    if recorded.history is not None:
        yield "history", history_of(model, recorded.history, block, impact)
