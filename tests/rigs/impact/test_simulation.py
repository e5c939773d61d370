"""Runs of the impact rig: what the bag of a scene holds, that it adds up, and that its material comes back."""

import math
from types import SimpleNamespace

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import (
    ContactForce,
    EnergyLedger,
    ImpactCourse,
    ImpactEvents,
    ImpactFront,
    ImpactHistory,
    ImpactPosition,
    ImpactStress,
    ImpactWave,
)
from contact_sim_pkg.rigs.impact.material.bag_impacts import impacts_of_bag
from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.options import Options
from contact_sim_pkg.rigs.impact.material.report import material_report
from contact_sim_pkg.rigs.impact.model import build_impact
from contact_sim_pkg.rigs.impact.motion import ImpactMotion, Rest
from contact_sim_pkg.rigs.impact.report.series import missing_impacts
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.contact import static_depth
from contact_sim_pkg.rigs.impact.theory.motion import solve_impact
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.rigs import make_simulation, result_topics
from contact_sim_pkg.scene.errors import SceneError


def run(name, *values):
    scene = resolved(name, *values)
    simulation = make_simulation(scene)
    simulation.prepare()
    messages = []
    for block in range(simulation.blocks):
        messages += simulation.advance(block, {}).messages
    return scene, messages


def of(messages, topic, kind):
    return [decode(kind, data) for name, _stamp, data in messages if name == topic]


def events_of(messages):
    blocks = of(messages, "impact/events", ImpactEvents)
    return {
        name: numpy.concatenate([getattr(each, name) for each in blocks])
        for name in blocks[0]._fields
        if name != "block"
    }


def course_of(messages, topic, kind):
    return of(messages, topic, kind)


@pytest.fixture(scope="module")
def rubber():
    return run("impact_rubber_drop")


def test_a_run_publishes_what_its_scene_lists_and_nothing_else(rubber):
    scene, messages = rubber
    assert {name for name, _stamp, _data in messages} == set(result_topics(scene))


def test_messages_lie_in_their_block_in_canonical_order(rubber):
    _scene, messages = rubber
    stamps = [stamp for _name, stamp, _data in messages]
    assert stamps == sorted(stamps)


def test_the_ball_falls_bounces_and_rests_under_its_weight(rubber):
    _scene, messages = rubber
    events = events_of(messages)
    assert events["start"][0] == pytest.approx(2.0 / 9.81, rel=1e-12)
    assert events["number"].tolist() == list(range(len(events["number"])))
    flights = numpy.diff(events["start"])[1:]
    assert (flights < numpy.diff(events["start"])[:-1]).all()
    last = of(messages, "impact/force", ContactForce)[-1]
    assert last.normal == pytest.approx(0.02 * 9.81, rel=1e-6)


def test_every_joule_is_accounted_for_and_heat_only_grows(rubber):
    _scene, messages = rubber
    ledger = of(messages, "bench/energy", EnergyLedger)
    assert max(abs(each.residual) for each in ledger) < 1e-13 * 0.04
    heat = numpy.array([each.dissipated for each in ledger])
    assert (numpy.diff(heat) > -1e-16).all()
    assert heat[-1] == pytest.approx(0.04, rel=1e-3)  # all but what the resting ball stores


def test_works_of_an_impact_are_its_kinetic_energies_and_the_weight(rubber):
    _scene, messages = rubber
    e = events_of(messages)
    lost = e["compression_work"] + e["restitution_work"]
    kinetic = 0.5 * 0.02 * e["speed"] ** 2 * (e["restitution"] ** 2 - 1.0)
    assert (lost <= kinetic + 1e-18).all()  # weight does work on the way from touch to loss of force
    assert lost == pytest.approx(kinetic, abs=0.02 * 9.81 * e["depth"].max())


def test_no_force_pulls_and_no_sample_lies_between_contact_and_flight(rubber):
    _scene, messages = rubber
    for block in of(messages, "impact/force", ContactForce):
        assert block.normal.min() >= 0.0
        assert (block.normal[block.approach <= 0.0] == 0.0).all()


def test_the_course_of_an_impact_ends_without_force_and_holds_its_peaks(rubber):
    _scene, messages = rubber
    events = events_of(messages)
    for course in course_of(messages, "impact/course", ImpactCourse):
        force = course.elastic_force + course.viscous_force
        assert force[-1] == pytest.approx(0.0, abs=1e-9 * force.max())
        assert force.max() == pytest.approx(events["peak_force"][course.number], rel=1e-3)
        assert course.depth.max() == pytest.approx(events["depth"][course.number], rel=1e-3)
        assert course.time[-1] == events["duration"][course.number]


