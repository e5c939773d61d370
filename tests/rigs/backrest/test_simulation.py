"""Runs of the backrest rig: what the bag of a scene holds, and that it adds up."""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import ContactEpisodes, ContactForce, ContactPatch, ContactPoints, EnergyLedger
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.rigs import make_simulation, result_topics
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.errors import SceneError

SLAPPING = "vibration.amplitude=14.715"


def run(name, *values):
    scene = resolved(name, *values)
    simulation, sources = make_simulation(scene), make_sources(scene)
    simulation.prepare()
    messages = []
    for block in range(simulation.blocks):
        messages += simulation.advance(
            block, {topic: source.block(block) for topic, source in sources.items()}
        ).messages
    return scene, messages


def of(messages, topic, kind):
    return [decode(kind, data) for name, _stamp, data in messages if name == topic]


@pytest.fixture(scope="module")
def slap_and_slip():
    return run("seat_slip", SLAPPING, "duration=2.0")


def test_a_preload_that_presses_deeper_than_the_back_is_round_is_refused():
    """(1e6 N / 2.457e5 N/m^1.5)^(2/3) = 2.55 m, and the smaller radius is 0.6 m."""
    with pytest.raises(
        SceneError, match=r"backrest\.preload: 1e\+06 N press the back 2\.55 m .*smaller radius of 0\.6 m; lower"
    ):
        make_simulation(resolved("seat_slap", "backrest.preload=1e6"))


def test_a_run_publishes_what_its_scene_lists_and_nothing_else(slap_and_slip):
    scene, messages = slap_and_slip
    assert {name for name, _stamp, _data in messages} == set(result_topics(scene))


def test_the_pressure_map_carries_the_force_to_a_millionth_and_never_pulls(slap_and_slip):
    _scene, messages = slap_and_slip
    forces = numpy.concatenate([block.normal for block in of(messages, "backrest/force", ContactForce)])
    patches = of(messages, "backrest/patch", ContactPatch)
    assert len(patches) * 10 == len(forces)
    assert any(patch.load == 0.0 for patch in patches)
    for patch, force in zip(patches, forces[::10], strict=True):
        carried = patch.pressure.astype(float).sum() * patch.cell_x * patch.cell_y
        assert carried == pytest.approx(force, rel=1e-6, abs=1e-9)
        assert patch.pressure.min() >= 0.0


def test_the_points_carry_the_force_and_keep_within_the_friction_cone(slap_and_slip):
    _scene, messages = slap_and_slip
    force = of(messages, "backrest/force", ContactForce)
    for block, points in zip(force, of(messages, "backrest/points", ContactPoints), strict=True):
        assert points.normal.sum() == block.normal[0]
        assert points.tangential.sum() == block.tangential[0]
        assert (numpy.abs(points.tangential) <= 0.4 * points.normal + 1e-6).all()


def test_slaps_and_slips_leave_the_energy_ledger_closed(slap_and_slip):
    _scene, messages = slap_and_slip
    ledger = of(messages, "bench/energy", EnergyLedger)
    assert abs(ledger[-1].residual) <= 1e-5 * ledger[-1].supplied
    assert numpy.all(numpy.diff([entry.dissipated for entry in ledger]) >= -1e-9)


def test_every_slap_returns_less_work_than_it_received(slap_and_slip):
    _scene, messages = slap_and_slip
    blocks = of(messages, "bench/episodes", ContactEpisodes)
    ratio = numpy.concatenate([block.restitution for block in blocks])
    assert len(ratio) == 10, "one from the start, then one slap a period"
    assert [touched for block in blocks for touched in block.touched] == [0, *[1] * 9]
    assert numpy.all((ratio > 0.0) & (ratio < 1.0))
    for block in blocks:
        assert block.restitution == pytest.approx(numpy.sqrt(block.restitution_work / -block.compression_work))
        assert numpy.all(block.end > block.start)


