"""Hard cases of the sphere's impact (Goloshchapov): limits, folds, ends of formulas, invariants, a
steel ball.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy

from contact_sim_lab.laws.hard_cases_impact import STEEL_DENSITY, STEEL_RADIUS
from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.twins import impact as elastic_reference
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.rigs.impact.theory import micro_front, moduli, position, shift, stress
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere, hertz_modulus
from contact_sim_pkg.rigs.impact.theory.closed_form import scalings as closed_forms
from contact_sim_pkg.rigs.impact.theory.closed_form.force import elastic_force, viscous_force
from contact_sim_pkg.rigs.impact.theory.closed_form.scaled_motion import scaled_impact
from contact_sim_pkg.rigs.impact.theory.closed_form.severity import fold, severity_of_loss_tangent
from contact_sim_pkg.rigs.impact.theory.errors import FoldError, ImpactError
from contact_sim_pkg.rigs.impact.theory.geometry import SMALL_SHAPE_FACTOR, contact_radius, depth_note, shape_factor
from contact_sim_pkg.rigs.impact.theory.motion import FreeImpact, course, solve_impact
from contact_sim_pkg.rigs.impact.theory.surface_wave import ring, shear_speed
from contact_sim_pkg.rigs.impact.theory.viscoelastic import creep, hereditary

MODEL = "sphere impact"
SPHERE, RUBBER = Sphere(0.02, 0.01), Material(8.0e6, 0.2)
SHEAR_SPEED = shear_speed(RUBBER.storage_modulus / 3.0, 1100.0)


def _refused(call: Callable[[], object], kind: type[Exception] = ImpactError) -> bool:
    try:
        call()
    except kind:
        return True
    return False


def _sample(loss_tangent: float = 0.2, speed: float = 2.0, end: str = "force") -> FreeImpact:
    return solve_impact(SPHERE, Material(RUBBER.storage_modulus, loss_tangent), speed, end)


def without_indentation() -> Finding:
    """Largest force, radius and stress for x <= 0, at any speed."""
    impact = _sample()
    values, depths = [], (0.0, -0.0, -5e-324, -1.0, -1e300)
    for x in depths:
        values += [elastic_force(impact.elastic, x), contact_radius(x, SPHERE.radius)]
        values += [viscous_force(impact.viscous, x, v) for v in (-10.0, 0.0, 10.0)]
        values.append(stress.centre_stress(impact, x, 1.0, 1e-6).total)
    return exactly(float(numpy.max(numpy.abs(values))), 0.0, hard=max(depths))


def stress_at_touch() -> Finding:
    """Viscous stress over that of x_s, for depths from 1e-300 m to x_s: limited to it, and flagged
    below.
    """
    impact = _sample()
    limit = micro_front.front_time(impact, SHEAR_SPEED).depth
    at_limit = stress.centre_stress(impact, limit, 2.0, limit)
    parts = (1e-290, 1e-12, 0.5, 0.999999)
    found = [stress.centre_stress(impact, part * limit, 2.0, limit) for part in parts]
    if at_limit.limited or not all(each.limited for each in found):
        return Finding(math.nan, "flagged below x_s only", -math.inf, min(parts))
    return close_to(max(each.viscous for each in found) / at_limit.viscous, 1.0, 1e-12, hard=min(parts))


def front_at_touch() -> Finding:
    """Speed of the front over V_s at x = 0, with its flag."""
    depth = 0.0
    speed, supersonic = micro_front.front_speed(_sample(), depth, 2.0, SHEAR_SPEED)
    return exactly(speed / SHEAR_SPEED if supersonic else math.nan, 1.0, hard=depth)


def _last_pull(impact: FreeImpact) -> float:
    """Force [N] that the law would have at 1 nm with the speed of the end."""
    speed = impact.restitution * impact.speed
    return elastic_force(impact.elastic, 1e-9) + viscous_force(impact.viscous, 1e-9, -speed)


def no_tension() -> Finding:
    """Largest pull over the peak force at the end of a contact, tan(beta) 0.01 to 1, end rule
    force.
    """
    worst, pulled = 0.0, 0.0
    for loss_tangent in (0.01, 0.1, 0.3, 1.0):
        impact = _sample(loss_tangent)
        pulled = min(pulled, _last_pull(impact))
        run = course(impact, numpy.linspace(0.0, impact.duration, 400, dtype=numpy.float64))
        worst = max(worst, float(-run.force.min()) / impact.peak_force)
    return at_most(max(worst, 0.0), 1e-12, hard=pulled)


def fold_is_named() -> Finding:
    """Bound that the refusal names for tan(beta) = 0.41 with the end rule gap."""
    loss_tangent = 0.41
    try:
        severity_of_loss_tangent(loss_tangent, "gap")
    except FoldError as error:
        return close_to(error.bound, 0.4037, 5e-5, hard=loss_tangent)
    return Finding(math.nan, "FoldError", -math.inf, loss_tangent)


def at_the_fold() -> Finding:
    """Severity and restitution at the fold: 2.2354 and 0.0679; largest difference."""
    severity, bound = fold()
    steep = abs(severity_of_loss_tangent(bound * (1.0 - 1e-6), "gap") / severity - 1.0) / 1e-6
    restitution = scaled_impact(severity, "gap").restitution
    return at_most(max(abs(severity - 2.2354), abs(restitution - 0.0679)), 6e-5, hard=steep)


def no_plastic_impact() -> Finding:
    """Eq 66 refuses tan(beta) from pi/3 on and warns above 0.9 of it: refusals and warnings of six
    values.
    """
    limit = math.pi / 3.0
    tangents = (0.999 * limit, limit, 1.2, 1.5708)
    refusals = [_refused(lambda t=t: closed_forms.closed_restitution(t)) for t in tangents]  # type: ignore[misc]
    warnings = [closed_forms.restitution_note(part * limit) is not None for part in (0.89, 0.91)]
    return exactly(
        float(refusals == [False, True, True, True] and warnings == [False, True]), 1.0, hard=max(tangents) / limit
    )


def complex_root() -> Finding:
    """Eqs 56-58 refuse what has no real root, printed above 1/3 and corrected above 0.43701, and
    nothing below.
    """
    expected = {"printed": 1.0 / 3.0, "corrected": 0.43701}
    beside = 1e-5
    found = [
        _refused(lambda t=t, form=form: closed_forms.damping_ratio(t, form)) is (sign > 0.0)  # type: ignore[misc]
        for form, limit in expected.items()
        for sign, t in ((-1.0, limit - beside), (1.0, limit + beside))
    ]
    return exactly(float(all(found)), 1.0, hard=beside)


def no_loss_limit() -> Finding:
    """Eq 71 at k = 1 - 1e-15 over its limit 2 (15/16)^(4/5)..., in units of (m/(k_p E' sqrt
    R))^(2/5) V0^(-1/5).
    """
    unit = (SPHERE.mass / (SMALL_SHAPE_FACTOR * 8e6 * math.sqrt(SPHERE.radius))) ** 0.4
    k = 1.0 - 1e-15
    found = closed_forms.closed_duration(SPHERE, 8e6, 1.0, k)
    return close_to(found / unit, 2.0 * (15.0 / 16.0) ** 0.4, 1e-13, hard=1.0 - k)


def ring_at_bulk_modulus() -> Finding:
    """The ring refuses p >= K' and is finite just below."""
    bulk, below = 1e9, 0.999999e9
    refusals = [_refused(lambda p=p: ring(1e-3, p, bulk)) for p in (bulk, 2.0 * bulk)]  # type: ignore[misc]
    return exactly(float(all(refusals) and math.isfinite(ring(1e-3, below, bulk).width)), 1.0, hard=1.0 - below / bulk)


