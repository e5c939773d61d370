"""Every public function of the impact's motion, contact, flight and inverse: checks over its domain, refusals outside."""

from __future__ import annotations

import functools
import math

import numpy
import pytest
import scipy.integrate
import scipy.special
from hypothesis import strategies as st
from tests.properties import Table, positive
from tests.rigs.impact.theory.solved_impacts import END, IMPACT, LOSS, MATERIAL, SPEED, SPHERE

from contact_sim_pkg.rigs.impact.theory import contact, inverse, motion, table
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.closed_form import flight, scaled_motion, severity

MODULES = (
    "contact",
    "closed_form.flight",
    "inverse",
    "motion",
    "closed_form.scaled_motion",
    "closed_form.severity",
    "table",
)
TABLE = Table()
holds = TABLE.holds
close = pytest.approx


@functools.lru_cache(maxsize=256)
def followed(zeta: float, end: str, weight: float = 0.0):
    """The impact in its own units by scipy, in x and t: duration, restitution, depth, peak force, solution."""

    def slope(_t, y):
        x = max(y[0], 0.0)
        return [y[1], weight - x**1.5 - zeta * math.sqrt(x) * y[1]]

    def over(_t, y):
        x = max(y[0], 0.0)
        return y[0] if end == "gap" or zeta == 0.0 else x + zeta * y[1] + (0.0 if x > 0.0 else -1.0) * (y[0] <= 0.0)

    over.terminal, over.direction = True, -1.0
    first = 1e-9  # behind the touch, whose root has no slope
    start = [first, 1.0 - 2.0 / 3.0 * zeta * first**1.5]
    done = scipy.integrate.solve_ivp(
        slope, (first, 60.0), start, "DOP853", events=over, rtol=1e-11, atol=1e-13, max_step=0.02
    )
    x, v = numpy.maximum(done.y[0], 0.0), done.y[1]
    force = x**1.5 + zeta * numpy.sqrt(x) * v
    return float(done.t[-1]), float(-v[-1]), float(x.max()), float(force.max())


# Scaled motion and severity


@holds(scaled_motion.scaled_impact, severity=st.just(0.0) | positive(1e-3, 3.0), end=END,
       weight=st.just(0.0) | st.floats(0.0, 0.05), outside=({"severity": 1000.1}, {"weight": -1e-9}), examples=10)  # fmt: skip
def _(found, severity, end, weight):
    duration, restitution, depth, peak = followed(severity, end, weight)
    assert found.duration == close(duration, rel=1e-5)
    assert found.restitution == close(restitution, abs=1e-6)
    assert (found.depth, found.peak_force) == close((depth, peak), rel=3e-4)
    assert found.restitution <= 1.0 + 1e-13


@holds(scaled_motion.scaled_course, severity=st.just(0.0) | positive(1e-3, 3.0), times=st.just(numpy.linspace(0.0, 1.5, 7)),
       outside=({"times": [1.0, 0.5]}, {"severity": -1.0}, {"times": [0.0, 50.0]}))  # fmt: skip
def _(found, severity, times):
    depth, speed = found
    assert (depth[0], speed[0]) == (0.0, 1.0)
    step = 1e-4
    for t, x, v in zip(times[1:], depth[1:], speed[1:], strict=True):
        (_, at, _), (before, _, after) = scaled_motion.scaled_course(severity, [t - step, t, t + step])
        assert at == x
        assert (after - before) / (2.0 * step) == close(-(x**1.5) - severity * math.sqrt(x) * v, abs=1e-6)
    heat, _ = scipy.integrate.quad(
        lambda t: severity * math.prod([math.sqrt(p[0]) * q[0] ** 2 for p, q in [scaled_motion.scaled_course(severity, [t])]]),
        0.0, 1.5, epsabs=1e-8,
    )  # fmt: skip
    assert 0.5 * speed[-1] ** 2 + 0.4 * depth[-1] ** 2.5 + heat == close(0.5, abs=1e-7)


@holds(severity.fold)
def _(found):
    """A maximum of the loss tangent over the severity."""
    zeta, most = found
    around = [severity.loss_tangent_of_severity(zeta + d, "gap") for d in (-0.01, 0.0, 0.01)]
    assert max(around) == around[1] == most
    assert most == close(math.pi * zeta / 3.0 / followed(zeta, "gap")[0], rel=1e-6)


