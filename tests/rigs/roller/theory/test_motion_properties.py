"""Every public function of the roller's heave, track, tilt, yaw and stability: checks over its domain, refusals outside."""

from __future__ import annotations

import math

import numpy
import pytest
import scipy.integrate
from hypothesis import strategies as st
from tests.properties import Table, positive, rows

from contact_sim_pkg.rigs.roller.theory import corrugation, heave, load_split, moments, motion, stability
from contact_sim_pkg.rigs.roller.theory.parameters import Bending, Curvatures, Roller

MODULES = ("corrugation", "heave", "motion", "stability")
TABLE = Table()
holds = TABLE.holds
close = pytest.approx

# Heave

SOFT, BENT = positive(1e-9, 1e-6), st.just(0.0) | positive(1e-10, 1e-6)
VALUES = {"mass": positive(0.01, 10.0), "damping_ratio": st.floats(0.0, 0.5), "load": positive(1.0, 1e4),
          "contact_coefficient": SOFT, "bending_compliance": BENT}  # fmt: skip
HEAVE = st.builds(heave.make_heave, *VALUES.values())


@holds(heave.make_heave, **VALUES, outside=({"mass": 0.0}, {"damping_ratio": -1e-9}, {"bending_compliance": -1e-9}))
def _(found, **given):
    assert found._asdict() == given


@holds(heave.linear_stiffness, heave=HEAVE)
def _(found, **given):
    """Slope of the load over the approach at rest."""
    made = given["heave"]
    rest = made.contact_coefficient * made.load ** (2 / 3) + made.bending_compliance * made.load
    coefficients = made.contact_coefficient, made.bending_compliance
    loads = [load_split.load_of_approach(*coefficients, rest * (1.0 + d)) for d in (-1e-5, 1e-5)]
    assert found == close((loads[1] - loads[0]) / (2e-5 * rest), rel=1e-6)


@holds(heave.natural_frequency, heave=HEAVE)
def _(found, **given):
    made = given["heave"]
    assert made.mass * found**2 == close(heave.linear_stiffness(made), rel=1e-12)


@holds(heave.contact_energy, contact_coefficient=SOFT, bending_compliance=BENT, load=positive(1.0, 1e4))
def _(found, contact_coefficient, bending_compliance, load):
    """The work of the load on its approach."""
    slope = lambda f: f * (2 / 3 * contact_coefficient * f ** (-1 / 3) + bending_compliance)  # noqa: E731
    assert found == close(scipy.integrate.quad(slope, 0.0, load, epsabs=0.0)[0], rel=1e-7)


HEIGHTS = rows(st.floats(-1e-6, 1e-6), 8, 8)


@holds(
    heave.closed_path,
    heave=HEAVE,
    heights=HEIGHTS,
    outside=({"heights": numpy.zeros(0)}, {"heights": numpy.zeros((2, 2))}),
)
def _(found, heights, **given):
    assert found.height.tolist() == [*heights, heights[0]]
    assert (found.coefficient == given["heave"].contact_coefficient).all()


def held(made, z, v, over):
    """Kinetic, of the press, and stored."""
    rest = made.contact_coefficient * made.load ** (2 / 3) + made.bending_compliance * made.load
    load = load_split.load_of_approach(made.contact_coefficient, made.bending_compliance, rest + over - z)
    stored = heave.contact_energy(made.contact_coefficient, made.bending_compliance, load)
    return 0.5 * made.mass * v * v + made.load * z + stored, load


FIXED = heave.make_heave(0.5, 0.05, 100.0, 2e-7, 1e-8)
ROUND = heave.closed_path(FIXED, 1e-6 * numpy.array([0.0, 1.0, 2.0, 1.0, 0.0, -1.0, -2.0, -1.0]))
MOVING = st.builds(lambda z, v: numpy.array([z, v, 0.0, 0.0]), st.floats(-2e-6, 2e-5), st.floats(-0.02, 0.02))
ROOM = {"loads": st.builds(lambda: numpy.zeros(8)), "motion": st.builds(lambda: numpy.zeros((8, 2)))}


@holds(heave.ride, heave=st.just(FIXED), path=st.just(ROUND), cell_time=positive(1e-5, 1e-3), turns=st.integers(1, 3), state=MOVING,
       **ROOM)  # fmt: skip
