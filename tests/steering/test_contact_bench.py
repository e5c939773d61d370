"""A bench that a program steps: the bits of a run, an excitation of one's own, and what is refused."""

import itertools

import numpy
import pytest

from contact_sim_pkg import ContactBench, load_scene
from contact_sim_pkg.bag.block_encoder import encode_block
from contact_sim_pkg.run.block_simulation import Resettable
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.observers import _Observed
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.scene_outputs import outputs_of

SCENES = [
    ("tire_bump", 0.2), ("tire_braking", 0.06), ("seat_ride", 0.3), ("seat_ride_full", 0.1), ("seat_slap", 0.2),
    ("block_fall", 0.3), ("impact_rubber_drop", 0.1), ("roller_flutter", 0.4),
]  # fmt: skip


def bits(outputs):
    return encode_block([each for each in outputs if each.topic != "bench/cost"])


@pytest.mark.parametrize(("scene", "duration"), SCENES)
def test_steps_of_any_length_and_a_reset_give_the_bits_of_a_run(scene, duration):
    whole = outputs_of(scene, duration)
    bench = ContactBench(scene, f"duration={duration}")
    for steps in (itertools.repeat(1), itertools.cycle([2, 1])):
        outputs = []
        while not bench.is_over:
            count = min(next(steps), bench.blocks - round(bench.time / bench.block_length))
            outputs += bench.step(count * bench.block_length).outputs
        assert bits(outputs) == bits(whole)
        bench.reset()
        assert bench.time == 0.0


def test_another_seed_is_another_run_and_the_same_seed_the_same():
    bench = ContactBench("tire_rough_road", "duration=0.04", "effects.tire.contact_field=null")
    first = bits(bench.step(0.04).outputs)
    bench.reset(seed=77)
    assert bits(bench.step(0.04).outputs) != first
    bench.reset(seed=bench.scene.data["seed"])
    again = bits(bench.step(0.04).outputs)
    bench.reset()
    assert bits(bench.step(0.04).outputs) == again


def test_one_that_is_observed_is_made_anew(monkeypatch):
    """What an observer remembers nobody knows; the simulation beneath could go back."""

    class Counting:
        def prepare(self):
            pass

        def observe(self, outputs):
            return []

    monkeypatch.setattr(
        "contact_sim_pkg.run.steered_run.make_simulation",
        lambda scene: _Observed(make_simulation(scene), {"effects.block.counting": (Counting(), "")}),
    )
    bench = ContactBench("block_fall", "duration=0.1")
    assert not isinstance(bench._run.simulation, Resettable)
    first = bits(bench.step(0.1).outputs)
    before = bench._run.simulation
    bench.reset()
    assert bench._run.simulation is not before
    assert bits(bench.step(0.1).outputs) == first


@pytest.fixture(scope="module")
def seat():
    return ContactBench("seat_ride", "duration=1")


def test_a_floor_at_rest_carries_the_weight(seat):
    """Masses times 9.81 m/s², at every sample."""
    seat.reset()
    samples = round(seat.scene.vibration.sample_rate * 0.5)
    force = seat.step(0.5, vibration=numpy.zeros(samples))["seat/force"]
    occupant = seat.scene.data["seat"]["occupant"]
    mass = occupant["frame_mass"] + sum(occupant["masses"])
    assert force.units["normal"] == "N"
    assert force.time[0] == 0.0
    assert numpy.diff(force.time) == pytest.approx(1.0 / seat.scene.outputs.force_rate)
    assert force["normal"] == pytest.approx(mass * 9.81, rel=1e-9)


def test_the_scene_s_own_floor_given_by_hand_is_the_same_run(seat):
    seat.reset()
    own = [bits(seat.step().outputs) for _ in range(5)]
    seat.reset()
    for block in range(5):
        assert bits(seat.step(vibration=seat.vibration()).outputs) == own[block]
    seat.reset()
    assert bits(seat.step(0.05, vibration=seat.vibration(0.05)).outputs) == [*itertools.chain.from_iterable(own)]


def test_the_commands_of_a_loop_given_at_once_are_the_same_run(seat):
    """A controller that reads the last sample of each block; each command is held, so its last sample counts twice."""
    seat.reset()
    samples = round(seat.scene.vibration.sample_rate * seat.block_length)
    commands, outputs, pushed = [], [], 5.0
    while not seat.is_over:
        commands.append(pushed)
        step = seat.step(vibration=numpy.full(samples + 1, pushed))
        outputs += step.outputs
        pushed = -0.5 * pushed - 0.01 * (step["seat/force"]["normal"][-1] - 500.0)
    assert numpy.ptp(commands) > 1.0
    seat.reset()
    again = itertools.chain.from_iterable(seat.step(vibration=numpy.full(samples, each)).outputs for each in commands)
    assert bits(again) == bits(outputs)


def test_a_step_has_every_topic_but_wrenches():
    """Those with maps too: their scalars."""
    bench = ContactBench("tire_braking", "duration=0.06")
    step = bench.step(0.06)
    assert {each.topic for each in step.outputs} - set(step) == {"tire/wrench"}
    assert all(len(step[topic]) for topic in step)
    assert step["tire/patch"].units["load"] == "N"
    (*_, last) = (each.record for each in step.outputs if each.topic == "tire/patch")
    assert step["tire/patch"]["load"][-1] == last.load


def test_what_is_wrong_is_one_sentence(seat):
    seat.reset()
    with pytest.raises(ValueError, match=r"whole blocks of 0\.01 s"):
        seat.step(0.015)
    with pytest.raises(ValueError, match="whole blocks"):
        seat.step(0.0)
    with pytest.raises(ValueError, match="shape"):
        seat.step(vibration=numpy.zeros(3))
    with pytest.raises(RunError, match="ends at 1 s"):
        seat.step(1.01)
    with pytest.raises(KeyError, match="seat/force"):
        seat.step()["tire/force"]
    bench = ContactBench(load_scene("block_fall", "duration=0.1"))
    with pytest.raises(ValueError, match="another seed"):
        bench.reset(seed=1)
    with pytest.raises(ValueError, match="no vibration"):
        bench.step(vibration=[0.0])
