"""Hard cases of the impact rig: weight, rest, endless bounces, laws without an answer, gauges, and
what a bag gives back.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy

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

__all__ = ["CASES"]

MODEL = "impact rig"
BARE = "effects.impact={normal_elastic: {}, normal_dissipative: {}}"
SPHERE = Sphere(0.02, 0.01)


def under_weight() -> Finding:
    """Largest error of k, tau, x_m and F over loss and speed, g tau/V0 up to 0.1, against scipy."""
    worst = 0.0
    for loss_tangent in (0.0, 0.05, 0.3, 1.0):
        for speed in (2.0, 0.5, 0.3):
            free = solve_impact(SPHERE, Material(8.0e6, loss_tangent), speed)
            law = ContactLaw(SPHERE.mass, 9.81, free.elastic, free.viscous, "force")
            phase = touch(law, speed)
            assert phase.turns is not None
            found = (-phase.last_speed / speed, phase.duration, phase.turns.depth, phase.turns.peak_force)
            exact = impact_under_weight(SPHERE.mass, 9.81, free.elastic, free.viscous, speed, False)
            worst = max(worst, *(abs(one / other - 1.0) for one, other in zip(found, exact, strict=True)))
    return at_most(worst, 1e-9)


def back_under_weight() -> Finding:
    """Largest error of E' and tan(beta) read back from impacts under weight."""
    worst = 0.0
    for loss_tangent in (0.02, 0.2, 1.0):
        for speed in (2.0, 0.2):
            free = solve_impact(SPHERE, Material(8.0e6, loss_tangent), speed)
            phase = touch(ContactLaw(SPHERE.mass, 9.81, free.elastic, free.viscous, "force"), speed)
            k = -phase.last_speed / speed
            found = material_of_impact(SPHERE, speed, phase.duration, k, gravity=9.81)
            worst = max(worst, abs(found.storage_modulus / 8.0e6 - 1.0), abs(found.loss_tangent / loss_tangent - 1.0))
    return at_most(worst, 1e-9)


def _forces(outputs: list[Output]) -> list[Vector]:
    return [block.normal for block in records_of(outputs, "impact/force")]


def comes_to_rest() -> Finding:
    """Force [N] on rubber after the ball has bounced out: its weight."""
    return close_to(float(_forces(outputs_of("impact_rubber_drop", 1.2, BARE))[-1][-1]), 0.02 * 9.81, 1e-9)


def no_pull() -> Finding:
    """Samples with a force below 0, or with one in flight, of a ball that bounces on a sample with
    tan(beta) = 1.
    """
    found = outputs_of("impact_rubber_drop", 0.6, BARE, "impact.sample.loss_tangent=1.0")
    wrong = 0
    for block in records_of(found, "impact/force"):
        wrong += int((block.normal < 0.0).sum() + (block.normal[block.approach <= 0.0] != 0.0).sum())
    return exactly(wrong, 0)


def _ledger(*values: str) -> Finding:
    found = outputs_of("impact_rubber_drop", 1.0, BARE, *values)
    ledger = records_of(found, "bench/energy")
    exchanged = max(max(each.kinetic, abs(each.potential), each.dissipated) for each in ledger)
    return at_most(max(abs(each.residual) for each in ledger) / exchanged, 1e-12)


def ledger_of_a_bounce() -> Finding:
    """Energy not accounted for, over what is turned over: bounces to rest."""
    return _ledger()


def ledger_of_releases() -> Finding:
    """The same where the machine takes the ball out of its second contact for the next release, and
    catches it.
    """
    return _ledger("impact.repeats=40", "impact.period=0.4365", "impact.bounces=2")


def elastic_for_long() -> Finding:
    """Loss of speed over 100 impacts without loss, relative."""
    values = ("effects.impact={normal_elastic: {}}", "impact.speeds=[0.05]", "outputs.force_rate=1000")
    found = outputs_of("impact_rubber_drop", 2.0, *values)
    speeds = numpy.concatenate([each.speed for each in records_of(found, "impact/events")])
    return at_most(float(abs(speeds / 0.05 - 1.0).max()) + (0.0 if len(speeds) > 100 else 1.0), 1e-11)


def pendulum_to_rest() -> Finding:
    """Largest change of k over the 27 impacts of a hammer on foam, 1 m/s to 1.4 nm/s; then it hangs
    at rest.
    """
    found = outputs_of("impact_pendulum", 30.0, BARE, "outputs.force_rate=100")
    k = numpy.concatenate([each.restitution for each in records_of(found, "impact/events")])
    rests = len(k) == 27 and not _forces(found)[-1].any()
    return at_most(float(abs(k / k[0] - 1.0).max()) if rests else math.nan, 1e-9)


def _refused(run: Callable[[], object], *words: str) -> int:
    try:
        run()
    except (SceneError, RunError) as error:
        return int(all(word in str(error) for word in words))
    return 0


def refusals() -> Finding:
    """Scenes without an answer that are refused by name: fold, deeper than the radius, pole of WLF,
    beyond the table, pendulum.
    """
    shift = "effects.impact={normal_elastic: {}, shift: {}}"
    name = "impact_rubber_drop"
    cases = (

        (lambda: outputs_of(name, 0.3, "effects.impact.normal_dissipative.end=gap", "impact.sample.loss_tangent=0.5"), "0.4037"),
        (lambda: outputs_of(name, 0.3, "impact.speeds=[80.0]"), "depth over radius"),
        (lambda: outputs_of(name, 0.3, shift, "impact.temperatures=[150.0]"), "pole"),
        (lambda: outputs_of(name, 0.3, shift, "impact.temperatures=[500.0]"), "beyond: keep"),
        (lambda: outputs_of(name, 0.3, "impact.machine=pendulum", "impact.speeds=[8.0]"), "longer arm"),
    )  # fmt: skip
    return exactly(sum(_refused(run, word) for run, word in cases), len(cases))


def never_lets_go() -> Finding:
    """Impacts that end, and forces that are no number, of a ball on a sample with tan(beta) = 100:
    it sinks in and stays.
    """
    found = outputs_of("impact_rubber_drop", 0.6, "impact.sample.loss_tangent=100")
    bad = sum(int((~numpy.isfinite(force)).sum()) for force in _forces(found))
    ended = len(records_of(found, "impact/events"))
    return exactly(bad + (0 if ended <= 1 else 1), 0)


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
    return at_most(max(abs(one / other - 1.0) for one, other in zip(values, exact, strict=True)), 1e-12)


CASES = (
    HardCase(MODEL, "under weight: k, τ, x_m, F against scipy", under_weight),
    HardCase(MODEL, "under weight: E′ and tan β read back", back_under_weight),
    HardCase(MODEL, "bounced out: force at rest [N]", comes_to_rest),
    HardCase(MODEL, "tan β = 1: samples that pull, or push in flight", no_pull),
    HardCase(MODEL, "bounces to rest: energy not accounted for", ledger_of_a_bounce),
    HardCase(MODEL, "lifted out of contact, caught: energy not accounted for", ledger_of_releases),
    HardCase(MODEL, "100 impacts without loss: change of the speed", elastic_for_long),
    HardCase(MODEL, "pendulum, 1 m/s to 1 nm/s and rest: change of k", pendulum_to_rest),
    HardCase(MODEL, "fold, too deep, pole, beyond table, short arm: refused by name", refusals),
    HardCase(MODEL, "tan β = 100: no number, impacts that end", never_lets_go),
    HardCase(MODEL, "steel, no loss, pendulum: τ, x_m, F", steel_without_weight),
)