def test_the_stress_carries_the_force(rubber):
    _scene, messages = rubber
    courses = course_of(messages, "impact/course", ImpactCourse)
    stress = course_of(messages, "impact/stress", ImpactStress)[0]
    ring = 2.0 * numpy.pi * stress.radius[:, None] ** 2 * stress.place
    carried = numpy.trapezoid((stress.elastic + stress.viscous) * ring, stress.place, axis=1)
    force = numpy.interp(stress.time, courses[0].time, courses[0].elastic_force + courses[0].viscous_force)
    free = stress.limited == 0
    assert free.sum() > 90
    assert carried[free] == pytest.approx(force[free], abs=2e-3 * force.max())


def test_wave_front_position_and_history_speak_of_the_same_impacts(rubber):
    _scene, messages = rubber
    count = len(events_of(messages)["number"])
    kinds = {"wave": ImpactWave, "front": ImpactFront, "position": ImpactPosition, "history": ImpactHistory}
    found = {name: course_of(messages, f"impact/{name}", kind) for name, kind in kinds.items()}
    assert all([each.number for each in rows] == list(range(count)) for rows in found.values())
    wave, front, history = found["wave"][0], found["front"][0], found["history"][0]
    assert numpy.abs(wave.height).max() <= wave.amplitude
    assert (front.front_speed <= front.shear_speed).all()
    assert front.supersonic[0] == 1
    assert front.supersonic[-1] == 0
    growing = history.valid == 1
    assert 0.3 < growing.mean() < 0.9
    assert (found["position"][0].surface_depth >= 0.0).all()


def test_what_is_off_changes_nothing_that_is_on(rubber):
    _scene, messages = rubber
    bare = run("impact_rubber_drop", "effects.impact={normal_elastic: {}, normal_dissipative: {}}")[1]
    both = {"impact/events", "impact/force", "impact/course", "bench/motion", "bench/energy"}
    assert {name for name, _stamp, _data in bare} == both | {"impact/wrench", "bench/cost"}
    assert [m for m in bare if m[0] in both] == [m for m in messages if m[0] in both]


def test_rates_and_blocks_change_nothing_of_the_impacts(rubber):
    _scene, messages = rubber
    other = events_of(run("impact_rubber_drop", "outputs.force_rate=1000", "block_length=0.05")[1])
    for name, column in events_of(messages).items():
        assert other[name].tolist() == column.tolist(), name


def test_steel_is_the_free_impact_to_the_weight():
    events = events_of(run("impact_steel", "impact.gravity=1e-3", "impact.speeds=[1.0]", "impact.arm=1.0",
                           "impact.machine=pendulum", "impact.gravity=9.81")[1])  # fmt: skip
    free = solve_impact(Sphere(0.0326, 0.01), Material(1.05e11, 0.003), 1.0)
    assert events["duration"][0] == pytest.approx(free.duration, rel=1e-8)
    assert events["depth"][0] == pytest.approx(free.depth, rel=1e-8)
    assert events["peak_force"][0] == pytest.approx(free.peak_force, rel=1e-8)


def test_restitution_of_a_pendulum_does_not_depend_on_speed_and_times_scale_down_to_rest():
    _scene, messages = run("impact_pendulum", "duration=30.0", "outputs.force_rate=100")
    e = events_of(messages)
    k = solve_impact(Sphere(0.2, 0.05), Material(2.0e5, 0.3), 1.0).restitution
    assert e["speed"] == pytest.approx(k ** numpy.arange(27.0), rel=1e-9)
    assert e["duration"] * e["speed"] ** 0.2 == pytest.approx(e["duration"][0] * e["speed"][0] ** 0.2, rel=1e-9)
    assert e["depth"] / e["speed"] ** 0.8 == pytest.approx(e["depth"][0] / e["speed"][0] ** 0.8, rel=1e-9)
    assert e["speed"][-1] > 1e-9 > k * e["speed"][-1]
    assert of(messages, "bench/energy", EnergyLedger)[-1].dissipated == pytest.approx(0.1, rel=1e-12)