def retarded_outside() -> Finding:
    """Retarded stress before touch, at it, and after the end: 0 with a flag."""
    impact = _sample()
    times = (-1.0, 0.0, 1.01 * impact.duration, 1e9)
    found = [stress.retarded_viscous_stress(impact, t, 1e-6) for t in times]
    return exactly(
        float(all(each == (0.0, False) for each in found)), 1.0, hard=sum(0.0 < t <= impact.duration for t in times)
    )


def volumes_outside() -> Finding:
    """Both variants refuse alpha_h above 1."""
    half_space = position.SampleHalfSpace(1.0, -0.6)
    alpha = 16.0 / (5.0 * math.pi * shape_factor(9e-3, 0.01)) * math.sqrt(0.9) * (1.0 - 2.0 * half_space.poisson_ratio)
    calls = (
        lambda: position.position_variant_1(9e-3, 0.01, half_space),
        lambda: position.position_variant_2(9e-3, 0.01, half_space),
    )
    return exactly(float(all(map(_refused, calls))), 1.0, hard=alpha)


def printed_numbers() -> Finding:
    """alpha_h of both variants at nu 0.4, D1 0.8, x/R 0.1: 0.04180 and 0.0374; largest
    difference.
    """
    half_space = position.SampleHalfSpace(0.8, 0.4)
    first = position.position_variant_1(1e-3, 0.01, half_space).alpha
    second = position.position_variant_2(1e-3, 0.01, half_space).alpha
    return at_most(max(abs(first - 0.04180), abs(second - 0.03739)), 6e-6, hard=abs(first - second))