@holds(severity.loss_tangent_of_severity, severity=st.just(0.0) | positive(1e-3, 2.2), end=END, outside=({"severity": -1e-9},),
       examples=8)  # fmt: skip
def _(found, severity, end):
    """The frequency of the viscous force is pi over the duration, `zeta = 3 tan(beta) T/pi`."""
    assert 3.0 * found * followed(severity, end)[0] / math.pi == close(severity, rel=1e-5)


@holds(severity.severity_of_loss_tangent, loss_tangent=LOSS, end=END,
       outside=({"loss_tangent": 100.1, "end": "force"}, {"loss_tangent": 0.404, "end": "gap"}))  # fmt: skip
def _(found, loss_tangent, end):
    assert severity.loss_tangent_of_severity(found, end) == close(loss_tangent, rel=1e-12)
    more = severity.severity_of_loss_tangent(loss_tangent * 1.01, end)
    assert more >= found


@holds(severity.loss_tangent_of_restitution, restitution=st.floats(0.07, 1.0), end=END,
       outside=({"restitution": 1.0 + 1e-12}, {"restitution": 6e-4, "end": "force"},
                {"restitution": 0.067, "end": "gap"}))  # fmt: skip
def _(found, restitution, end):
    zeta = severity.severity_of_loss_tangent(found, end)
    assert scaled_motion.scaled_impact(zeta, end).restitution == close(restitution, rel=1e-10)
    assert severity.loss_tangent_of_restitution(0.999 * restitution + 0.001 * 0.069, end) >= found


@holds(
    table.look_up, loss_tangent=st.floats(0.0, 0.3), end=END, outside=({"loss_tangent": 2.01}, {"loss_tangent": -1e-9})
)
def _(found, loss_tangent, end):
    exact = scaled_motion.scaled_impact(severity.severity_of_loss_tangent(loss_tangent, end), end)
    assert found == close((exact.restitution, exact.duration, exact.depth, exact.peak_force), rel=1e-10)


# The free impact


@holds(motion.solve_impact, sphere=SPHERE, material=MATERIAL, speed=SPEED, end=END, shape=st.sampled_from(["small", "iterate"]),
       outside=({"material": Material(1e7, 0.41), "end": "gap"}, {"speed": 1e6}), examples=8)  # fmt: skip
def _(found, sphere, material, speed, end, shape):
    """The law of eqs 8 and 9 with w = pi/tau of the result, followed by scipy in units of its own."""
    squared = 2.0 if shape == "small" else 2.0 - found.depth / sphere.radius
    assert found.shape == close(math.sqrt(squared), rel=1e-14)
    elastic = 4 / 3 * math.sqrt(squared * sphere.radius) * material.storage_modulus
    viscous = 3.0 * elastic * material.loss_tangent * found.duration / math.pi
    assert (found.elastic, found.viscous) == close((elastic, viscous), rel=1e-12)
    length = (sphere.mass * speed**2 / elastic) ** 0.4
    zeta = viscous * length**1.5 / (sphere.mass * speed)
    duration, restitution, depth, peak = followed(zeta, end)
    assert found.duration == close(duration * length / speed, rel=1e-5)
    assert found.restitution == close(restitution, abs=2e-6)
    assert found.depth == close(depth * length, rel=3e-4)
    assert found.peak_force == close(peak * sphere.mass * speed**2 / length, rel=3e-4)
    assert found.restitution <= 1.0 + 1e-13
    assert 0.0 < found.peak_time <= found.compression_time + 1e-15 < found.duration


@holds(
    motion.course, impact=IMPACT, times=st.just(numpy.array([0.0])), outside=({"times": [0.0, 1e3]}, {"times": [-1e-9]})
)
def _(found, impact, times):
    """Newton's law by differences; the viscous force is the only loss."""
    times = numpy.linspace(0.0, impact.duration, 2001)
    found = motion.course(impact, times)
    slope = numpy.gradient(found.speed, times)
    size = impact.peak_force / impact.sphere.mass
    assert slope[20:-20] == close(-found.force[20:-20] / impact.sphere.mass, abs=2e-4 * size)
    lost = scipy.integrate.simpson(found.viscous_force * found.speed, x=times)
    blow = 0.5 * impact.sphere.mass * impact.speed**2
    held = 0.4 * impact.elastic * found.depth[-1] ** 2.5
    assert blow * (1.0 - impact.restitution**2) == close(lost + held, abs=1e-4 * blow)
    assert found.elastic_force == close(impact.elastic * found.depth**1.5)
    assert found.depth.max() == close(impact.depth, rel=1e-5)