def test_a_sphere_rests_once_its_swings_have_a_million_millionth_of_the_work_of_its_weight():
    """With so little loss each phase in contact leaves a fourteenth of that energy."""
    motion = ImpactMotion(build_impact(resolved("impact_rubber_drop", "impact.sample.loss_tangent=0.02")))
    motion.state(numpy.array([10.0]))
    assert isinstance(motion.segments[-1].motion, Rest)
    excesses = []
    for segment in motion.segments[-3:-1]:
        mass, gravity, elastic, *_ = segment.motion.law
        depth, speed = segment.motion.last_depth, segment.motion.last_speed
        static = (mass * gravity / elastic) ** (2.0 / 3.0)
        excess = 0.5 * mass * speed**2 + 0.4 * elastic * depth**2.5 - mass * gravity * (depth - 0.6 * static)
        excesses.append(excess / (mass * gravity * static))
    assert excesses[1] <= 1e-12 < excesses[0]


def test_a_slow_touch_under_weight_swings_with_the_frequency_of_small_swings_at_rest():
    model = build_impact(resolved("impact_rubber_drop"))
    fast, slow, slower = (model.touch(speed, 293.15) for speed in (0.032, 0.02, 1e-9))
    static = static_depth(slow.law)
    swing = numpy.sqrt(1.5 * slow.law.elastic * numpy.sqrt(static) / slow.law.mass)
    assert slow.impact.frequency == pytest.approx(swing, rel=1e-12)
    assert slower.law.viscous == pytest.approx(slow.law.viscous, rel=1e-12)
    assert fast.impact.speed == 0.032
    assert fast.impact.frequency > swing


@pytest.mark.parametrize(
    ("values", "storage_modulus", "loss_tangent"),
    [((), 8.0e6, 0.2), (("impact.sample.material=foam", "impact.radius=0.05"), 2.0e5, 0.3),
     (("impact.sample.loss_tangent=0.05", "effects.impact.normal_dissipative.end=gap"), 8.0e6, 0.05),
     (("impact.shape_factor=iterate",), 8.0e6, 0.2)],
)  # fmt: skip
def test_a_bag_gives_its_material_back(tmp_path, values, storage_modulus, loss_tangent):
    scene = resolved("impact_rubber_drop", "duration=0.6", *values)
    run_offline(scene, tmp_path / "bag")
    from contact_sim_pkg.rigs.impact.material.bag_impacts import rules_of_bag

    end, shape = rules_of_bag(tmp_path / "bag")
    report = material_report(tmp_path / "bag", Options(end=end, shape=shape, speed_ratio=1.01))
    for estimate in report.estimates:
        assert estimate.storage_modulus.value == pytest.approx(storage_modulus, rel=1e-8)
        assert estimate.loss_tangent.value == pytest.approx(loss_tangent, rel=1e-8)


def test_a_hundred_noisy_drops_give_their_material_back(tmp_path):
    values = ("impact.repeats=100", "impact.period=0.5", "impact.bounces=1", "duration=50.0", "outputs.force_rate=100")
    effects = "effects.impact={normal_elastic: {}, normal_dissipative: {}, gauge_noise: {}}"
    run_offline(resolved("impact_rubber_drop", *values, effects), tmp_path / "bag")
    (estimate,) = material_report(tmp_path / "bag", Options()).estimates
    assert estimate.impacts == 100
    assert estimate.storage_modulus.value == pytest.approx(8.0e6, rel=0.01)
    assert estimate.loss_tangent.value == pytest.approx(0.2, rel=0.02)


def test_a_bag_without_impacts_is_refused(tmp_path):
    run_offline(resolved("impact_rubber_drop", "duration=0.1"), tmp_path / "early")
    with pytest.raises(MaterialError, match="holds no impact that ended"):
        impacts_of_bag(tmp_path / "early")
    run_offline(resolved("seat_ride", "duration=0.1"), tmp_path / "seat")
    with pytest.raises(MaterialError, match="has no impact events"):
        impacts_of_bag(tmp_path / "seat")


def test_the_sweep_takes_each_temperature_at_each_speed_and_catches_the_ball():
    values = ("impact.temperatures=[263.15,293.15]", "impact.repeats=2", "duration=6.0")
    e = events_of(run("impact_temperature_sweep", *values)[1])
    assert e["release"].tolist() == list(range(12))
    assert e["temperature"].tolist() == [263.15] * 6 + [293.15] * 6
    assert e["speed"] == pytest.approx([0.5, 0.5, 1.0, 1.0, 2.0, 2.0] * 2, rel=1e-12)
    cold, warm = e["storage_modulus"][4], e["storage_modulus"][10]
    assert warm == pytest.approx(8.0e6, rel=1e-12)  # table at its own speed
    assert cold > 3.0 * warm