def wlf_pole() -> Finding:
    """WLF refuses Tg - 51.6 K and below, notes what is outside Tg to Tg + 100 K."""
    law = shift.Wlf(223.0)
    cold = (171.4, 100.0)
    refusals = [_refused(lambda t=t: shift.log_shift(law, t)) for t in cold]  # type: ignore[misc]
    notes = [shift.shift_note(law, t) is not None for t in (222.0, 250.0, 324.0)]
    return exactly(
        float(all(refusals) and notes == [True, False, True]), 1.0, hard=max(cold) - (law.glass_temperature - law.c2)
    )


def shrinking_contact() -> Finding:
    """Samples of a load and unload whose flag is wrong: the hereditary integral holds up to the
    largest depth only.
    """
    times = numpy.linspace(0.0, 0.02, 401, dtype=numpy.float64)
    found = hereditary.indentation(
        creep.standard_solid(5e6, 2e6, 3e-3), times, 10.0 * numpy.sin(math.pi * times / 0.02), 0.01, 0.5
    )
    expected = numpy.arange(401) <= int(numpy.argmax(found.depth))
    return exactly(float(numpy.sum(found.growing != expected)), 0.0, hard=(numpy.diff(found.depth) < 0.0).sum())


def deeper_than_radius() -> Finding:
    """x > R is refused, x/R above 0.3 noted."""
    depth = 0.0101
    refused = _refused(lambda: shape_factor(depth, 0.01)) and _refused(lambda: _sample(speed=80.0))
    noted = depth_note(0.0031, 0.01) is not None and depth_note(0.003, 0.01) is None
    return exactly(float(refused and noted), 1.0, hard=depth / 0.01)


def incompressible() -> Finding:
    """nu = 1/2: h_x over x1 in both variants, and E of G and an endless K over 3 G; a bulk modulus
    is refused.
    """
    half_space = position.SampleHalfSpace(0.8, 0.5)
    ratios = [
        position.position_variant_1(1e-3, 0.01, half_space).surface_depth / 8e-4,
        position.position_variant_2(1e-3, 0.01, half_space).surface_depth / 8e-4,
        moduli.young_modulus(1e6, math.inf) / 3e6,
    ]
    if not _refused(lambda: moduli.bulk_modulus(3e6, 0.5)):
        return Finding(math.nan, "a refusal", -math.inf, 1.0 - 2.0 * half_space.poisson_ratio)
    return at_most(max(abs(ratio - 1.0) for ratio in ratios), 1e-15, hard=1.0 - 2.0 * half_space.poisson_ratio)


def grazing() -> Finding:
    """Restitution at 1e-12 m/s over that at 1 m/s: the viscous sphere does not get stickier when it
    is slow.
    """
    slow = _sample(speed=1e-12)
    return close_to(slow.restitution / _sample(speed=1.0).restitution, 1.0, 1e-12, hard=slow.speed)


def invariants() -> Finding:
    """k of V0, x_m ~ V0^(4/5), tau ~ V0^(-1/5), tau of E' doubled 2^(-2/5): largest relative
    deviation.
    """
    worst, speeds = 0.0, (1e-3, 0.1, 3.0)
    for loss_tangent in (0.01, 0.2, 1.0):
        one, stiff = _sample(loss_tangent, 1.0), solve_impact(SPHERE, Material(1.6e7, loss_tangent), 1.0)
        worst = max(worst, abs(stiff.duration / one.duration * 2.0**0.4 - 1.0))
        for speed in speeds:
            other = _sample(loss_tangent, speed)
            worst = max(worst, abs(other.restitution / one.restitution - 1.0))
            worst = max(worst, abs(other.depth / one.depth / speed**0.8 - 1.0))
            worst = max(worst, abs(other.duration / one.duration * speed**0.2 - 1.0))
    return at_most(worst, 1e-9, hard=max(speeds) / min(speeds))