# A contact under weight

LAW = st.builds(contact.ContactLaw, positive(0.01, 10.0), st.just(0.0) | st.floats(0.1, 20.0), positive(1e5, 1e8),
                st.just(0.0) | positive(1.0, 1e4), END)  # fmt: skip


def energy(law, depth, speed):
    return 0.5 * law.mass * speed**2 + 0.4 * law.elastic * max(depth, 0.0) ** 2.5 - law.mass * law.gravity * depth


def check_phase(found, law):
    before, after = energy(law, found.depth, found.speed), energy(law, found.last_depth, found.last_speed)
    assert found.heat >= -1e-12 * abs(before)
    size = 0.5 * law.mass * max(found.speed, found.last_speed, key=abs) ** 2 + abs(before)
    assert before == close(after + found.heat, abs=1e-9 * size)
    assert found.duration > 0.0


@holds(contact.touch, law=LAW, speed=SPEED, outside=({"speed": 0.0},))
def _(found, law, speed):
    check_phase(found, law)
    assert (found.depth, found.speed, found.kind) == (0.0, speed, contact.LOADED)
    if law.gravity == 0.0:
        length = (law.mass * speed**2 / law.elastic) ** 0.4
        zeta = law.viscous * length**1.5 / (law.mass * speed)
        if zeta < 3.0:
            duration, restitution, depth, _ = followed(round(zeta, 12), law.end)
            assert found.turns.depth == close(depth * length, rel=1e-4)
            assert (found.duration, -found.last_speed) == close(
                (duration * length / speed, restitution * speed), rel=1e-4, abs=1e-5 * speed
            )


PARTED = contact.touch(contact.ContactLaw(1.0, 0.0, 1e6, 0.0, "force"), 1.0)


@holds(contact.next_phase, before=st.builds(contact.touch, LAW, SPEED).filter(lambda s: s.next_kind != contact.PARTED),
       outside=({"before": PARTED},))  # fmt: skip
def _(found, before):
    check_phase(found, before.law)
    assert (found.depth, found.speed) == (before.last_depth, before.last_speed)
    if found.kind == contact.RELEASED:  # free of force
        t, g = found.duration, before.law.gravity
        assert found.last_speed == close(found.speed + g * t)
        assert found.last_depth == close(found.depth + found.speed * t + 0.5 * g * t * t, abs=1e-12 * found.depth)


@holds(contact.sample, phase=st.builds(contact.touch, LAW, SPEED), times=st.just(numpy.array([0.0])),
       outside=({"times": [0.1, 0.05]},))  # fmt: skip
def _(found, phase, times):
    law, end = phase.law, min(phase.duration, 10.0 * phase.turns.compression_time)
    depth, speed, heat = contact.sample(phase, numpy.linspace(0.0, end, 9))
    start = energy(law, 0.0, phase.speed)
    for x, v, h in zip(depth, speed, heat, strict=True):
        assert energy(law, x, v) + h == close(start, abs=1e-9 * start)
    later = contact.sample(phase, numpy.linspace(0.0, end, 9)[1:] - 1e-6 * end)[0]
    assert (depth[1:] - later) / (1e-6 * end) == close(speed[1:], abs=1e-4 * phase.speed)


@holds(contact.static_depth, law=LAW)
def _(found, law):
    assert law.elastic * found**1.5 == close(law.mass * law.gravity, rel=1e-12)


@holds(contact.stored, law=LAW, depth=st.floats(-0.1, 0.1))
def _(found, law, depth):
    """The work of A x^1.5."""
    work = scipy.integrate.quad(lambda x: law.elastic * x**1.5, 0.0, max(depth, 0.0), epsabs=0.0)[0]
    assert found == close(work, rel=1e-8, abs=1e-300)


# Flight

DROP = st.builds(flight.Drop, st.floats(0.5, 20.0))
PENDULUM = st.builds(flight.Pendulum, st.floats(5.0, 20.0), st.floats(0.5, 2.0))
HIGH = {"machine": flight.Pendulum(9.81, 0.5), "speed": 3.2}