def _(found, path, cell_time, turns, state, loads, motion, **given):
    """What the track supplies and the damper takes is what the motion gains."""
    made = given["heave"]
    z, v = motion[0]
    again = numpy.array([z, v, 0.0, 0.0])
    heave.ride(made, path, cell_time, 1, again, numpy.zeros(8), numpy.zeros((8, 2)))
    before, after = held(made, z, v, path.height[0])[0], held(made, again[0], again[1], path.height[8])[0]
    gained = again[2] - again[3]
    assert again[:2] == close(state[:2], rel=1e-12, abs=1e-18)
    # A step follows the motion to about 1e-7 of the energy at hand, less where the contact is lost within a step.
    lost = 1e-5 if found == 0.0 else 1e-2
    assert after - before == close(gained, abs=lost * (abs(before) + abs(gained)))
    assert again[3] >= 0.0
    assert 0.0 <= found <= 1.0


# Track

LOADS, SHARES = numpy.array([0.0, 50.0, 100.0, 200.0]), numpy.array([0.0, 0.1, 0.3, 0.9])
TRACK = corrugation.make_track(0.01, 0.02, 16, 0.002, 1e-3, 1e-6, (LOADS, SHARES))
LATE = ({"table": (LOADS[1:], SHARES[1:])}, {"table": (LOADS[::-1], SHARES)}, {"table": (LOADS, SHARES[1:])}, {"cells": 7},
        {"hardness": numpy.ones(3)}, {"turn_time": 0.0})  # fmt: skip


@holds(corrugation.make_track, radius=positive(1e-3, 1.0), turn_time=positive(1e-3, 10.0), cells=st.integers(8, 500),
       contact_length=positive(1e-5, 1e-2), gain=st.floats(0.0, 1.0), approach=positive(1e-8, 1e-3),
       table=st.just((LOADS, SHARES)), outside=LATE)  # fmt: skip
def _(found, radius, turn_time, cells, contact_length, gain, approach, table):
    assert found.contact_cells * 2.0 * math.pi * radius == close(contact_length * cells)
    assert found.largest_range == close(0.14 * radius)
    assert (found.turn_time, found.gain, found.approach) == (turn_time, gain, approach)
    assert (found.hardness == numpy.ones(cells)).all()


def mean_over(heights, width, place):
    """Of the line through the heights, round the track, over a width about a place."""
    if width < 1e-6:
        return heights[place]
    cells = len(heights)
    at = numpy.linspace(place - 0.5 * width, place + 0.5 * width, 4001)
    line = numpy.interp(at % cells, numpy.arange(cells + 1), numpy.append(heights, heights[0]))
    return scipy.integrate.trapezoid(line, at) / width


@holds(corrugation.mean_weights, width=st.just(0.0) | st.floats(0.01, 9.0))
def _(found, width):
    """A peak of one cell spreads to what the mean of its line is at each place."""
    peak = numpy.zeros(24)
    peak[12] = 1.0
    padded = numpy.append(found, numpy.zeros(12))
    for k in range(10):
        assert padded[k] == close(mean_over(peak, width, 12 + k), abs=2e-3)
    assert 2.0 * found.sum() - found[0] == close(1.0, rel=1e-12)


@holds(
    corrugation.moving_mean,
    heights=rows(st.floats(-1.0, 1.0), 12, 12),
    width=st.floats(0.1, 8.0),
    out=st.builds(lambda: numpy.zeros(13)),
)
def _(found, heights, width, out):
    assert out[12] == out[0]
    for place in (0, 5, 11):
        assert out[place] == close(mean_over(heights, width, place), abs=2e-3)
    assert out[:12].mean() == close(heights.mean(), abs=1e-12)


@holds(corrugation.wear, track=st.just(TRACK), turns=st.floats(1.0, 100.0), loads=rows(st.floats(0.0, 300.0), 16, 16),
       heights=st.builds(lambda: numpy.zeros(16)))  # fmt: skip
def _(found, track, turns, loads, heights):
    """gamma delta turns times the share of each load; what all lose alike is told apart."""
    share = numpy.where(loads <= 200.0, numpy.interp(loads, LOADS, SHARES), 0.9 + 0.006 * (loads - 200.0))
    worn = 1e-3 * 1e-6 * turns * share
    assert found.lowered == close(worn.mean(), rel=1e-9, abs=1e-30)
    assert heights == close(worn.mean() - worn, abs=1e-9 * worn.max() + 1e-30)
    assert found.range == close(numpy.ptp(heights), abs=1e-24)


WAVES = 1e-6 * numpy.cos(numpy.arange(16))


