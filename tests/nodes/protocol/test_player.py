"""Due times of the messages of a replay: rate, begin, pause, loop; on an injected clock."""

from typing import NamedTuple

import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.nodes.protocol.player import Player


class Entry(NamedTuple):
    topic: str
    log_time: int  # [ns]
    data: bytes = bytes(4)


class Recorded:
    """A bag of a latched text and of two topics, with a message each 10 and 20 ms."""

    path = "bag"
    begin = 0
    entries = (
        Entry("/text", 0),
        *sorted(
            [Entry("/a", n * 10_000_000) for n in range(11)] + [Entry("/b", n * 20_000_000) for n in range(6)],
            key=lambda entry: entry.log_time,
        ),
    )
    end = 100_000_000

    def messages(self):
        return iter(self.entries)

    def count(self, topic):
        return sum(entry.topic == topic for entry in self.entries)


class RecordedSince1970(Recorded):
    """The same messages as another recorder writes them: log times in wall time, not in order, the text 30 ms late."""

    begin = 1_800_000_000_123_456_789
    entries = (
        *(Entry(each.topic, each.log_time + 1_800_000_000_123_456_789) for each in Recorded.entries[1:5]),
        Entry("/text", 1_800_000_000_153_456_789),
        *(Entry(each.topic, each.log_time + 1_800_000_000_123_456_789) for each in Recorded.entries[5:]),
    )
    end = 1_800_000_000_223_456_789


ALL = ("/text", "/a", "/b")


def play(player, seconds, step=0.005, begin=0.0):
    """What comes, as pairs of time of the steady clock and message."""
    came = []
    for count in range(round(seconds / step) + 1):
        now = begin + count * step
        while (message := player.next_due(now)) is not None:
            came.append((now, message))
    return came


@pytest.mark.parametrize("rate", [0.5, 1.0, 3.0])
def test_each_message_comes_when_it_is_due_and_the_count_is_whole(rate):
    player = Player(Recorded(), ALL, ["/text"], rate=rate)
    assert play(player, 1.0) == []  # paused until `resume`
    player.resume(2.0)
    came = play(player, 0.3, begin=2.0)
    assert [message for _, message in came] == list(Recorded.entries)
    for now, message in came:
        assert -1e-9 < now - 2.0 - message.log_time * 1e-9 / rate < 0.005 + 1e-9
    assert player.done
    assert (player.progress(3.0).sent, player.messages) == (18, 18)


@pytest.mark.fault("C7")
@pytest.mark.parametrize("rate", [0.5, 3.0])
def test_a_bag_in_wall_time_begins_at_its_first_message_and_shows_its_own_length(rate):
    player = Player(RecordedSince1970(), ALL, ["/text"], rate=rate)
    player.resume(2.0)
    came = play(player, 0.3, begin=2.0)
    assert [message for _, message in came] == list(RecordedSince1970.entries)
    due = 0
    for now, message in came:
        due = max(due, message.log_time - RecordedSince1970.begin)  # what comes late in the file is sent at once
        assert -1e-9 < now - 2.0 - due * 1e-9 / rate < 0.005 + 1e-9
    assert player.position(2.04) == RecordedSince1970.begin + round(0.04e9 * rate)  # what --clock shows
    assert player.progress(2.02).simulated == pytest.approx(0.02 * rate, rel=1e-9)
    assert player.progress(9.0).describe() == "0.10 of 0.1 s, 18 of 18 messages"


@pytest.mark.fault("C7")
def test_offsets_of_a_bag_in_wall_time_count_from_its_first_message():
    player = Player(RecordedSince1970(), ALL, ["/text"], start=0.045, loop=True)
    player.resume(1.0)
    came = play(player, 0.0549, begin=1.0)
    late = [entry for entry in RecordedSince1970.entries if entry.log_time >= RecordedSince1970.begin + 45_000_000]
    assert [message for _, message in came] == [RecordedSince1970.entries[4], *late]
    assert came[1][0] == pytest.approx(1.005)
    with pytest.raises(BagError, match=r"start_offset is 0.2 s, bag lasts 0.1 s; begin before its end"):
        Player(RecordedSince1970(), ALL, [], start=0.2)


@pytest.mark.fault("G10")
@pytest.mark.parametrize("size", [0, 3])
def test_a_message_that_is_too_short_to_be_one_is_refused_by_name_before_the_first_is_sent(size):
    class Cut(RecordedSince1970):
        entries = (*RecordedSince1970.entries, Entry("/a", RecordedSince1970.end, bytes(size)))

    with pytest.raises(BagError, match=rf"bag: the message of /a at 0.1 s has {size} bytes.*--topics"):
        Player(Cut(), ALL, [])
    assert Player(Cut(), ("/b", "/text"), []).messages == 7  # the others go out without it


