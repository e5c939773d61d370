"""A car of linear springs and dampers on roads of several classes and speeds: what scales, and what stays.

The road is so smooth that the tire is linear too.
Amplitudes of the lines of a road follow from its spectrum, so a whole period of it has no scatter.
"""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import BodyMotion, ContactForce
from contact_sim_pkg.report.signal.weighting import WK, response
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import make_sources

LENGTH, SETTLED = 500.0, 10.0  # [m] of the road until it repeats; [s]
SMOOTH = 1e-8  # [m^3]; class A has 16e-6

SCENE = """
rig: car
description: linear car
duration: {duration}
block_length: 0.1
accuracy: 1e-5
travel: {{speed: {speed}}}
road: {{kind: iso8608, roughness: {roughness}, length: 500, shortest_wavelength: 0.1, longest_wavelength: 200}}
seat: {{occupant: {{model: wei_griffin_2}}}}
effects:
  tire:
    normal_elastic: {{}}
  seat:
    normal_elastic: {{coefficient: 5.0e4, exponent: 1}}
    general_dissipative: {{coefficient: 500, approach_exponent: 0, rate_exponent: 1}}
"""


def ride(folder, roughness, speed):
    """Vertical acceleration of floor and seat frame [samples] over a whole period of the road, and samples a second."""
    duration = SETTLED + LENGTH / speed
    scene = folder / "car.yaml"
    scene.write_text(SCENE.format(duration=duration, speed=speed, roughness=roughness))
    resolved_scene = resolved(str(scene))
    simulation, sources = make_simulation(resolved_scene), make_sources(resolved_scene)
    simulation.prepare()
    motions = []
    for block in range(simulation.blocks):
        inputs = {topic: source.block(block) for topic, source in sources.items()}
        for topic, _stamp, data in simulation.advance(block, inputs).messages:
            if topic == "bench/motion":
                motions.append(decode(BodyMotion, data))
            elif topic in ("tire/force", "seat/force"):
                assert min(decode(ContactForce, data).normal) > 0.0, "a contact that lifts is not linear"
    rate = 1.0 / motions[0].sample_period
    last = slice(-round(LENGTH / speed * rate), None)
    return *(
        numpy.concatenate([block.acceleration[block.bodies.index(name)] for block in motions])[last]
        for name in ("body_z", "seat_frame_z")
    ), rate


def weighted_rms(acceleration, rate):
    frequency = numpy.fft.rfftfreq(len(acceleration), 1.0 / rate)
    lines = numpy.fft.rfft(acceleration) * response(WK, frequency) / len(acceleration)
    return numpy.sqrt(2.0 * (numpy.abs(lines[1:]) ** 2).sum())


def test_the_motion_grows_with_the_root_of_the_roughness(tmp_path):
    """From class to class the spectral density grows four times."""
    smooth, rough = (ride(tmp_path, roughness, 20.0) for roughness in (SMOOTH, 4.0 * SMOOTH))
    for before, after in zip(smooth[:2], rough[:2], strict=True):
        assert after == pytest.approx(2.0 * before, abs=2e-3 * numpy.abs(after).max())


def test_the_seat_factor_stays_over_speed_and_motion_grows_with_its_root(tmp_path):
    """White noise of the road's velocity: the spectrum of the motion grows with the speed and keeps its form.

    Slower than 20 m/s the tire's footprint is no longer short beside the waves that shake the wheel.
    """
    weighted = {}
    for speed in (20.0, 25.0, 40.0):
        *motions, rate = ride(tmp_path, SMOOTH, speed)
        weighted[speed] = [weighted_rms(each, rate) for each in motions]
    seat_factor = {speed: seat / floor for speed, (floor, seat) in weighted.items()}
    for speed in (25.0, 40.0):
        assert seat_factor[speed] == pytest.approx(seat_factor[20.0], rel=0.01)
        for here, slow in zip(weighted[speed], weighted[20.0], strict=True):
            assert here / slow == pytest.approx(numpy.sqrt(speed / 20.0), rel=0.02)