@holds(corrugation.run_intervals, heave=st.just(FIXED), track=st.just(TRACK), turns=st.integers(1, 3), intervals=st.just(2),
       heights=st.builds(WAVES.copy), state=st.builds(lambda: numpy.zeros(2)), loads=st.builds(lambda: numpy.zeros(16)),
       motion=st.builds(lambda: numpy.zeros((16, 2))), examples=3)  # fmt: skip
def _(found, turns, heights, state, loads, motion, **given):
    """Rides over the moving mean of the track, each of which wears it."""
    own, at, met, lowered, ranges = WAVES.copy(), numpy.zeros(2), numpy.zeros(16), 0.0, 0.0
    for _ in range(2):
        ridden = heave.closed_path(FIXED, own)
        corrugation.moving_mean(own, TRACK.contact_cells, ridden.height)
        heave.ride(FIXED, ridden, TRACK.turn_time / 16, turns, at, met, numpy.zeros((16, 2)))
        worn = corrugation.wear(TRACK, float(turns), met, own)
        lowered, ranges = lowered + worn.lowered, worn.range
    assert (found.lowered, found.range, found.ended) == (close(lowered), close(ranges), False)
    assert (heights, state, loads) == (close(own, rel=1e-12), close(at, rel=1e-12), close(met, rel=1e-12))


@holds(corrugation.growth_of_wave, heave=HEAVE, track=st.just(TRACK), waves=st.integers(1, 5), slope=st.floats(-2.0, 2.0),
       cells=st.just(16), outside=({"waves": -1}, {"cells": 7}))  # fmt: skip
def _(found, track, waves, slope, cells, **given):
    """A wave of small height: the load that the linear motion meets over it, and what that wears, in phase."""
    made = given["heave"]
    omega, kappa = 2.0 * math.pi * waves / track.turn_time, heave.natural_frequency(made)
    stiff = heave.linear_stiffness(made)
    mean = mean_over(numpy.cos(2.0 * math.pi * waves / cells * numpy.arange(cells)), track.contact_cells, 0)
    # m z'' + 2 zeta kappa m z' + k z = k W: the load is k (W - z)
    z = stiff / (stiff - made.mass * omega**2 + 2j * made.damping_ratio * kappa * made.mass * omega)
    load = (stiff * (1.0 - z)).real * mean
    worn = -track.gain * track.approach * slope * load / made.load
    assert found == close(worn, rel=2e-3, abs=1e-9 * abs(track.gain * track.approach * slope * stiff / made.load))


# Tilt and yaw

BODIES = Curvatures(100.0, 50.0, 200.0, 0.0)
E = 1.15e11
ROLLER = st.builds(
    Roller, st.just(0.02), positive(1e-5, 1e-4), positive(1e-5, 1e-4), st.floats(-5e-6, 5e-6), positive(1e-6, 1e-4),
    st.floats(-500.0, 500.0), st.floats(30.0, 100.0), st.floats(30.0, 100.0), st.floats(0.0, 1e-3), st.floats(0.0, 1e-3),
    st.floats(-0.02, 0.02),
)  # fmt: skip
BENDING = st.none() | st.just(Bending(225.0, 0.060, 0.158, 0.005, 0.25 * math.pi * 0.005**4, 0.1))
FORCE = st.floats(1.0, 500.0)
STATE = st.tuples(st.floats(-0.02, 0.02), st.floats(-0.02, 0.02), st.floats(-5.0, 5.0), st.floats(-5.0, 5.0)).map(
    numpy.array
)


@holds(motion.gauss_rule, stages=st.integers(1, 4), outside=({"stages": 5}, {"stages": 1.5}))
def _(found, stages):
    """Weights integrate t^k up to 2 s - 1, the rows of A up to s - 1."""
    a, c, b = found[:-1, :-1], found[:-1, -1], found[-1, :-1]
    for k in range(2 * stages):
        assert b @ c**k == close(1.0 / (k + 1), rel=1e-12)
    for k in range(stages):
        assert a @ c**k == close(c ** (k + 1) / (k + 1), rel=1e-12)


