"""Runs of the rig roller: what the bag of a scene holds, and that its motion is the one that was told before."""

import math

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import (
    BodyMotion,
    EnergyLedger,
    RollerContact,
    RollerStability,
    RollerTrack,
    RollerVolumes,
)
from contact_sim_pkg.rigs.roller.model import build_roller
from contact_sim_pkg.rigs.roller.theory.motion import energies
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.rigs import forecast_of, make_simulation, result_topics
from contact_sim_pkg.scene.errors import SceneError

SHORT = {
    "roller_hour": ("duration=0.1", "effects.roller.subsurface.instants=[0.0]", "effects.roller.damage.table_rows=3"),
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
    return [decode(kind, data) for name, _stamp, data in messages if name == topic]


def ledger_rows(messages):
    """Kinetic, potential, stored, dissipated, supplied, residual [blocks, 6]."""
    ledgers = [decode(EnergyLedger, data) for name, _stamp, data in messages if name == "bench/energy"]
    names = ("kinetic", "potential", "stored", "dissipated", "supplied", "residual")
    return numpy.array([[getattr(each, name) for name in names] for each in ledgers])


def column(messages, name):
    return numpy.concatenate([getattr(block, name) for block in of(messages, RollerContact)])


@pytest.mark.parametrize("name", SHORT)
def test_a_run_publishes_what_its_scene_lists(name):
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


def test_the_worst_row_of_a_programme_is_reported_before_the_run():
    """With damping 2e-5 the motion is lost above 380 N (sheet); a ramp from 80 to 400 N passes it, one to 300 N does not."""
    damped = ("roller.damping_tilt=2e-5", "roller.damping_yaw=2e-5", "roller.load=80")
    ramp = "roller.programme={{time: [0, 1], load: [80, {}]}}"
    beyond, below = (forecast_of(resolved("roller_flutter", *damped, ramp.format(end))) for end in (400, 300))
    assert beyond.facts["stable"]
    assert (beyond.facts["worst"]["time_s"], beyond.facts["worst"]["stable"]) == (1.0, False)
    assert "worst at 1 s: under 400 N unstable: flutters" in beyond.sentence
    assert below.facts["worst"]["stable"]


def test_a_roller_without_friction_and_damping_is_said_to_be_neutral():
    facts = forecast_of(resolved("roller_flutter", "effects.roller.rolling_friction.coefficient=0"))
    assert (facts.facts["growth_rate_1_s"], facts.facts["critical_damping_N_m_s"]) == (0.0, 0.0)
    assert "neutral: neither grows nor decays; critical load 3000 N, critical damping 0 N m s" in facts.sentence


def test_the_amplitude_grows_at_the_reported_rate():
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
    motion = [decode(BodyMotion, data) for name, _stamp, data in messages if name == "bench/motion"][-1]
    assert motion.bodies == ("roller_z", "roller_tilt", "roller_yaw")
    assert motion.position[0] == pytest.approx(heave[-1000:], abs=0.0)


def test_cycles_are_turns_times_the_time_acceleration():
    _scene, messages = run("roller_programme", *SHORT["roller_programme"])
    track = of(messages, RollerTrack)[-1]
    assert (track.turns, track.cycles) == (20.0, 5000.0)


def test_a_new_step_of_the_load_tells_its_stability():
    values = (*SHORT["roller_programme"], "roller.programme.time=[0.0,0.05]", "roller.programme.load=[50.0,100.0]")
    _scene, messages = run("roller_programme", *values)
    assert [each.load for each in of(messages, RollerStability)] == [50.0, 100.0]
    assert column(messages, "load")[-1] == pytest.approx(100.0, rel=1e-3)


def test_a_new_step_of_the_bending_load_moves_the_static_tilt():
    """The moment of the bent surface is proportional to Q, and so is the static tilt while it is small."""
    bend = "effects.roller.shaft_bending={load: 10}"
    values = ("roller.programme={between: steps, time: [0.0, 0.05], bending_load: [10, 20]}", bend)
    _scene, messages = run("roller_flutter", "duration=0.1", *values)
    first, second = of(messages, RollerStability)
    assert second.tilt == pytest.approx(2.0 * first.tilt, rel=1e-3)
    assert abs(first.tilt) > 1e-5


def test_a_bending_load_that_is_constant_is_that_of_the_effect():
    bend = "effects.roller.shaft_bending={load: 150}"
    _scene, wanted = run("roller_flutter", "duration=0.1", bend)
    rows = "roller.programme={time: [0.0, 1.0], bending_load: [150, 150]}"
    _scene, found = run("roller_flutter", "duration=0.1", "effects.roller.shaft_bending={load: 70}", rows)
    assert column(found, "tilt") == pytest.approx(column(wanted, "tilt"), rel=1e-12, abs=1e-18)


def test_the_motion_follows_a_slow_bending_load_and_its_ledger_closes():
    """A roller without spin under Q(t) = 100 N/s t: it stays at the static tilt of the moment, of which
    eq 17a gives -f0 Q pi a b h R (A - l + R psi) / J_y over the stiffness k_psi - F R."""
    heavy = ("roller.damping_tilt=2e-2", "roller.damping_yaw=2e-2", "roller.tilt=0", "roller.load=100")
    off = ("effects.roller.gyroscope=null", "effects.roller.rolling_friction=null")
    rows = ("roller.programme={time: [0.0, 1.0], bending_load: [0, 100]}", "effects.roller.shaft_bending={}")
    _scene, messages = run("roller_flutter", "duration=1.0", *heavy, *off, *rows)
    contact = of(messages, RollerContact)[-1]
    radius, second = 0.005, 0.25 * math.pi * 0.005**4
    pull = 0.1 * 100.0 * math.pi * contact.along_x[-1] * contact.along_y[-1] * (radius - contact.approach[-1]) / second
    tilt = -pull * 0.02 * (0.060 - 0.158) / (60.0 - 100.0 * 0.02 + pull * 0.02**2)
    assert contact.tilt[-1] == pytest.approx(tilt, rel=2e-3)
    rows_of_energy = ledger_rows(messages)
    assert abs(rows_of_energy[:, 5]).max() < 1e-6 * abs(rows_of_energy).max()


def test_the_axial_wave_is_the_arm_of_the_tilted_roller():
    """x_c = R sin psi at the cells of the last turn, beside the tilt between the same instants."""
    values = ("duration=0.1", "effects.roller.subsurface.instants=[0.0]", "effects.roller.damage.table_rows=3")
    cells = ("effects.roller.track_waves.cells=250", "outputs.force_rate=50000")
    _scene, messages = run("roller_hour", *values, "roller.tilt=1e-3", *cells)
    track, contact = of(messages, RollerTrack)[-1], of(messages, RollerContact)[-1]
    assert len(track.axial) == len(track.height) == 250
    assert track.axial == pytest.approx(0.02 * numpy.sin(contact.tilt[-250:]), rel=1e-9)
    assert of(run("roller_corrugation", *values)[1], RollerTrack)[-1].axial.size == 0


def test_points_are_marked_by_the_stresses_above_their_limits():
    from contact_sim_pkg.rigs.roller.report.figures_stress import TONES, components_above

    limits = numpy.array([4.0, 4.0, 4.0, 1.0, 1.0, 1.0])
    rows = [[0, 0, -3, 0, 0.9, 0], [0, -5, 0, 0, 0, 0], [5, 0, 0, 0, -2, 0], [0, 0, -5, 0, 0, 0], [0, 0, -5, 0, 2, 0]]
    stress = numpy.array(rows, float)
    assert [TONES[int(each)] for each in components_above(stress, stress, limits)] == list(TONES)
    bent = stress + numpy.array([9.0, 0, 0, 0, 0, 0])
    assert components_above(stress, bent, limits).tolist() == [1, 1, 2, 3, 4]


def test_a_roller_that_tips_over_ends_the_run_with_the_time():
    with pytest.raises(RunError, match="the roller tips over"):
        run("roller_flutter", "roller.tilt=0.1", "duration=4.0")


def test_a_track_that_does_not_turn_whole_times_in_a_block_is_refused_with_the_nearest_speed():
    with pytest.raises(SceneError, match=r"must be a whole number: take 50 1/s"):
        resolved("roller_corrugation", "roller.speed=50.3")


def residual_share(messages):
    """Largest residual over the largest entry."""
    rows = ledger_rows(messages)
    return abs(rows[:, -1]).max() / abs(rows[:, :-1]).max()


def test_without_friction_a_run_keeps_its_energy_over_ten_thousand_turns_of_the_roller():
    """To 1e-6; nothing supplies, nothing dissipates, so what is left over is what the integrator adds."""
    values = ("effects.roller.rolling_friction.coefficient=0", "roller.tilt=0.01", "duration=200.0", "block_length=0.1")
    scene = resolved("roller_flutter", *values, "outputs.force_rate=1000", "roller.speed=50")
    simulation = make_simulation(scene)
    simulation.prepare()
    held = simulation._angles
    times, loads = numpy.linspace(0.0, 1.0, 1001), numpy.full(1001, 300.0)
    first = energies(simulation.model.roller, 300.0, held.state)
    for second in range(200):
        held.advance(float(second), times, loads)
    ledger = held.energies()
    assert abs(ledger.supplied) < 1e-12 * first.stored
    assert ledger.dissipated == 0.0
    residual = ledger.supplied - ledger.dissipated - ledger.kinetic - ledger.potential - ledger.stored
    assert abs(residual) < 1e-6 * first.stored


def test_the_ledger_closes_over_waves_wear_and_steps_of_the_load():
    values = ("effects.roller.track_waves.cosines=[0,1e-6]", "effects.roller.damage.table_rows=3", "duration=0.2")
    _scene, messages = run("roller_programme", *values, "effects.roller.subsurface.instants=[0.0]", *STEPPED)
    assert residual_share(messages) < 1e-6
    rows = ledger_rows(messages)
    assert rows[-1, 3] > 1e-9, "something was dissipated"
    assert (numpy.diff(rows[:, 3]) > 0.0).all()


STEPPED = ("roller.programme.time=[0.0,0.1]", "roller.programme.load=[50.0,100.0]", "effects.roller.damage.gain=1e-5")
BARE = ("effects.roller.damage.gain=0", "effects.roller.track_waves.roughness=0", "duration=0.1")


@pytest.mark.parametrize("track", ["shaft", "roller", "both"])
def test_waves_of_either_body_move_the_roller_at_their_own_frequency(track):
    """Two waves round the shaft pass at 400 Hz, two round the roller at 100 Hz; with both the roller's are rough only."""
    values = ("effects.roller.track_waves.cosines=[0,1e-8]", f"effects.roller.track_waves.track={track}")
    _scene, messages = run(
        "roller_corrugation", *values, *BARE, "duration=0.5", "block_length=0.1", "outputs.force_rate=20000"
    )
    heave = column(messages, "heave")[-4000:]
    strongest = numpy.fft.rfftfreq(4000, 1.0 / 20000.0)[abs(numpy.fft.rfft(heave)).argmax()]
    assert strongest == (100.0 if track == "roller" else 400.0)
    bodies = {each.body: each for each in of(messages, RollerTrack)}
    assert set(bodies) == ({"shaft", "roller"} if track == "both" else {track})
    for body, turns, radius in (("shaft", 100.0, 0.005), ("roller", 25.0, 0.02)):
        if body in bodies:
            assert (bodies[body].turns, bodies[body].radius) == (turns, radius)


def test_both_bodies_wear_each_within_its_own_limits():
    """Limits of the roller far above the stress: it stays as it is, while the shaft wears."""
    values = ("effects.roller.track_waves.track=both", "effects.roller.subsurface.roller_normal_limit=1e12")
    limit = (
        "effects.roller.subsurface.roller_shear_limit=1e12",
        "effects.roller.damage.table_rows=3",
        "block_length=0.1",
    )
    _scene, messages = run("roller_corrugation", *values, *limit, "duration=0.2")
    lowered = {each.body: each.lowered for each in of(messages, RollerTrack)}
    assert lowered["roller"] == 0.0
    assert lowered["shaft"] > 1e-6


def test_the_roller_rides_a_road_beside_its_track():
    """A bump of 0.2 m at 6.28 m/s is slow: the heave is its height, and the load its acceleration."""
    road = ("road.kind=bump", "road.position=0.2", "road.height=1e-3", "road.length=0.2")
    _scene, messages = run("roller_corrugation", *road, *BARE, "outputs.force_rate=20000")
    heave, load = column(messages, "heave"), column(messages, "load")
    x = 2.0 * math.pi * 0.02 * 50.0 * numpy.arange(len(heave)) / 20000.0
    assert heave.max() == pytest.approx(1e-3, rel=0.02)
    assert abs(x[heave.argmax()] - 0.2) < 0.02
    assert heave[x < 0.09] == pytest.approx(0.0, abs=1e-12)
    assert load.max() > 101.0


def test_a_road_without_track_waves_is_refused():
    with pytest.raises(SceneError, match="rides no heights"):
        resolved("roller_flutter", "road.kind=flat")


def test_the_softness_of_the_contact_follows_a_fixed_yaw():
    """A roller held at 0.5 rad: kappa of the contact at that yaw, seen in the decay of its heave."""
    from contact_sim_pkg.rigs.roller.theory.heave import make_heave, natural_frequency

    scene = resolved("roller_corrugation", *BARE, "roller.yaw=0.5", "effects.roller.damage.table_rows=2")
    simulation = make_simulation(scene)
    model = simulation.model
    curvatures = model.programme.curvatures_at(0.0)
    stiff = [
        natural_frequency(
            make_heave(0.175, 0.05, 100.0, model.contact(1.0, yaw, curvatures).approach, model.bending_compliance)
        )
        for yaw in (0.0, 0.5)
    ]
    assert simulation._ride.frequency == pytest.approx(stiff[1], rel=1e-12)
    assert stiff[1] != pytest.approx(stiff[0], rel=1e-6)


def test_the_track_s_own_curvature_stiffens_the_crests_no_more_than_the_theory_of_hertz():
    """A deep wave of 4 cycles: W'' = 1e-6 (4 / 0.005)^2 = 0.64 1/m on 450; too deep a wave is refused."""
    wave = ("effects.roller.track_waves.cosines=[0,0,0,1e-6]", *BARE)
    loads = [
        column(run("roller_corrugation", *wave, f"effects.roller.track_waves.local_curvature='{each}'")[1], "load")
        for each in ("on", "off")
    ]
    assert 1e-6 < abs(loads[0] / loads[1] - 1.0).max() < 0.02
    deep = ("effects.roller.track_waves.cosines=[0,0,0,0,0,0,0,2e-4]", *BARE)
    with pytest.raises(RunError, match="the track is hollow by"):
        run("roller_corrugation", *deep, "effects.roller.track_waves.local_curvature='on'")


def test_the_time_acceleration_is_checked_against_every_turn_ridden():
    """Five turns in one are near to each of them ridden while the wave is small; nothing is looked at where each is ridden."""
    _scene, messages = run("roller_corrugation", "duration=0.2", "effects.roller.damage.table_rows=4")
    tracks = [each for each in of(messages, RollerTrack) if each.checked]
    assert len(tracks) == 4
    assert all(each.checked == 20.0 for each in tracks)
    assert 0.0 < max(each.check_error for each in tracks) < 0.05
    _scene, messages = run(
        "roller_corrugation", "duration=0.1", "effects.roller.damage.table_rows=4", "roller.acceleration=1"
    )
    assert not any(each.checked for each in of(messages, RollerTrack))


@pytest.mark.parametrize(
    ("name", "values", "sentence"),
    [
        (
            "roller_flutter",
            ("roller.inertia_tilt=1e-15", "roller.inertia_yaw=1e-15"),
            "give larger inertias or softer springs",
        ),
        ("roller_flutter", ("roller.load=1e7",), r"more than 0\.5 of the radius of 0\.01 m .* give a lower load"),
        (
            "roller_flutter",
            ("roller.stiffness_yaw=0",),
            r"stiffness_yaw 0 N m/rad: neither may be 0; give stiffer springs",
        ),
        (
            "roller_flutter",
            ("roller.load=280", "effects.roller.shaft_bending={load: 4e4}"),
            r"the static tilt is 0\.2143 rad, the roller tips over at 0\.2 rad",
        ),
        ("roller_flutter", ("roller.profile_radius=0",), "give profile_radius or shaft_profile_radius a value"),
        ("roller_flutter", ("roller.inertia_product=2e-5",), "give one from -1.99999e-05 to 1.99999e-05"),
        ("roller_flutter", ("effects.roller.normal_elastic.split=parallel",), "add shaft_bending, or take series"),
        (
            "roller_flutter",
            ("roller.programme={time: [0, 1], bending_load: [1, 2]}",),
            "add the effect shaft_bending, or leave it out",
        ),
        ("roller_corrugation", ("roller.speed=0",), "give a speed above 0 or leave track_waves out"),
        ("roller_corrugation", ("effects.roller.subsurface.instants=[7]",), "leave it out or take a longer duration"),
        (
            "roller_corrugation",
            ("roller.mass=1e-9", "effects.roller.damage.table_rows=2"),
            "give a larger mass, more cells",
        ),
    ],
)
def test_what_cannot_run_is_refused_before_the_run_with_a_cure(name, values, sentence):
    with pytest.raises(SceneError, match=sentence):
        make_simulation(resolved(name, "duration=0.1", *values))


def test_a_roller_that_tips_over_at_once_is_prepared_and_fails_in_its_run():
    simulation = make_simulation(resolved("roller_flutter", "duration=0.1", "roller.load=5000"))
    simulation.prepare()
    with pytest.raises(RunError, match="tips over"):
        simulation.advance(0, {})


def test_a_roller_that_tips_over_under_its_load_is_reported():
    with pytest.raises(RunError, match=r"the roller tips over, .* a lower load"):
        run("roller_flutter", "duration=0.1", "roller.load=5000")


def test_the_traction_along_rolling_is_that_of_the_friction_where_none_is_given():
    friction = "effects.roller.rolling_friction.coefficient=0.02"
    model = build_roller(resolved("roller_hour", friction))
    assert model.traction == (0.0, 0.02)
    own = build_roller(resolved("roller_hour", friction, "effects.roller.subsurface.traction_y=0.1"))
    assert own.traction == (0.0, 0.1)
    assert build_roller(resolved("roller_steady")).traction == (0.0, 0.0)


def test_radii_that_do_not_divide_are_refused_for_a_track_on_both():
    with pytest.raises(SceneError, match=r"must be a whole number, take 0\.02 m for the larger"):
        resolved(
            "roller_corrugation", "effects.roller.track_waves.track=both", "roller.radius=0.021", "roller.speed=100"
        )


def test_the_metrics_and_the_page_show_what_the_scene_records(tmp_path):
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.report.reading import read_recording
    from contact_sim_pkg.report.report import sections
    from contact_sim_pkg.rigs.roller.report.metrics import roller_metrics
    from contact_sim_pkg.run.offline import run_offline

    run_offline(resolved("roller_programme", *SHORT["roller_programme"]), tmp_path / "bag")
    recording = read_recording(open_bag(tmp_path / "bag"))
    metrics = {each.key: each for each in roller_metrics(recording)}
    assert metrics["roller.cycles"].value == 250.0 * recording.series["roller"].tracks[-1].turns
    assert metrics["roller.growth"].verdict == "good"
    below = max(each.volume[-1] for each in recording.series["roller"].volumes)
    assert metrics["roller.volume"].value >= 1e9 * below  # bending is included
    assert metrics["roller.pressure"].verdict == "met"
    keys = [section.key for section in sections(recording)]
    assert keys[:4] == ["roller", "stability", "track", "stress"]