def steel_sphere() -> tuple[FreeImpact, tuple[float, float, float]]:
    """Steel ball at 1 m/s as a case of the impact, and duration [s], depth [m], force [N] in closed
    form.
    """
    mass = STEEL_DENSITY * 4.0 / 3.0 * math.pi * STEEL_RADIUS**3
    coefficient = elastic_reference.sphere_coefficient(STEEL_RADIUS, 210e9, 0.3)
    modulus = hertz_modulus(0.75 * coefficient / math.sqrt(STEEL_RADIUS), SMALL_SHAPE_FACTOR)
    expected = elastic_reference.elastic_impact(mass, 1.0, coefficient, 1.5)
    return solve_impact(Sphere(mass, STEEL_RADIUS), Material(modulus, 0.0), 1.0), expected


def steel() -> Finding:
    """Largest relative error of duration, depth and peak force of the solved impact."""
    found, expected = steel_sphere()
    errors = (found.duration / expected[0], found.depth / expected[1], found.peak_force / expected[2])
    return at_most(max(abs(ratio - 1.0) for ratio in errors), 1e-8, hard=found.peak_force / (9.81 * found.sphere.mass))


def steel_steps() -> Finding:
    """Steps of the solved impact."""
    loss_tangent = 0.0
    return at_most(float(scaled_impact(loss_tangent, "force").steps), 100.0, hard=loss_tangent)


def rig_with_a_tick(tolerance: float = 5e-9, gap: float = 3.3e-4) -> tuple[float, int]:
    """The same ball in the rig with outer steps of 1 ms, started at the ``gap`` [m].

    Largest relative error [1] of duration, depth and force at the relative ``tolerance``; number of
    steps, rejected ones included.
    """
    found, (lasts, depth, force) = steel_sphere()
    rig = PointContact(found.sphere.mass, 0.0, 0.0, 0.0, *found.normal_law)
    scale = numpy.array([depth, 1.0]) * tolerance
    whole = integrate(rig, numpy.array([gap, -1.0]), scale, numpy.array([0.0, 1e-3]))
    half = integrate(rig, numpy.array([gap, -1.0]), scale, numpy.array([0.0, gap + 0.5 * lasts]))
    z, v = whole.states[-1]
    deepest = -float(half.states[-1, 0])
    peak = elastic_force(found.elastic, deepest)
    errors = (((1e-3 - z / v) - gap) / lasts, deepest / depth, peak / force)
    return max(abs(float(ratio) - 1.0) for ratio in errors), whole.accepted + whole.rejected


def steel_in_the_rig() -> Finding:
    """Largest relative error of the three in the rig's own integrator at 5e-9."""
    return at_most(rig_with_a_tick()[0], 1e-8, hard=1e-3 / steel_sphere()[0].duration)


def steel_steps_in_the_rig() -> Finding:
    """Its steps over the tick of 1 ms."""
    return at_most(float(rig_with_a_tick()[1]), 100.0, hard=1e-3 / steel_sphere()[0].duration)


RUBBERS, PHASES = (0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 1.0), 20


def rubber_error(loss_tangent: float, tolerance: float, phase: int) -> float:
    """Larger relative error [1] of restitution and contact time of rubber in the rig, from one of
    20 starts.
    """
    found = _sample(loss_tangent)
    rig = PointContact(SPHERE.mass, 0.0, 0.0, 0.0, *found.normal_law)
    scale = numpy.array([found.depth, found.speed]) * tolerance
    gap, end = 2e-3 * (phase + 0.37) / PHASES, 20e-3
    z, v = integrate(rig, numpy.array([gap, -found.speed]), scale, numpy.array([0.0, end])).states[-1]
    lasts = end - gap / found.speed - float(z / v) - found.viscous / found.elastic  # parts at x = B v/A
    return max(abs(float(v) / found.speed - found.restitution), abs(lasts / found.duration - 1.0))


@functools.lru_cache(maxsize=1)
def rubber_errors() -> dict[float, float]:
    """Worst error [1] by requested tolerance, 1e-3 to 1e-11, over tan(beta) 0 to 1 and 20 approach
    phases.
    """
    tolerances = [10.0**-power for power in range(3, 12)]
    return {t: max(rubber_error(b, t, phase) for b in RUBBERS for phase in range(PHASES)) for t in tolerances}


