"""Runs of the rig roller: what the bag of a scene holds, and that its motion is the one that was told before."""

import math

import numpy
import pytest

from contact_sim_pkg.bag.messages import (
    RollerContact,
    RollerStability,
    RollerTrack,
    RollerVolumes,
    decode_motion,
    decode_roller,
)
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.rigs import forecast_of, make_simulation, result_topics
from contact_sim_pkg.scene.errors import SceneError

from .scenes import resolved

SHORT = {
    "roller_steady": ("duration=0.2", "effects.roller.subsurface.instants=[0.0,0.1]"),
    "roller_flutter": ("duration=0.1",),
    "roller_corrugation": ("duration=0.1", "effects.roller.damage.table_rows=3"),
    "roller_programme": (
        "duration=0.1", "effects.roller.subsurface.instants=[0.0]", "effects.roller.damage.table_rows=3",
    ),
}  # fmt: skip


def run(name, *values):
    scene = resolved(name, *values)
    simulation = make_simulation(scene)
    simulation.prepare()
    messages = []
    for block in range(simulation.blocks):
        messages += simulation.advance(block, {}).messages
    return scene, messages


def of(messages, kind):
    topic = f"roller/{kind.__name__.removeprefix('Roller').lower()}"
    return [decode_roller(kind, data) for name, _stamp, data in messages if name == topic]


def column(messages, name):
    return numpy.concatenate([getattr(block, name) for block in of(messages, RollerContact)])


@pytest.mark.parametrize("name", SHORT)
def test_a_run_says_what_its_scene_lists(name):
    scene, messages = run(name, *SHORT[name])
    assert {topic for topic, _stamp, _data in messages} == set(result_topics(scene))


def test_the_stability_is_that_of_the_sheet():
    """300 N, 50 turns a second, f_r = 0.01: 0.4557 1/s at 304 Hz, critical damping 1.562e-5; with damping 2e-5 lost above 380 N."""
    facts = forecast_of(resolved("roller_flutter")).facts
    assert facts["growth_rate_1_s"] == pytest.approx(0.4557, abs=5e-5)
    assert facts["frequency_Hz"] == pytest.approx(304.0, abs=0.5)
    assert facts["critical_damping_N_m_s"] == pytest.approx(1.562e-5, rel=5e-4)
    damped = forecast_of(resolved("roller_flutter", "roller.damping_tilt=2e-5", "roller.damping_yaw=2e-5"))
    assert damped.facts["critical_load_N"] == pytest.approx(380.0, abs=0.5)
    assert "stable: decays" in damped.sentence


def test_the_amplitude_grows_at_the_rate_that_was_told():
    """A straight line through the logarithm of an amplitude from energy-like squares, both motions of the start included."""
    _scene, messages = run("roller_flutter", "duration=4.0", "roller.tilt=1e-6")
    told = of(messages, RollerStability)[0]
    tilt = column(messages, "tilt")
    blocks = numpy.sqrt((tilt.reshape(80, -1) ** 2).mean(axis=1))
    late = blocks[40:]
    slope = numpy.polyfit(0.05 * numpy.arange(len(late)), numpy.log(late), 1)[0]
    assert slope == pytest.approx(told.growth_rate, rel=0.03)


def test_the_same_bits_come_again():
    pair = [run("roller_corrugation", "duration=0.1", "effects.roller.damage.table_rows=3")[1] for _ in range(2)]
    kept = [[m for m in messages if m[0] != "bench/cost"] for messages in pair]
    assert kept[0] == kept[1]


@pytest.mark.parametrize(("instant", "area", "peak"), [(0.0, 0.766e-6, 141.0e6), (2.0, 0.848e-6, 100.8e6)])
def test_the_contact_of_figure_10_is_in_the_bag(instant, area, peak):
    _scene, messages = run("roller_steady", "duration=2.1", "effects.roller.subsurface.instants=[0.0,2.0]")
    found = next(each for each in of(messages, RollerVolumes) if each.time == instant)
    assert math.pi * found.along_x * found.along_y == pytest.approx(area, rel=2e-3)
    assert found.peak_pressure == pytest.approx(peak, rel=2e-3)
    assert max(found.volume[:-1]) <= found.volume[-1] <= sum(found.volume[:-1])