def residual(roller, bending, load, state, rates):
    """Of the two equations of motion."""
    pulled = moments.moments(roller, BODIES, bending, E, load, float(state[0]), float(state[1]))
    gyro = roller.inertia_spin * roller.spin
    tilt = roller.inertia_tilt * rates[0] + roller.inertia_product * rates[1] + gyro * state[3]
    yaw = roller.inertia_product * rates[0] + roller.inertia_yaw * rates[1] - gyro * state[2]
    tilt += roller.damping_tilt * state[2] + roller.stiffness_tilt * state[0] - pulled.tilt
    yaw += roller.damping_yaw * state[3] + roller.stiffness_yaw * state[1] - pulled.yaw
    return tilt, yaw


@holds(motion.accelerations, roller=ROLLER, curvatures=st.just(numpy.array([BODIES])), bending=BENDING, modulus=st.just(E),
       loads=rows(FORCE, 1, 1), states=STATE.map(lambda s: s[None, :]), out=st.builds(lambda: numpy.zeros((1, 2))))  # fmt: skip
def _(found, roller, curvatures, bending, modulus, loads, states, out):
    assert residual(roller, bending, float(loads[0]), states[0], out[0]) == close((0.0, 0.0), abs=1e-10)


def energy_of(roller, load, state):
    """Half of v M v, of the springs, and what the load loses as the tilted roller gives way."""
    m = numpy.array([[roller.inertia_tilt, roller.inertia_product], [roller.inertia_product, roller.inertia_yaw]])
    springs = roller.stiffness_tilt * state[0] ** 2 + roller.stiffness_yaw * state[1] ** 2
    return 0.5 * state[2:4] @ m @ state[2:4] + 0.5 * springs - load * roller.radius * (1.0 - math.cos(state[0]))


@holds(motion.energies, roller=ROLLER, load=FORCE, state=STATE)
def _(found, roller, load, state):
    assert sum(found) == close(energy_of(roller, load, state), rel=1e-9, abs=1e-15)


@holds(
    motion.energy,
    roller=ROLLER,
    load=FORCE,
    state=STATE,
    outside=({"state": numpy.zeros(3)}, {"state": numpy.zeros((4, 1))}),
)
def _(found, roller, load, state):
    assert found == close(energy_of(roller, load, state), rel=1e-9, abs=1e-15)


@st.composite
def six(draw):
    return numpy.append(draw(STATE), [0.0, 0.0])


@holds(motion.integrate_tilt_yaw, roller=ROLLER, curvatures=st.just(BODIES), bending=BENDING, modulus=st.just(E),
       loads=st.builds(lambda one, other: numpy.linspace(one, other, 101), FORCE, FORCE), step=st.just(2e-5),
       table=st.just(motion.gauss_rule(3)), state=six(), record=st.builds(lambda: numpy.zeros((2, 4))), examples=6)  # fmt: skip
def _(found, roller, curvatures, bending, modulus, loads, step, table, state, record):
    """The equations of motion by scipy; supplied less dissipated is the energy gained."""
    assert found == motion.DONE
    assert record[1] == close(state[:4], rel=1e-12)

    def slope(t, y):
        load = float(numpy.interp(t, step * numpy.arange(101), loads))
        zero = numpy.array(residual(roller, bending, load, y, (0.0, 0.0)))
        m = numpy.array([[roller.inertia_tilt, roller.inertia_product], [roller.inertia_product, roller.inertia_yaw]])
        return numpy.append(y[2:], -numpy.linalg.solve(m, zero))

    done = scipy.integrate.solve_ivp(slope, (0.0, 100 * step), record[0], "DOP853", rtol=1e-9, atol=1e-12)
    size = abs(record).max(axis=0) + 1e-6
    assert state[:4] / size == close(done.y[:, -1] / size, abs=1e-6)
    gained = energy_of(roller, loads[-1], state) - energy_of(roller, loads[0], record[0])
    assert state[4] - state[5] == close(gained, rel=1e-6, abs=1e-9 * energy_of(roller, 0.0, record[0]))
    assert state[5] >= 0.0


# Stability

PLAIN = Roller(0.02, 2e-5, 2e-5, 0.0, 3.5e-5, 314.0, 60.0, 50.0, 0.0, 0.0, 0.01)
MISSHAPEN = (
    {"roller": PLAIN._replace(inertia_product=2e-5)},
    {"modulus": 0.0},
    {"roller": PLAIN._replace(inertia_tilt=-1.0)},
)
STABLE = {"roller": ROLLER, "curvatures": st.just(BODIES), "bending": BENDING, "modulus": st.just(E)}
HOLLOW = {"curvatures": Curvatures(1.0, 1.0, -2.0, 0.0), "bending": Bending(1.0, 0.1, 0.2, 0.005, 5e-10, 0.1)}