def check_flight(found, machine, speed, whole):
    g = machine.gravity
    if isinstance(machine, flight.Drop):
        half = speed / g
    else:  # the quarter period of a pendulum of amplitude a, sin(a/2)^2 = v^2/(4 g l)
        half = scipy.special.ellipk(speed**2 / (4.0 * g * machine.length)) * math.sqrt(machine.length / g)
    assert found.duration == close(2.0 * half if whole else half, rel=1e-12)
    assert found.height == close(speed**2 / (2.0 * g))
    times = numpy.linspace(0.0, found.duration, 9)
    place, rate = found.at(times)
    assert (abs(rate[0]), rate[-1]) == close((speed if whole else 0.0, speed), rel=1e-7, abs=1e-7 * speed)
    assert 0.5 * rate**2 + found.potential(place) == close(0.5 * speed**2, rel=1e-9)
    if isinstance(machine, flight.Pendulum):
        assert found.potential(place) == close(
            g * machine.length * (1.0 - numpy.cos(place / machine.length)), abs=1e-9 * speed**2
        )
    step = 1e-5 * found.duration
    ahead, behind = found.at(times[1:-1] + step)[0], found.at(times[1:-1] - step)[0]
    assert (ahead - behind) / (2.0 * step) == close(rate[1:-1], abs=1e-6 * speed)


@holds(flight.rebound, machine=DROP | PENDULUM, speed=positive(1e-3, 2.2), outside=(HIGH,))
def _(found, machine, speed):
    check_flight(found, machine, speed, True)


@holds(flight.fall, machine=DROP | PENDULUM, speed=positive(1e-3, 2.2), outside=(HIGH,))
def _(found, machine, speed):
    check_flight(found, machine, speed, False)


# Material of a measured impact


@holds(inverse.group_factor, sphere=SPHERE, speed=SPEED, duration=positive(1e-5, 1.0))
def _(found, sphere, speed, duration):
    """q^2 V0 R tau^5 = m^2."""
    assert found**2 * speed * sphere.radius * duration**5 == close(sphere.mass**2, rel=1e-12)


@holds(inverse.material_of_impact, sphere=st.just(Sphere(0.1, 0.5)), speed=st.floats(0.5, 2.0), duration=st.just(5e-4),
       restitution=st.floats(0.1, 1.0), end=END, form=st.sampled_from(inverse.FORMS), shape=st.sampled_from(["small", "iterate"]),
       gravity=st.just(0.0), outside=({"restitution": 1.001}, {"gravity": -1.0}, {"duration": 10.0}))  # fmt: skip
def _(found, sphere, speed, duration, restitution, end, form, shape, gravity):
    if form == "exact":  # the impact of this material is the one that was measured
        again = motion.solve_impact(sphere, found, speed, end, shape)
        assert (again.duration, again.restitution) == close((duration, restitution), rel=1e-9)
        return
    k = restitution
    assert found.loss_tangent == close(math.pi / 3.0 * (1.0 - k) / (1.0 + k), abs=1e-15)
    factor = 5.03 if form == "printed" else 15.0 / 16.0 * 2.0**2.5
    depth = 0.5 * k / (1.0 + k) * speed * duration
    shaped = math.sqrt(2.0 if shape == "small" else 2.0 - depth / sphere.radius)
    group = sphere.mass / math.sqrt(speed * sphere.radius) / duration**2.5
    assert found.storage_modulus == close(group * factor * (1.0 + k) ** 2.5 / (shaped * k**1.5), rel=1e-12)


@holds(inverse.reading, restitution=st.floats(0.3, 0.95), end=END, form=st.just("exact"), weight=st.just(0.0) | st.floats(0.0, 0.3),
       outside=({"weight": 0.51}, {"restitution": 0.0, "form": "printed"}, {"end": "none", "form": "printed"}),
       examples=8)  # fmt: skip
def _(found, restitution, end, form, weight):
    """h gives back the duration, 1 in these units, and the weight lowers the restitution to the given one."""
    duration = (found.modulus_factor / 0.75) ** 0.4  # T_c, in units of L/V0
    loss = found.loss_tangent
    zeta = severity.severity_of_loss_tangent(loss, end)
    heavy = scaled_motion.scaled_impact(zeta, end, weight / duration)
    assert heavy.duration == close(duration, rel=1e-9)
    assert heavy.restitution == close(restitution, abs=2e-9)


test_each_holds_over_its_domain, test_each_refuses_what_it_cannot_do, test_each_public_function_has_a_property = (
    TABLE.tests("contact_sim_pkg.rigs.impact.theory", MODULES, (motion.FreeImpact, contact.ContactPhase))
)