@pytest.mark.fault("D5")
def test_at_rest_nothing_moves():
    _scene, messages = run("seat_slap", "vibration.amplitude=0", "duration=0.1")
    forces = numpy.concatenate([block.normal for block in of(messages, "backrest/force", ContactForce)])
    assert forces == pytest.approx(45.6 * 9.81, rel=1e-9)
    assert of(messages, "bench/episodes", ContactEpisodes) == []


def test_a_block_without_its_vibration_is_refused():
    simulation = make_simulation(resolved("seat_slap", "duration=0.1"))
    with pytest.raises(RunError, match="platform/vibration: block 0 with 11 samples was due, none came"):
        simulation.advance(0, {})


def test_a_back_that_does_not_lean_is_struck_with_its_whole_mass():
    """Without preload the momentum of the force over the closing phase is mass times the speed of the seat back."""
    values = (
        "vibration={kind: half_sine, axis: x, amplitude: 60, duration: 0.03, start: 0}",
        "duration=0.5",
        "accuracy=1e-6",
    )
    _scene, messages = run("seat_shock", "backrest.preload=0", "backrest.mass=20", *values, "outputs.force_rate=10000")
    force = numpy.concatenate([block.normal for block in of(messages, "backrest/force", ContactForce)])
    speed = 60.0 * 0.03 * 2.0 / numpy.pi
    momentum = force.sum() / 10_000.0
    assert 20.0 * speed < momentum < 2.0 * 20.0 * speed, "the mass ends between the seat back's speed and twice that"
    (episodes,) = of(messages, "bench/episodes", ContactEpisodes)
    assert len(episodes.restitution) == 1


SEARCHED = ("effects.backrest.shell_modes={}", "effects.backrest.contact_search={}", "backrest.preload=20")


def test_the_map_of_a_moving_point_carries_its_force_and_the_point_lies_on_the_back():
    _scene, messages = run("seat_slap", *SEARCHED, "duration=0.5")
    forces = numpy.concatenate([block.normal for block in of(messages, "backrest/force", ContactForce)])
    patches = of(messages, "backrest/patch", ContactPatch)
    assert (forces == 0.0).any()
    for patch, force in zip(patches, forces[::10], strict=True):
        carried = patch.pressure.astype(float).sum() * patch.cell_x * patch.cell_y
        assert carried == pytest.approx(force, rel=1e-6, abs=1e-9)
        assert patch.pressure.min() >= 0.0
    points = of(messages, "backrest/points", ContactPoints)
    assert all(len(each.x) == 1 for each in points)
    assert max(abs(each.x[0]) for each in points) <= 0.25
    assert max(abs(each.y[0]) for each in points) <= 0.20


def test_a_moving_point_is_refused_where_the_back_has_many_bumps():
    with pytest.raises(SceneError, match="several bumps"):
        resolved("seat_slap", *SEARCHED, "effects.backrest.shell_modes.modes=25")


def test_the_shell_of_its_scene_slaps_at_one_point_and_its_ledger_closes():
    """Twenty-one periods of 5.25 Hz in 4 s, of which the first ones settle."""
    _scene, messages = run("seat_shell")
    points = of(messages, "backrest/points", ContactPoints)
    assert all(len(block.normal) <= 1 for block in points)
    force = numpy.concatenate([block.normal for block in of(messages, "backrest/force", ContactForce)])
    assert 0.1 < (force == 0.0).mean() < 0.4
    assert force.min() >= 0.0
    # The mean force is the preload; the exciting force has none over whole periods.
    period = round(len(force) / (4.0 * 5.25))
    assert force[-10 * period :].mean() == pytest.approx(20.0, rel=0.03)
    ledgers = of(messages, "bench/energy", EnergyLedger)
    moved = max(abs(each.supplied) + each.dissipated for each in ledgers)
    assert max(abs(each.residual) for each in ledgers) < 1e-5 * moved