def test_a_begin_skips_all_but_latched_messages():
    player = Player(Recorded(), ALL, ["/text"], start=0.05)
    player.resume(0.0)
    came = [message for _, message in play(player, 0.1)]
    assert came == [Entry("/text", 0), *(entry for entry in Recorded.entries if entry.log_time >= 50_000_000)]
    assert (player.sent, player.messages) == (len(came), len(came))


@pytest.mark.parametrize("number", [1, 4, 5, 16])
def test_a_begin_at_a_message_counts_among_those_replayed(number):
    chosen = [entry for entry in Recorded.entries if entry.topic != "/text"]
    player = Player(Recorded(), ("/a", "/b"), [], start_message=number)
    player.resume(7.0)
    came = play(player, 0.2, begin=7.0)
    assert [message for _, message in came] == chosen[number:]
    assert came[0][0] == 7.0


def test_a_pause_stops_the_recorded_time():
    player = Player(Recorded(), ("/a",), [])
    player.resume(0.0)
    assert len(play(player, 0.042)) == 5
    player.pause(0.045)
    assert play(player, 5.0, begin=0.045) == []
    assert (player.position(9.0), player.wait(9.0)) == (45_000_000, float("inf"))
    player.resume(10.0)
    assert player.wait(10.0) == pytest.approx(0.005, rel=1e-12)
    assert [now for now, _ in play(player, 0.1, begin=10.0)] == pytest.approx([10.005 + 0.01 * n for n in range(6)])


@pytest.mark.parametrize("rate", [0.2, 4.0])
def test_the_wait_is_the_recorded_time_to_the_next_message_over_the_rate(rate):
    """From 33 ms on, 7 ms of recorded time to the message at 40 ms."""
    player = Player(Recorded(), ("/a",), [], rate=rate)
    player.resume(5.0)
    play(player, 0.033 / rate, step=0.003 / rate, begin=5.0)
    now = 5.0 + 0.033 / rate
    assert player.wait(now) == pytest.approx(0.007 / rate, rel=1e-6)
    player.resume(now)  # of what goes on already: nothing
    assert player.progress(now).simulated == pytest.approx(0.033)


@pytest.mark.parametrize("rate", [0.2, 4.0])
def test_a_pass_of_a_loop_lasts_from_its_begin_to_the_end_of_the_bag(rate):
    """From 40 ms to 300 ms; behind the message at 240 ms it waits for the rest."""

    class Long(Recorded):
        entries = tuple(Entry("/a", n * 1_000_000) for n in (0, 90, 150, 240))
        end = 300_000_000

    player = Player(Long(), ("/a",), [], rate=rate, start=0.04, loop=True)
    player.resume(0.0)
    assert [message.log_time for _, message in play(player, 0.21 / rate, step=0.01 / rate)] == [
        90_000_000,
        150_000_000,
        240_000_000,
    ]
    assert player.wait(0.21 / rate) == pytest.approx(0.05 / rate, rel=1e-6)
    assert play(player, 0.04 / rate, step=0.01 / rate, begin=0.21 / rate) == []
    assert (player.sent, player.messages, player.passes) == (3, 3, 0)
    ((_, again),) = play(player, 0.052 / rate, step=0.052 / rate, begin=0.26 / rate)
    assert (again.log_time, player.passes) == (90_000_000, 1)


def test_the_progress_ends_with_the_recording():
    player = Player(Recorded(), ("/a",), [], start=0.05)
    player.resume(1.0)
    assert player.progress(1.02).simulated == pytest.approx(0.07)
    assert player.progress(9.0)[:2] == (pytest.approx(0.1), pytest.approx(0.1))


def test_a_begin_holds_the_message_of_that_very_time_and_none_before():
    player = Player(Recorded(), ("/a", "/b"), [], start=0.02, start_message=2)
    player.resume(0.0)
    came = [message for _, message in play(player, 0.09)]
    assert came == [entry for entry in Recorded.entries if entry.topic != "/text" and entry.log_time >= 20_000_000]
    assert player.messages == len(came)


def test_a_loop_begins_again_with_the_latched_messages():
    player = Player(Recorded(), ALL, ["/text"], loop=True)
    player.resume(0.0)
    came = [message for _, message in play(player, 0.3499)]
    assert came[: 3 * 18] == list(Recorded.entries) * 3
    assert (player.passes, player.done) == (3, False)
    assert player.sent == len(came) - 3 * 18 > 0


def test_a_loop_over_one_instant_does_not_send_without_end():
    player = Player(Recorded(), ("/text",), ["/text"], start=0.1, loop=True)
    player.resume(0.0)
    assert len(play(player, 1.0)) == pytest.approx(10, abs=1)


@pytest.mark.parametrize(
    ("begin", "sentence"),
    [({"start": 0.2}, "lasts 0.1 s"), ({"start_message": 18}, "holds 18 messages to replay, from 0")],
)
def test_a_begin_after_the_end_is_refused(begin, sentence):
    with pytest.raises(BagError, match=sentence):
        Player(Recorded(), ALL, [], **begin)
