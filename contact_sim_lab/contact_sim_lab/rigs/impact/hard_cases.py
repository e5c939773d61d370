"""Hard cases of the impact rig: weight, rest, endless bounces, laws without an answer, gauges, and
what a bag gives back.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.rigs.impact.twins.weighted_impact import impact_under_weight
from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.contact import ContactLaw, touch
from contact_sim_pkg.rigs.impact.theory.inverse import material_of_impact
from contact_sim_pkg.rigs.impact.theory.motion import solve_impact
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value

__all__ = ["CASES"]

MODEL = "impact rig"
BARE = "effects.impact={normal_elastic: {}, normal_dissipative: {}}"
SPHERE = Sphere(0.02, 0.01)


def under_weight() -> Finding:
    """Largest error of k, tau, x_m and F over loss and speed, g tau/V0 up to 0.1, against scipy."""
    worst, weight = 0.0, 0.0
    for loss_tangent in (0.0, 0.05, 0.3, 1.0):
        for speed in (2.0, 0.5, 0.3):
            free = solve_impact(SPHERE, Material(8.0e6, loss_tangent), speed)
            law = ContactLaw(SPHERE.mass, 9.81, free.elastic, free.viscous, "force")
            phase = touch(law, speed)
            assert phase.turns is not None
            weight = max(weight, 9.81 * phase.duration / speed)
            found = (-phase.last_speed / speed, phase.duration, phase.turns.depth, phase.turns.peak_force)
            exact = impact_under_weight(SPHERE.mass, 9.81, free.elastic, free.viscous, speed, False)
            worst = max(worst, *(abs(one / other - 1.0) for one, other in zip(found, exact, strict=True)))
    return at_most(worst, 1e-9, hard=weight)


def back_under_weight() -> Finding:
    """Largest error of E' and tan(beta) read back from impacts under weight."""
    worst, weight = 0.0, 0.0
    for loss_tangent in (0.02, 0.2, 1.0):
        for speed in (2.0, 0.2):
            free = solve_impact(SPHERE, Material(8.0e6, loss_tangent), speed)
            phase = touch(ContactLaw(SPHERE.mass, 9.81, free.elastic, free.viscous, "force"), speed)
            weight = max(weight, 9.81 * phase.duration / speed)
            k = -phase.last_speed / speed
            found = material_of_impact(SPHERE, speed, phase.duration, k, gravity=9.81)
            worst = max(worst, abs(found.storage_modulus / 8.0e6 - 1.0), abs(found.loss_tangent / loss_tangent - 1.0))
    return at_most(worst, 1e-9, hard=weight)


def _forces(outputs: list[Output]) -> list[Vector]:
    return [block.normal for block in records_of(outputs, "impact/force")]


def _impacts(outputs: list[Output]) -> int:
    return sum(len(each.number) for each in records_of(outputs, "impact/events"))


def comes_to_rest() -> Finding:
    """Force [N] on rubber after the ball has bounced out: its weight."""
    found = outputs_of("impact_rubber_drop", 1.2, BARE)
    return close_to(float(_forces(found)[-1][-1]), 0.02 * 9.81, 1e-9, hard=_impacts(found))


def no_pull() -> Finding:
    """Samples with a force below 0, or with one in flight, of a ball that bounces on a sample with
    tan(beta) = 1.
    """
    found = outputs_of("impact_rubber_drop", 0.6, BARE, "impact.sample.loss_tangent=1.0")
    wrong, flying = 0, 0
    for block in records_of(found, "impact/force"):
        flying += int((block.approach <= 0.0).sum())
        wrong += int((block.normal < 0.0).sum() + (block.normal[block.approach <= 0.0] != 0.0).sum())
    return exactly(wrong, 0, hard=flying)


def _ledger(*values: str) -> tuple[float, list[Output]]:
    found = outputs_of("impact_rubber_drop", 1.0, BARE, *values)
    ledger = records_of(found, "bench/energy")
    exchanged = max(max(each.kinetic, abs(each.potential), each.dissipated) for each in ledger)
    return max(abs(each.residual) for each in ledger) / exchanged, found


def ledger_of_a_bounce() -> Finding:
    """Energy not accounted for, over what is turned over: bounces to rest."""
    residual, found = _ledger()
    return at_most(residual, 1e-12, hard=_impacts(found))


def ledger_of_releases() -> Finding:
    """The same where the machine takes the ball out of its second contact for the next release, and
    catches it.
    """
    residual, found = _ledger("impact.repeats=40", "impact.period=0.4365", "impact.bounces=2")
    pressed = numpy.concatenate(_forces(found)) > 0.0
    return at_most(residual, 1e-12, hard=int((pressed[1:] > pressed[:-1]).sum()) - _impacts(found))


def elastic_for_long() -> Finding:
    """Loss of speed over 100 impacts without loss, relative."""
    values = ("effects.impact={normal_elastic: {}}", "impact.speeds=[0.05]", "outputs.force_rate=1000")
    found = outputs_of("impact_rubber_drop", 2.0, *values)
    speeds = numpy.concatenate([each.speed for each in records_of(found, "impact/events")])
    return at_most(float(abs(speeds / 0.05 - 1.0).max()), 1e-11, hard=len(speeds))


