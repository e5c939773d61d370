"""A simulation that makes its excitation itself, without ROS: the messages of offline, changed and begun anew."""

import pytest
from tests.bench_process import resolved

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.run.live_parameters import Change, ParameterError
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.steering.own_excitation import OwnExcitation

DAMPING = "effects.seat.normal_dissipative.damping"
WALL = {name for name, topic in TOPICS.items() if topic.wall_time}


def sent(own, first, last):
    """Messages of some blocks, but for those that report wall time."""
    found = []
    for block in range(first, last):
        result = own.advance(block, {})
        found += [*own.excitation, *result.messages]
    return [each for each in found if each[0] not in WALL]


def recorded(bag):
    found = [(each.topic.lstrip("/"), each.log_time, each.data) for each in open_bag(bag).messages()]
    return [each for each in found if each[0] not in {*WALL, "bench/scene"}]


@pytest.fixture(scope="module")
def scene():
    return resolved("seat_ride", "duration=0.2")


def test_its_messages_are_those_of_offline_again_behind_a_reset(scene, tmp_path):
    own = OwnExcitation(scene)
    own.prepare()
    assert (own.inputs, own.topics, own.blocks) == ((), ("platform/vibration",), 20)
    run_offline(scene, tmp_path / "offline")
    wanted = recorded(tmp_path / "offline")
    first = sent(own, 0, 7)
    assert first == wanted[: len(first)]
    own.change(7, {DAMPING: 0.3})
    assert own.has_changed
    assert any(topic == "bench/steering" for topic, _, _ in sent(own, 7, 9))
    own.reset()
    assert not own.has_changed
    assert sent(own, 0, 20) == wanted


def test_a_change_is_sent_with_the_block_that_it_holds_from(scene, tmp_path):
    own = OwnExcitation(scene)
    own.prepare()
    changes = {0: {"seat.occupant.frame_mass": 60.0}, 9: {DAMPING: 0.3}}
    found = []
    for block in range(20):
        if block in changes:
            own.change(block, changes[block])
        found += sent(own, block, block + 1)
    made = [Change(block, key, value) for block, values in changes.items() for key, value in values.items()]
    run_offline(scene, tmp_path / "offline", changes=made)
    assert found == recorded(tmp_path / "offline")


def test_requests_before_one_block_are_one_change(tmp_path):
    scene = resolved("tire_braking", "duration=0.12")
    static, kinetic = "effects.tire.brush.coefficient_static", "effects.tire.brush.coefficient_kinetic"
    own = OwnExcitation(scene)
    own.prepare()
    found = sent(own, 0, 6)
    own.change(6, {static: 0.9})
    own.change(6, {kinetic: 0.6})
    with pytest.raises(ParameterError):
        own.change(6, {static: 0.8, "block_length": 0.02})
    own.change(6, {static: 0.95})  # another mind
    found += sent(own, 6, 12)
    run_offline(scene, tmp_path / "offline", changes=[Change(6, static, 0.95), Change(6, kinetic, 0.6)])
    assert found == recorded(tmp_path / "offline")


def test_a_change_that_is_refused_sends_nothing(scene):
    own = OwnExcitation(scene)
    own.prepare()
    with pytest.raises(ParameterError):
        own.change(0, {DAMPING: 0.3, "block_length": 0.02})
    assert not own.has_changed
    assert not [each for each in sent(own, 0, 1) if each[0] == "bench/steering"]