@holds(stability.linearise, **STABLE, load=FORCE, outside=(*MISSHAPEN, HOLLOW, {"load": -1.0}))
def _(found, roller, curvatures, bending, modulus, load):
    """At the static angles nothing moves, and D and K are the slopes of the equations there."""
    rest = numpy.array([found.tilt, found.yaw, 0.0, 0.0])
    assert residual(roller, bending, load, rest, (0.0, 0.0)) == close((0.0, 0.0), abs=1e-9)
    for axis in range(4):
        step = numpy.zeros(4)
        step[axis] = 1e-5
        sides = [numpy.array(residual(roller, bending, load, rest + sign * step, (0.0, 0.0))) for sign in (1.0, -1.0)]
        expected = (found.stiffness if axis < 2 else found.damping)[:, axis % 2]
        assert (sides[0] - sides[1]) / 2e-5 == close(expected, rel=1e-5, abs=1e-5)
    for axis, unit in enumerate(((1.0, 0.0), (0.0, 1.0))):
        assert residual(roller, bending, load, rest, unit) == close(tuple(found.inertia[:, axis]), abs=1e-9)


def determinant(linear, s):
    return numpy.linalg.det(linear.inertia * s**2 + linear.damping * s + linear.stiffness)


@holds(stability.stability, **STABLE, load=FORCE, outside=MISSHAPEN)
def _(found, roller, curvatures, bending, modulus, load):
    """Each root makes the motion's matrix singular."""
    linear = found.linear
    for s in found.roots:
        size = numpy.linalg.norm(linear.inertia * abs(s) ** 2) * numpy.linalg.norm(linear.stiffness) + numpy.linalg.det(
            linear.stiffness
        )
        assert abs(determinant(linear, s)) < 1e-7 * abs(size)
    fastest = found.roots.real.max()
    assert found.growth_rate == (fastest if found.growth_rate != 0.0 else 0.0)
    assert found.growth_rate != 0.0 or abs(fastest) <= 1e-12 * abs(found.roots).max()
    total = -numpy.trace(numpy.linalg.solve(linear.inertia, linear.damping))
    assert sum(found.roots) == close(total, abs=1e-6 * sum(abs(found.roots)))


TOPPLING = st.builds(lambda k: PLAIN._replace(stiffness_tilt=k, rolling_friction=0.0, spin=0.0), st.floats(1.0, 10.0))
ALONE = {"curvatures": st.just(BODIES), "bending": st.none(), "modulus": st.just(E)}


@holds(stability.critical_load, roller=TOPPLING, **ALONE, largest=st.just(1e3), examples=5, outside=({"largest": 0.0},))
def _(found, roller, curvatures, bending, modulus, largest):
    """Without spin the roller topples where F R is the stiffness of the tilt."""
    expected = roller.stiffness_tilt / roller.radius
    assert found == close(expected, rel=1e-6)
    assert stability.critical_load(roller, curvatures, bending, modulus, 0.9 * expected) is None


FLUTTER = st.builds(lambda f: PLAIN._replace(rolling_friction=f), st.floats(0.005, 0.05))


@holds(stability.critical_damping, roller=FLUTTER, **ALONE, load=st.floats(10.0, 200.0), examples=5,
       outside=({"roller": PLAIN._replace(stiffness_tilt=0.1), "load": 200.0},))  # fmt: skip
def _(found, roller, curvatures, bending, modulus, load):
    """The threshold of growth: Routh's determinant of the characteristic polynomial changes its sign there."""

    def routh(damping):
        damped = roller._replace(damping_tilt=damping, damping_yaw=damping)
        linear = stability.linearise(damped, curvatures, bending, modulus, load)
        s = numpy.array([0.0, 1.0, -1.0, 2.0, -2.0]) * 1e3
        values = [determinant(linear, x) for x in s]
        a0, a1, a2, a3, a4 = numpy.polyfit(s / 1e3, values, 4)
        return a1 * a2 * a3 - a0 * a3**2 - a1**2 * a4

    assert found > 0.0
    assert routh(0.99 * found) < 0.0 < routh(1.01 * found)


test_each_holds_over_its_domain, test_each_refuses_what_it_cannot_do, test_each_public_function_has_a_property = (
    TABLE.tests("contact_sim_pkg.rigs.roller.theory", MODULES, (heave.Heave, heave.Path, corrugation.WearTrack))
)