def test_releases_outside_the_model_are_refused_before_the_run():
    for values, sentence in (
        (("impact.speeds=[80.0]",), "depth over radius"),
        (("effects.impact.normal_dissipative.end=gap", "impact.sample.loss_tangent=0.5"), r"up to 0\.403733 only"),
        (("effects.impact.shift={}", "impact.temperatures=[150.0]"), "WLF has its pole"),
        (("effects.impact.shift={}", "impact.temperatures=[500.0]"), "beyond: keep"),
    ):
        with pytest.raises(SceneError, match=sentence):
            make_simulation(resolved("impact_rubber_drop", *values))


def test_a_bounce_outside_the_table_ends_the_run_with_its_impact_named():
    simulation = make_simulation(
        resolved("impact_rubber_drop", "effects.impact.shift={}", "impact.temperatures=[400.0]", "impact.speeds=[2.0]")
    )

    def whole_run():
        for block in range(simulation.blocks):
            simulation.advance(block, {})

    with pytest.raises(RunError, match=r"impact 1 at .* of the table of the shift"):
        whole_run()


@pytest.mark.parametrize("loss_tangent", [0.0, 3.0, 100.0])
def test_a_sample_without_loss_and_one_that_never_lets_go_run(loss_tangent):
    _scene, messages = run("impact_rubber_drop", f"impact.sample.loss_tangent={loss_tangent}", "duration=0.5")
    ledger = of(messages, "bench/energy", EnergyLedger)
    assert max(abs(each.residual) for each in ledger) < 1e-12 * 0.04


@pytest.mark.parametrize(
    "values",
    [
        ("impact.period=0.001", "impact.repeats=100"),
        ("impact.period=0.205", "impact.repeats=2"),
        ("impact.period=0.2", "impact.repeats=2", "impact.bounces=2"),
        ("impact.machine=pendulum", "impact.period=0.5", "impact.speeds=[0.1,2]"),
    ],
)
def test_a_period_without_room_for_an_impact_is_refused_with_the_one_that_works(values):
    """At least the fall, 2 m/s over 9.81 m/s^2, and the impact of 1.8 ms; or a swing of a quarter period."""
    with pytest.raises(SceneError, match=r"impact\.period: .* until .* over; make the period .* s or longer") as caught:
        make_simulation(resolved("impact_rubber_drop", *values))
    smallest = float(str(caught.value).split("make the period ")[1].split()[0])
    assert smallest > 2.0 / 9.81
    enough = f"impact.period={smallest}"
    duration = f"duration={math.ceil(200.0 * smallest) / 100.0}"
    _, messages = run("impact_rubber_drop", *values, enough, "impact.bounces=1", duration)
    assert [int((events_of(messages)["release"] == release).sum()) for release in (0, 1)] == [1, 1]


def test_a_period_in_which_the_ball_is_caught_before_its_second_impact_is_over_is_allowed_and_counted():
    values = ("impact.period=0.3", "impact.repeats=2", "impact.bounces=2", "duration=0.6")
    _, messages = run("impact_rubber_drop", *values)
    seen = SimpleNamespace(events=SimpleNamespace(**events_of(messages)))
    (sentence,) = missing_impacts(seen, resolved("impact_rubber_drop", *values).data)
    assert sentence.startswith("2 of 4 impacts took place (2 releases, 2 of each)")


def test_impacts_that_did_not_take_place_are_counted_and_said():
    """Of three releases 0.3 s apart two strike in 0.6 s, each first after the fall of 0.2039 s."""
    scene = resolved("impact_rubber_drop", "impact.period=0.3", "impact.repeats=3", "duration=0.6").data
    _, messages = run("impact_rubber_drop", "impact.period=0.3", "impact.repeats=3", "duration=0.6")
    seen = SimpleNamespace(events=SimpleNamespace(**events_of(messages)))
    (sentence,) = missing_impacts(seen, scene)
    assert sentence.startswith(
        "2 of 3 impacts took place (3 releases, 1 of each): make duration or impact.period longer"
    )
    assert missing_impacts(seen, resolved("impact_rubber_drop").data) == []
    assert missing_impacts(None, resolved("impact_rubber_drop").data)[0].startswith("0 of 1 impacts")
    assert missing_impacts(None, resolved("seat_ride").data) == []
