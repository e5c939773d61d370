"""One wrong sample of any channel, or one wrong stamp, is named by sample and size; true motions pass."""

import numpy
import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.rotation import exponential
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise, refuse_jumps
from contact_sim_pkg.identify.readers.stamped import _refuse_early_stamp

NOISE = SampleNoise(1e-6, 1e-6, 1e-3, 1e-2)
CHANNELS = ("position", "rotation", "velocity", "angular velocity")


def bouncing(rate):
    """A body in free fall that leaves the ground again at 0.4 and 0.9 s, turning about a fixed axis, in closed form."""
    time = numpy.arange(0.0, 1.3, 1.0 / rate)
    axis = numpy.array([0.6, 0.0, 0.8])
    place, speed, angle, spin = numpy.zeros((len(time), 3)), numpy.zeros((len(time), 3)), 0.0 * time, 0.0 * time
    x, v, a, w, begin = numpy.array([0.0, 0.0, 1.0]), numpy.array([0.7, 0.0, -0.5]), 0.0, 2.0, 0.0
    for end in (0.4, 0.9, 2.0):
        part = (time >= begin) & (time < end)
        t = (time[part] - begin)[:, None]
        gravity = numpy.array([0.0, 0.0, -9.81])
        place[part], speed[part] = x + v * t + 0.5 * gravity * t**2, v + gravity * t
        angle[part], spin[part] = a + w * t[:, 0], w
        t = end - begin
        x, v, a = x + v * t + 0.5 * gravity * t**2, v + gravity * t, a + w * t
        v, w, begin = v * numpy.array([0.6, 1.0, -0.5]), -0.7 * w - 1.0, end
    return BodyStates(time, place, exponential(angle[:, None] * axis), speed, spin[:, None] * axis)


def spoiled(states, channel, sample, size):
    field = channel.replace(" ", "_")
    values = getattr(states, field).copy()
    if channel == "rotation":
        values[sample] = exponential(numpy.array([[0.0, size, 0.0]]))[0] @ values[sample]
    else:
        values[sample, 1] += size
    return states._replace(**{field: values})


@pytest.mark.parametrize("rate", [30.0, 240.0, 1000.0, 20_000.0])
def test_true_motions_pass_with_and_without_noise(rate):
    states = bouncing(rate)
    refuse_jumps(states, NOISE, 9.81)
    random = numpy.random.default_rng(0)
    noisy = states._replace(
        position=states.position + 1e-3 * random.standard_normal(states.position.shape),
        velocity=states.velocity + 0.03 * random.standard_normal(states.velocity.shape),
        angular_velocity=1.1 * states.angular_velocity,
    )
    refuse_jumps(noisy, SampleNoise(1e-3, 1e-6, 0.03, 1e-2), 9.81)


def test_a_body_at_rest_with_rounded_samples_and_a_gap_passes():
    states = bouncing(240.0)
    kept = numpy.r_[0:40, 90:200]
    gap = BodyStates(*(numpy.array(values[kept]) for values in states))
    refuse_jumps(gap, NOISE, 9.81)
    count = 300
    turn = numpy.where(numpy.arange(count) < 150, 0.0, 1e-7)  # one step of a float32
    zero = numpy.zeros((count, 3))
    rest = BodyStates(
        numpy.arange(count) / 240.0, zero + 0.05, exponential(turn[:, None] * [0.0, 1.0, 0.0]), zero, zero
    )
    refuse_jumps(rest, SampleNoise(0.0, 0.0, 0.0, 0.0), 9.81)


@pytest.mark.parametrize("channel", CHANNELS)
@pytest.mark.parametrize("size", [0.3, 3.0, -0.3])
@pytest.mark.parametrize("sample", [3, 600, 905])
def test_one_sample_off_is_named_with_its_size(channel, size, sample):
    if "velocity" in channel:
        size *= 10.0
    states = spoiled(bouncing(1000.0), channel, sample, size)
    with pytest.raises(IdentificationError, match=f"the {channel} .*sample") as told:
        refuse_jumps(states, NOISE, 9.81)
    assert f" {sample} " in str(told.value) or f" {sample - 1} and {sample} " in str(told.value)
    assert f"{abs(size):.2g}" in str(told.value)


@pytest.mark.parametrize("channel", ["position", "rotation"])
def test_a_jump_that_stays_is_named(channel):
    """From a sample on, as where tracking lost the body and found it elsewhere."""
    whole = bouncing(1000.0)
    later = getattr(whole, channel).copy()
    if channel == "position":
        later[700:, 1] += 0.3
    else:
        later[700:] = exponential(numpy.array([[0.0, 0.3, 0.0]]))[0] @ whole.rotation[700:]
    with pytest.raises(IdentificationError, match=f"the {channel} jumps by 0.3 .* samples 699 and 700"):
        refuse_jumps(whole._replace(**{channel: later}), NOISE, 9.81)


@pytest.mark.parametrize("sample", [0, -1])
def test_a_first_or_last_stamp_seconds_off_is_named(sample):
    states = bouncing(1000.0)
    time = states.time.copy()
    time[sample] += 5.0 if sample else -5.0
    with pytest.raises(IdentificationError, match=r"sample \d+ .* lies 5\.\d* s .* its stamp is wrong"):
        refuse_jumps(states._replace(time=time), NOISE, 9.81)


def test_a_stamp_among_others_seconds_early_is_named_and_late_messages_pass():
    """Any stamped topic: poses, twists and wrenches are read by one function."""
    stamps = numpy.arange(10_000) * 1_000_000
    early = stamps.copy()
    early[7000] -= 5_000_000_000
    with pytest.raises(BagError, match=r"stamp of sample 7000 of /odom lies 4.999 s before"):
        _refuse_early_stamp(early, "/odom")
    overtaken = stamps.copy()
    overtaken[[50, 53]] = overtaken[[53, 50]]
    _refuse_early_stamp(overtaken, "/odom")