def test_without_damage_the_track_stays_as_it_is():
    wave = ("effects.roller.track_waves.roughness=0", "effects.roller.track_waves.cosines=[0,1e-7]", "duration=0.1")
    _scene, messages = run("roller_corrugation", *wave, "effects.roller.damage.gain=0")
    tracks = of(messages, RollerTrack)
    assert (tracks[0].height == tracks[-1].height).all()
    assert tracks[-1].range == pytest.approx(2e-7, rel=1e-12)
    assert tracks[-1].lowered == 0.0


def test_the_heave_follows_a_long_wave_and_the_motion_is_that_of_the_contact():
    """One wave a turn at 200 Hz, natural frequency 447 Hz: amplitude 1 / (1 - (200/447)^2)."""
    wave = ("effects.roller.track_waves.roughness=0", "effects.roller.track_waves.cosines=[1e-8]", "duration=0.5")
    _scene, messages = run("roller_corrugation", *wave, "effects.roller.damage.gain=0", "outputs.force_rate=20000")
    heave = column(messages, "heave")[-2000:]
    amplitude = 0.5 * (heave.max() - heave.min())
    assert amplitude == pytest.approx(1e-8 / (1.0 - (200.0 / 446.757) ** 2), rel=5e-3)
    motion = [decode_motion(data) for name, _stamp, data in messages if name == "bench/motion"][-1]
    assert motion.bodies == ("roller_z", "roller_tilt", "roller_yaw")
    assert motion.position[0] == pytest.approx(heave[-1000:], abs=0.0)


def test_cycles_are_turns_times_the_time_acceleration():
    _scene, messages = run("roller_programme", *SHORT["roller_programme"])
    track = of(messages, RollerTrack)[-1]
    assert (track.turns, track.cycles) == (20.0, 20000.0)


def test_a_new_step_of_the_load_tells_its_stability():
    values = (*SHORT["roller_programme"], "roller.programme.time=[0.0,0.05]", "roller.programme.load=[50.0,100.0]")
    _scene, messages = run("roller_programme", *values)
    assert [each.load for each in of(messages, RollerStability)] == [50.0, 100.0]
    assert column(messages, "load")[-1] == pytest.approx(100.0, rel=1e-3)


def test_a_roller_that_tips_over_ends_the_run_with_the_time():
    with pytest.raises(RunError, match="the roller tips over"):
        run("roller_flutter", "roller.tilt=0.1", "duration=4.0")


def test_a_track_that_does_not_turn_whole_times_in_a_block_is_refused_with_the_nearest_speed():
    with pytest.raises(SceneError, match=r"must be a whole number: take 50 1/s"):
        resolved("roller_corrugation", "roller.speed=50.3")


def test_the_summary_and_the_page_show_what_the_scene_records(tmp_path):
    from contact_sim_pkg.analysis.reading import read_recording
    from contact_sim_pkg.analysis.report import sections
    from contact_sim_pkg.analysis.summary import summarise_recording
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.run.offline import run_offline

    run_offline(resolved("roller_programme", *SHORT["roller_programme"]), tmp_path / "bag")
    recording = read_recording(open_bag(tmp_path / "bag"))
    numbers = summarise_recording(recording)["roller"]
    assert numbers["track"]["time_acceleration"] == 1000.0
    assert [each["load_N"] for each in numbers["stability"]] == [26.5]
    assert 0.0 < numbers["dangerous_volumes"][0]["share"] < 1.0
    keys = [section.key for section in sections(recording)]
    assert keys[:4] == ["roller", "stability", "track", "stress"]