def _tolerances() -> float:
    return max(rubber_errors()) / min(rubber_errors())


def rubber_in_the_rig() -> Finding:
    """Largest error over requested tolerance."""
    return at_most(max(error / tolerance for tolerance, error in rubber_errors().items()), 10.0, hard=_tolerances())


def rubber_slope() -> Finding:
    """Slope of log error over log tolerance; at least 0.8."""
    logs = numpy.log10(numpy.array(list(rubber_errors().items())))
    slope = float(numpy.polyfit(logs[:, 0], logs[:, 1], 1)[0])
    return Finding(slope, "≥ 0.8", slope - 0.8, _tolerances())


CASES = (
    HardCase(MODEL, "x ≤ 0: largest force, radius, stress", without_indentation,
        guard.at_most("largest indentation [m]", 0.0)),
    HardCase(MODEL, "x → 0: viscous stress over that at x_s", stress_at_touch,
        guard.at_most("least depth over that of the limit", 1e-290)),
    HardCase(MODEL, "t → 0: front speed over V_s, flagged", front_at_touch, guard.zero("depth [m]")),
    HardCase(MODEL, "end force: largest pull over peak force", no_tension,
        guard.below("force at 1 nm without the end rule [N]", 0.0)),
    HardCase(MODEL, "end gap, tan β = 0.41: bound that is named", fold_is_named, guard.above("tan β", 0.4037)),
    HardCase(MODEL, "fold: ζ and k, largest difference", at_the_fold,
        guard.at_least("change of ζ over that of tan β, just below", 100.0)),
    HardCase(MODEL, "eq 66 at π/3: refused, warned before", no_plastic_impact,
        guard.at_least("largest tan β over its limit", 1.0)),
    HardCase(MODEL, "eqs 56-58 without a real root: refused", complex_root,
        guard.at_most("distance of tan β from its limit", 1e-5)),
    HardCase(MODEL, "eq 71, k → 1: limit", no_loss_limit, guard.at_most("1 - k", 1.1e-15)),
    HardCase(MODEL, "ring, p → K': refused", ring_at_bulk_modulus,
        guard.at_most("distance of p from K', over it", 1.1e-6)),
    HardCase(MODEL, "retarded stress outside 0 < t ≤ τ: 0, flagged", retarded_outside,
        guard.zero("times within the contact")),
    HardCase(MODEL, "volumes, α_h > 1: refused", volumes_outside, guard.above("α_h of variant 1, by its formula", 1.0)),
    HardCase(MODEL, "α_h of both variants, printed numbers corrected", printed_numbers,
        guard.at_least("difference of the variants", 4e-3)),
    HardCase(MODEL, "WLF at its pole: refused, noted around", wlf_pole,
        guard.at_most("warmest above the pole [K]", 1e-9)),
    HardCase(MODEL, "hereditary integral, shrinking contact: wrong flags", shrinking_contact,
        guard.at_least("samples of a contact that shrinks", 100)),
    HardCase(MODEL, "x > R refused, x > 0.3 R noted", deeper_than_radius, guard.above("depth over radius", 1.0)),
    HardCase(MODEL, "ν = 1/2: largest deviation", incompressible, guard.zero("1 - 2 ν")),
    HardCase(MODEL, "V0 → 0: restitution over that at 1 m/s", grazing, guard.at_most("speed [m/s]", 1e-12)),
    HardCase(MODEL, "powers of V0 and E': largest deviation", invariants, guard.scales("speeds", 3000.0)),
    HardCase(MODEL, "steel, 1 m/s: error of T, depth, force", steel, guard.scales("force and weight", 1e3)),
    HardCase(MODEL, "steel, 1 m/s: steps", steel_steps, guard.zero("tan β")),
    HardCase(MODEL, "steel in the rig, tick 1 ms: error of T, depth, force", steel_in_the_rig,
        guard.scales("tick and contact", 10.0)),
    HardCase(MODEL, "steel in the rig, tick 1 ms: steps", steel_steps_in_the_rig,
        guard.scales("tick and contact", 10.0)),
    HardCase(MODEL, "rubber in the rig, 20 phases: error of k, T over tolerance", rubber_in_the_rig,
        guard.scales("tolerances", 9e7)),
    HardCase(MODEL, "rubber in the rig: slope of log error over log tolerance", rubber_slope,
        guard.scales("tolerances", 9e7)),
)  # fmt: skip
