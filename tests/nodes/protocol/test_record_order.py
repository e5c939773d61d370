"""The logger's order does not depend on the order of arrival."""

import random

import pytest
from tests.nodes.blocks import LENGTH, vibration

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.nodes.protocol.input_blocks import FARTHEST_AHEAD
from contact_sim_pkg.nodes.protocol.record_order import RecordOrder
from contact_sim_pkg.records.messages import ContactForce, EnergyLedger
from contact_sim_pkg.run.outputs import wrench_of

VIBRATION = "platform/vibration"


def results(block: int) -> list[tuple[str, bytes]]:
    """Four messages of the simulator in canonical order: three at the block's start, a second wrench half-way."""
    start = block * LENGTH
    wrench = wrench_of((0.0, 0.0, float(block)), (0.0, 0.0, 0.0))
    force = ContactForce(
        block=block, sample_period=1e-3, normal=[1.0], tangential=[1.0], approach=[1.0], effective_height=[1.0]
    )
    return [
        ("seat/force", encode(force, start, "seat_contact")),
        ("seat/wrench", encode(wrench, start, "seat_contact")),
        (
            "bench/energy",
            encode(
                EnergyLedger(
                    block=block, kinetic=0.0, potential=0.0, stored=0.0, dissipated=0.0, supplied=0.0, residual=0.0
                ),
                start,
            ),
        ),
        ("seat/wrench", encode(wrench, start + LENGTH // 2, "seat_contact")),
    ]


def everything(blocks: int) -> list[tuple[str, bytes]]:
    return [pair for block in range(blocks) for pair in [(VIBRATION, vibration(block)), *results(block)]]


def test_any_order_of_arrival_gives_the_canonical_order():
    blocks = 6
    expected = everything(blocks)
    for seed in range(20):
        arrivals: list = [*expected, *((None, block) for block in range(blocks))]
        random.Random(seed).shuffle(arrivals)
        order, given = RecordOrder([VIBRATION], LENGTH), []
        for topic, content in arrivals:
            if topic is None:
                order.on_progress(content, 4 * (content + 1))
            else:
                assert order.add(topic, content)
            given += order.release_whole()
        assert [(message.topic, message.data) for message in given] == expected
        assert order.last_block == blocks - 1
        assert order.released == len(expected)
        assert order.missing() == 0


def test_a_block_waits_for_its_excitation_and_its_last_message():
    order = RecordOrder([VIBRATION], LENGTH)
    order.on_progress(0, 4)
    for topic, data in results(0):
        order.add(topic, data)
    assert order.release_whole() == []
    assert order.missing() == 1
    order.add(VIBRATION, vibration(0))
    assert len(order.release_whole()) == 5


def test_a_report_that_was_overwritten_by_the_next_one_is_not_needed():
    order = RecordOrder([VIBRATION], LENGTH)
    for topic, data in everything(3):
        order.add(topic, data)
    order.on_progress(2, 12)
    assert len(order.release_whole()) == 15


def test_excitation_that_was_not_simulated_stays_out_of_the_bag():
    order = RecordOrder([VIBRATION], LENGTH)
    for topic, data in [*everything(1), (VIBRATION, vibration(1)), (VIBRATION, vibration(2))]:
        order.add(topic, data)
    order.on_progress(0, 4)
    assert len(order.release_whole()) == 5
    assert order.release_rest() == []


def test_a_repeated_block_of_excitation_is_kept_once():
    order = RecordOrder([VIBRATION], LENGTH)
    assert order.add(VIBRATION, vibration(0))
    assert not order.add(VIBRATION, vibration(0))


def test_the_rest_after_a_loss_is_released_and_the_loss_counted():
    order = RecordOrder([VIBRATION], LENGTH)
    for topic, data in everything(3)[:-1]:
        order.add(topic, data)
    order.on_progress(1, 8)
    order.on_progress(2, 12)
    assert len(order.release_whole()) == 10
    assert order.missing() == 1
    assert len(order.release_rest()) == 4


@pytest.mark.fault("B6")
def test_the_logger_keeps_no_more_blocks_ahead_than_the_simulator():
    order = RecordOrder([VIBRATION], LENGTH)
    kept = [order.add(VIBRATION, vibration(block)) for block in range(1000)]
    assert kept.count(True) == FARTHEST_AHEAD
