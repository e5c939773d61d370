"""A seat and its occupant, linear, against the closed transmissibility of both together."""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.messages import ContactForce
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import make_sources

FRAME = 6.7  # [kg]; the two-mass occupant of Wei and Griffin (1998)
HUNG = ((33.4, 35776.0, 761.0), (10.7, 38374.0, 458.0))  # [kg], [N/m], [N s/m]
SHAKING = 0.5  # [m/s^2]

SCENE = """
rig: seat
description: linear seat
duration: 10
accuracy: 1e-3
vibration: {{kind: sine, axis: z, frequency: {frequency}, amplitude: {amplitude}}}
seat:
  occupant: {{frame_mass: 6.7, masses: [33.4, 10.7], stiffness: [35776, 38374], damping: [761, 458]}}
effects:
  seat:
    normal_elastic: {{coefficient: {stiffness}, exponent: 1}}
    general_dissipative: {{coefficient: {damping}, approach_exponent: 0, rate_exponent: 1}}
"""


def apparent_mass(w):
    """Force on the frame over its acceleration."""
    return FRAME + sum(mass * (k + 1j * w * c) / (k + 1j * w * c - mass * w**2) for mass, k, c in HUNG)


def force_of_a_ride(folder, **values):
    scene = folder / "linear.yaml"
    scene.write_text(SCENE.format(**values))
    run_offline(resolved(str(scene)), folder / "bag")
    return numpy.concatenate([numpy.ravel(part) for part in open_bag(folder / "bag").columns("/seat/force")["normal"]])


@pytest.mark.parametrize(("stiffness", "damping"), [(5.0e4, 500.0), (2.0e4, 1000.0)])
@pytest.mark.parametrize("frequency", [2.0, 4.0, 8.0])
def test_a_linear_seat_under_an_occupant_has_the_closed_transmissibility(tmp_path, stiffness, damping, frequency):
    normal = force_of_a_ride(tmp_path, frequency=frequency, amplitude=SHAKING, stiffness=stiffness, damping=damping)
    assert normal.min() > 0.0
    w, settled = 2.0 * math.pi * frequency, normal[len(normal) // 2 :]
    time = 5.0 + numpy.arange(len(settled)) * 5.0 / len(settled)
    shaken = 2j * numpy.mean(settled * numpy.exp(-1j * w * time))
    s, mass = stiffness + 1j * w * damping, apparent_mass(w)
    assert shaken / (mass * SHAKING) == pytest.approx(s / (s - w**2 * mass), rel=1e-3)


def twin_force(times, shaking, coefficient, damping):
    """Force [N] of seat_ride's occupant at ``times`` [s] by scipy, in approach and link compressions: nothing cancels.

    ``shaking``: times and z accelerations of the floor, straight between.
    """
    masses, stiffness, dampers = (numpy.array(column) for column in zip(*HUNG, strict=True))
    rest = ((FRAME + masses.sum()) * GRAVITY / coefficient) ** (2.0 / 3.0)

    def force(approach, rate):
        return coefficient * numpy.maximum(approach, 0.0) ** 1.5 * numpy.maximum(1.0 + damping * rate, 0.0)

    def rates(time, state):
        links = stiffness * state[1:3] + dampers * state[4:6]
        field = -GRAVITY - numpy.interp(time, *shaking)
        frame = field + (force(state[0], state[3]) - links.sum()) / FRAME
        return numpy.concatenate([state[3:], [-frame], frame - field - links / masses])

    start = numpy.concatenate([[rest], masses * GRAVITY / stiffness, numpy.zeros(3)])
    size = numpy.array([rest, rest, rest, 1e-2, 1e-2, 1e-2])
    found = solve_ivp(
        rates, (0.0, times[-1]), start, "DOP853", times, rtol=1e-10, atol=1e-9 * size, max_step=shaking[0][1]
    )
    return force(found.y[0], found.y[3])


@pytest.mark.parametrize("asked", [1e-2, 1e-3])
def test_the_force_of_a_contact_at_the_stiffest_of_the_schema_is_as_accurate_as_requested(asked):
    """Its depth at rest is 0.6 um: an error of place that means nothing on a cushion is all of its force."""
    scene = resolved(
        "seat_ride",
        "duration=0.1",
        f"accuracy={asked}",
        "effects.seat={normal_elastic: {coefficient: 1e12}, normal_dissipative: {}}",
    )
    simulation, source = make_simulation(scene), make_sources(scene)["platform/vibration"]
    simulation.prepare()
    blocks = [source.block(number) for number in range(simulation.blocks)]
    shaken = numpy.concatenate([*(block.acceleration_z[:-1] for block in blocks), blocks[-1].acceleration_z[-1:]])
    found = numpy.concatenate(
        [
            decode(ContactForce, data).normal
            for block in blocks
            for topic, _stamp, data in simulation.advance(block.block, {"platform/vibration": block}).messages
            if topic == "seat/force"
        ]
    )
    times = numpy.arange(len(found)) * (0.1 / len(found))
    expected = twin_force(times, (numpy.arange(len(shaken)) * blocks[0].sample_period, shaken), 1e12, 1.0)
    assert numpy.abs(found - expected).max() <= asked * expected.max()