def pendulum_to_rest() -> Finding:
    """Largest change of k over the 27 impacts of a hammer on foam, 1 m/s to 1.4 nm/s; then it hangs
    at rest.
    """
    found = outputs_of("impact_pendulum", 30.0, BARE, "outputs.force_rate=100")
    k, speeds = (
        numpy.concatenate([getattr(each, column) for each in records_of(found, "impact/events")])
        for column in ("restitution", "speed")
    )
    rests = len(k) == 27 and not _forces(found)[-1].any()
    return at_most(float(abs(k / k[0] - 1.0).max()) if rests else math.nan, 1e-9, hard=speeds.max() / speeds.min())


def _refused(values: tuple[str, ...], word: str) -> bool:
    try:
        outputs_of("impact_rubber_drop", 0.3, *values)
    except (SceneError, RunError) as error:
        return word in str(error)
    return False


def _taken_alone(values: tuple[str, ...]) -> bool:
    """Whether the scene takes each value alone: only together, or by the model, they have no answer."""
    try:
        for value in values:
            load_scene("impact_rubber_drop", [set_value(value)])
    except SceneError:
        return False
    return True


def refusals() -> Finding:
    """Scenes without an answer that are refused by name: fold, deeper than the radius, pole of WLF,
    beyond the table, pendulum.
    """
    shift = "effects.impact={normal_elastic: {}, shift: {}}"
    scenes = {
        ("effects.impact.normal_dissipative.end=gap", "impact.sample.loss_tangent=0.5"): "0.4037",
        ("impact.speeds=[80.0]",): "depth over radius",
        (shift, "impact.temperatures=[150.0]"): "pole",
        (shift, "impact.temperatures=[500.0]"): "beyond: keep",
        ("impact.machine=pendulum", "impact.speeds=[8.0]"): "longer arm",
    }
    found = sum(_refused(values, word) for values, word in scenes.items())
    return exactly(found, len(scenes), hard=sum(map(_taken_alone, scenes)))


def never_lets_go() -> Finding:
    """Impacts that end, and forces that are no number, of a ball on a sample with tan(beta) = 100:
    it sinks in and stays.
    """
    found = outputs_of("impact_rubber_drop", 0.6, "impact.sample.loss_tangent=100")
    bad = sum(int((~numpy.isfinite(force)).sum()) for force in _forces(found))
    ended = len(records_of(found, "impact/events"))
    return exactly(bad + (0 if ended <= 1 else 1), 0, hard=records_of(found, "impact/force")[-1].approach[-1])


def steel_without_weight() -> Finding:
    """Steel on steel at 1 m/s by the pendulum: largest error of tau, x_m and F against the closed
    form with no loss.
    """
    loss = ("impact.sample.loss_tangent=0", "impact.sample.body_loss_tangent=0", "impact.machine=pendulum")
    found = outputs_of("impact_steel", 0.6, BARE, *loss, "outputs.force_rate=1000")
    events = records_of(found, "impact/events")[0]
    mass, elastic = 0.0326, 4.0 / 3.0 * math.sqrt(2.0) * 1.05e11 * math.sqrt(0.01)
    depth = (1.25 * mass / elastic) ** 0.4
    duration = 0.8 * math.sqrt(math.pi) * math.gamma(0.4) / math.gamma(0.9) * depth
    exact = (duration, depth, elastic * depth**1.5)
    values = (events.duration[0], events.depth[0], events.peak_force[0])
    return at_most(
        max(abs(one / other - 1.0) for one, other in zip(values, exact, strict=True)), 1e-12, hard=1e-3 / duration
    )


CASES = (
    HardCase(MODEL, "under weight: k, τ, x_m, F against scipy", under_weight,
        guard.at_least("weight times duration over momentum, largest", 0.05)),
    HardCase(MODEL, "under weight: E′ and tan β read back", back_under_weight,
        guard.at_least("weight times duration over momentum, largest", 0.05)),
    HardCase(MODEL, "bounced out: force at rest [N]", comes_to_rest, guard.impacts(5)),
    HardCase(MODEL, "tan β = 1: samples that pull, or push in flight", no_pull, guard.contact_lost(100)),
    HardCase(MODEL, "bounces to rest: energy not accounted for", ledger_of_a_bounce, guard.impacts(5)),
    HardCase(MODEL, "lifted out of contact, caught: energy not accounted for", ledger_of_releases,
        guard.at_least("contacts that do not end by themselves", 1)),
    HardCase(MODEL, "100 impacts without loss: change of the speed", elastic_for_long, guard.impacts(101)),
    HardCase(MODEL, "pendulum, 1 m/s to 1 nm/s and rest: change of k", pendulum_to_rest,
        guard.scales("speeds of the impacts", 1e8)),
    HardCase(MODEL, "fold, too deep, pole, beyond table, short arm: refused by name", refusals,
        guard.at_least("scenes that take each of their values alone", 5)),
    HardCase(MODEL, "tan β = 100: no number, impacts that end", never_lets_go,
        guard.above("approach at the end [m]", 0.0)),
    HardCase(MODEL, "steel, no loss, pendulum: τ, x_m, F", steel_without_weight,
        guard.scales("samples and contact", 10.0)),
)  # fmt: skip
