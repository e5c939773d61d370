"""A seat and its occupant, linear, against the closed transmissibility of both together."""

import math

import numpy
import pytest

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.run.offline import run_offline

from .scenes import resolved

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
