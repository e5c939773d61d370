"""The encoder of a block: canonical order, frames, and nothing kept from one call to the next."""

import numpy
import pytest

from contact_sim_pkg.bag.block_encoder import Output, encode_block
from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.messages import decode, stamp_of
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records.messages import ContactForce, EnergyLedger, WrenchStamped
from contact_sim_pkg.run.outputs import wrench_of

COLUMNS = ("normal", "tangential", "approach", "effective_height")


def force(block=3):
    return ContactForce(block=block, sample_period=1e-3, **{name: numpy.arange(2.0) for name in COLUMNS})


def ledger(block=3):
    return EnergyLedger(**dict.fromkeys(EnergyLedger._fields, 0.0) | {"block": block})


def wrench(height):
    return wrench_of((0.0, 0.0, height), (0.0, 0.0, 0.0))


def test_messages_are_in_order_of_stamp_then_rank_of_the_topic_then_input():
    given = [
        Output("bench/energy", 10, ledger()), Output("seat/wrench", 20, wrench(2.0)), Output("tire/wrench", 10, wrench(1.0)),
        Output("tire/wrench", 10, wrench(0.5)), Output("tire/force", 10, force()),
    ]  # fmt: skip
    messages = encode_block(given)
    assert [(topic, stamp) for topic, stamp, _data in messages] == [
        ("tire/force", 10), ("tire/wrench", 10), ("tire/wrench", 10), ("bench/energy", 10), ("seat/wrench", 20),
    ]  # fmt: skip
    heights = [decode(WrenchStamped, data).wrench.force.z for topic, _stamp, data in messages if topic == "tire/wrench"]
    assert heights == [1.0, 0.5]
    assert all(stamp_of(data) == stamp for _topic, stamp, data in messages)


def test_a_message_is_in_the_frame_of_its_topic_unless_its_output_names_another(tmp_path):
    given = [
        Output("seat/force", 0, force()), Output("bench/energy", 0, ledger()), Output("block/wrench", 0, wrench(1.0)),
        Output("block/wrench", 1, wrench(1.0), "bench"),
    ]  # fmt: skip
    topics = ("seat/force", "bench/energy", "block/wrench")
    with BagWriter(tmp_path / "bag", recorded_topics(topics), reserve_bytes=0, background=False) as writer:
        for topic, stamp, data in encode_block(given):
            writer.write(topic, stamp, data)
    frames = [open_bag(tmp_path / "bag").columns(topic)["frame_id"].tolist() for topic in topics]
    assert frames == [["seat_contact"], ["bench"], ["block_contact", "bench"]]


@pytest.mark.parametrize(
    ("topic", "frame"),
    [("road/patch", "bench"), ("bench/episodes", "bench"), ("bench/cost", "bench"), ("impact/wave", "impact_contact")],
)
def test_the_frame_of_a_topic_is_that_of_its_contact_or_of_the_bench(topic, frame):
    assert TOPICS[topic].frame == frame


def test_equal_outputs_give_equal_bytes():
    given = [Output("tire/force", 10, force()), Output("bench/energy", 10, ledger())]
    assert encode_block(given) == encode_block(given)


def test_columns_that_differ_in_length_are_refused():
    with pytest.raises(MessageError, match="normal has 5"):
        encode_block([Output("tire/force", 0, force()._replace(normal=numpy.zeros(5)))])
