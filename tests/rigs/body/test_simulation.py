"""Runs of the rig block: what the bag of a scene holds, that it adds up, and what its motion
tells.
"""

import json
import math
import re

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.records.messages import (
    BodyMotion,
    ContactForce,
    ContactPoints,
    EnergyLedger,
    SolverCost,
    WrenchStamped,
)
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.rigs import make_simulation, result_topics
from contact_sim_pkg.scene.errors import SceneError

GRAVITY = 9.81
SCENES = ("block_fall", "block_slope", "block_zeno", "block_painleve", "block_identify")


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


def rows(messages):
    """Names, positions and velocities [coordinates, samples] of `bench/motion`."""
    blocks = of(messages, "bench/motion", BodyMotion)
    parts = [numpy.concatenate([getattr(b, name) for b in blocks], axis=1) for name in ("position", "velocity")]
    return blocks[0].bodies, *parts


@pytest.mark.parametrize("name", SCENES)
def test_a_run_publishes_what_its_scene_lists_and_loses_no_energy_unnoticed(name):
    scene, messages = run(name)
    assert {topic for topic, _stamp, _data in messages} == set(result_topics(scene))
    ledgers = of(messages, "bench/energy", EnergyLedger)
    totals = numpy.array([ledger.kinetic + ledger.potential for ledger in ledgers])
    size = max(abs(totals).max(), 1e-3)
    assert numpy.diff(totals).max() <= 1e-6 * size
    assert max(abs(ledger.residual) for ledger in ledgers) <= 1e-3 * size
    assert max(cost.field_residual for cost in of(messages, "bench/cost", SolverCost)) <= 1e-9


def test_the_ledger_holds_the_work_of_a_known_torque_on_a_box_in_flight():
    _scene, messages = run("box_3d_tumble", "duration=0.5", "block.position=[0,0,20]", "block.torque=[0.5,0,0.3]")
    ledgers = of(messages, "bench/energy", EnergyLedger)
    assert abs(ledgers[-1].supplied) > 0.1
    assert max(abs(ledger.residual) for ledger in ledgers) <= 1e-5 * abs(ledgers[-1].supplied)


@pytest.mark.fault("D5")
def test_the_ball_rests_at_once_after_the_geometric_series_and_presses_with_its_weight():
    _scene, messages = run("block_zeno")
    names, position, velocity = rows(messages)
    rest = math.ceil(1e3 * math.sqrt(2.0 / GRAVITY) * 9.0)
    assert names[2] == "block_z"
    assert not velocity[:, rest:].any()
    assert position[2, rest:] == pytest.approx(numpy.full(position.shape[1] - rest, 0.05), abs=1e-12)
    force = numpy.concatenate([block.normal for block in of(messages, "block/force", ContactForce)])
    assert force[rest:] == pytest.approx(numpy.full(len(force) - rest, GRAVITY), rel=1e-9)
    wrench = of(messages, "block/wrench", WrenchStamped)[-1]
    assert wrench.wrench.force == pytest.approx((0.0, 0.0, GRAVITY), abs=1e-9)


def test_the_block_climbs_as_far_as_friction_and_weight_let_it_and_then_sticks():
    _scene, messages = run("block_slope")
    _names, position, velocity = rows(messages)
    angle = math.radians(15.0)
    climbed = 1.0 / (2.0 * GRAVITY * (math.sin(angle) + 0.3 * math.cos(angle)))
    assert numpy.linalg.norm(position[:2, -1] - position[:2, 0]) == pytest.approx(climbed, rel=1e-9)
    assert not velocity[:, -1].any()
    points = of(messages, "block/points", ContactPoints)
    assert sorted(points[0].state) == [0, 0, 3, 3]
    assert sorted(points[-1].state) == [0, 0, 2, 2]


def test_a_point_that_sticks_in_its_impact_is_said_to():
    """A ball that falls straight down sticks; one that moves on after its impact slips."""
    for velocity, state in ((0.0, 2), (20.0, 3)):
        _scene, messages = run("block_zeno", f"block.velocity=[{velocity},0,0]", "duration=0.5")
        points = of(messages, "block/points", ContactPoints)
        assert {int(value) for each in points for value in each.state} == {0, state}


COMPLIANT = "effects.block.compliant_contact={}"


@pytest.mark.parametrize("name", ["block_fall", "block_slope", "box_3d_tumble"])
def test_the_compliant_twin_of_a_scene_publishes_the_same_topics_and_closes_its_ledger(name):
    scene, messages = run(name, COMPLIANT, "duration=1.0")
    assert {topic for topic, _stamp, _data in messages} == set(result_topics(scene))
    ledgers = of(messages, "bench/energy", EnergyLedger)
    totals = numpy.array([ledger.kinetic + ledger.potential + ledger.stored for ledger in ledgers])
    size = abs(totals).max()
    assert numpy.diff(totals).max() <= 1e-9 * size
    assert max(abs(ledger.residual) for ledger in ledgers) <= 1e-4 * size


def test_the_compliant_twin_tends_to_the_rigid_scene_as_it_gets_stiffer():
    place = rows(run("block_slope")[1])[1][:2, -1]
    errors = []
    for stiffness in (1e4, 1e5, 1e6):
        law = f"effects.block.compliant_contact={{stiffness: {stiffness:.0f}, tangential_stiffness: {stiffness:.0f}}}"
        errors.append(float(numpy.linalg.norm(rows(run("block_slope", law)[1])[1][:2, -1] - place)))
    assert errors[0] < 1e-2
    assert errors[1] < 0.2 * errors[0]
    assert errors[2] < 0.2 * errors[1]


def test_a_compliant_contact_refuses_what_only_impulses_have():
    with pytest.raises(SceneError, match=r"rule: newton has no meaning with compliant_contact.*take energetic"):
        resolved("block_fall", COMPLIANT, "effects.block.rigid_contact.rule=newton")


def test_a_scheme_of_fixed_steps_is_refused_with_what_takes_its_place():
    for key in ("scheme=stepping", "step=0.001"):
        with pytest.raises(
            SceneError, match=r"was removed; write nothing \(contact events are always located in time\)"
        ):
            resolved("block_fall", f"effects.block.rigid_contact.{key}")


def test_a_sphere_rolls_over_a_ground_of_heights():
    heights = [0.0] * 20 + [0.0, 0.01, 0.02, 0.03] + [0.03] * 20
    _scene, messages = run(
        "block_zeno", f"block.ground.heights={heights}", "block.ground.start=-1.0", "block.position=[0.0,0,0.1]",
        "block.velocity=[1.0,0,0]", "effects.block.rigid_contact.restitution=0", "duration=0.5",
    )  # fmt: skip
    _names, position, velocity = rows(messages)
    assert position[2, -1] == pytest.approx(0.08, abs=1e-3)
    assert 0.0 < velocity[0, -1] < 5.0 / 7.0


def test_a_body_that_starts_in_the_ground_is_refused_with_the_rise():
    sentence = r"block\.position: puts the body into the ground at the start; raise its z by 0\.05 m"
    with pytest.raises(SceneError, match=sentence):
        resolved("block_zeno", "block.position=[0,0,0]")


@pytest.mark.parametrize("ground", ["{slope: 1.2}", "{heights: [-0.3, 0, -0.2, 0.1], start: -0.05}"])
@pytest.mark.parametrize("scene", ["block_fall", "block_zeno", "box_3d_tumble"])
def test_a_body_raised_by_what_the_refusal_tells_is_accepted_and_by_less_is_not(scene, ground):
    def placed_at(z):
        resolved(scene, f"block.ground={ground}", f"block.position=[0, 0, {z!r}]")

    with pytest.raises(SceneError, match="into the ground") as caught:
        placed_at(-0.1)
    rise = float(re.search(r"raise its z by (\S+) m", str(caught.value)).group(1))
    placed_at(-0.1 + rise)
    with pytest.raises(SceneError, match="into the ground"):
        placed_at(-0.1 + 0.999 * rise)


@pytest.mark.parametrize(
    ("name", "value", "sentence"),
    [
        (
            "block_slope",
            "block.ground={slope: 0.1, heights: [0, 0]}",
            r"block\.ground\.slope: 0\.1 rad has no meaning beside heights",
        ),
        ("block_fall", "effects.block.rigid_contact.facets=8", r"facets: 8 has no meaning in the plane"),
        (
            "block_fall",
            "block.position=[0, 0]",
            r"block\.position: a list of 2 cannot stand here; allowed are three numbers",
        ),
    ],
)
def test_keys_without_meaning_and_lists_of_another_length_are_refused(name, value, sentence):
    with pytest.raises(SceneError, match=sentence):
        resolved(name, value)


@pytest.mark.parametrize("key", ["position", "rotation", "velocity", "angular_velocity", "force", "torque"])
def test_a_vector_beyond_all_sense_is_refused(key):
    with pytest.raises(SceneError, match=rf"block\.{key}.*1e\+300.*1e"):
        resolved("block_fall", f"block.{key}=[0, 1e+300, 0]")


def identified(capsys, folder, *values, options=()):
    outcome = run_offline(resolved("block_identify", *values), folder)
    assert outcome is not None
    assert main(["identify", str(folder), "--box", "0.1", "0.1", "0.1", "--json", *options]) == 0
    facts = json.loads(capsys.readouterr().out)
    return facts, {row["parameter"]: row for row in facts["parameters"]}


def test_the_bag_of_block_identify_tells_inertia_over_mass_and_names_the_mass(capsys, tmp_path):
    facts, parameters = identified(capsys, tmp_path / "bag")
    assert parameters["m/J"]["value"] == pytest.approx(6.0 / 0.1**2, rel=1e-9)
    assert "m" not in parameters
    assert any(
        line.startswith("mass is not identifiable without an external force") for line in facts["not_identifiable"]
    )


def test_the_identified_impulses_are_those_that_the_contacts_gave(capsys, tmp_path):
    facts, _parameters = identified(capsys, tmp_path / "bag")
    _scene, messages = run("block_identify")
    force = of(messages, "block/force", ContactForce)
    normal, tangential = (
        numpy.concatenate([getattr(b, name) for b in force]) * 1e-3 / 1.3 for name in ("normal", "tangential")
    )
    hits = numpy.flatnonzero(normal)
    assert len(hits) == len(facts["contacts"])
    for contact, sample in zip(facts["contacts"], hits, strict=True):
        assert contact["normal_impulse_over_mass_m_s"] == pytest.approx(normal[sample], rel=1e-9)
        assert contact["impulse_over_mass_m_s"][0] == pytest.approx(tangential[sample], rel=1e-9)


def test_with_a_known_force_the_mass_is_identified(capsys, tmp_path):
    _facts, parameters = identified(
        capsys, tmp_path / "bag", "block.force=[1.3,0,0.7]", options=("--force", "1.3", "0", "0.7")
    )
    assert parameters["m"]["value"] == pytest.approx(1.3, rel=1e-9)


def test_a_box_that_falls_in_space_tells_its_three_moments_over_mass(capsys, tmp_path):
    run_offline(resolved("box_3d_tumble", "duration=0.65"), tmp_path / "bag")
    assert main(["identify", str(tmp_path / "bag"), "--box", "0.2", "0.3", "0.1", "--json"]) == 0
    found = {row["parameter"]: row for row in json.loads(capsys.readouterr().out)["parameters"]}
    expected = sorted((0.09 + 0.01, 0.04 + 0.01, 0.04 + 0.09))
    for name, value in zip(("smallest", "middle", "largest"), expected, strict=True):
        assert found[f"{name} principal I0/m"]["value"] == pytest.approx(value / 12.0, rel=1e-7)


def test_the_approach_of_a_falling_ball_is_minus_its_height():
    """`-(h - g t^2 / 2)`, h = 1 m, until it touches; as in every rig negative apart."""
    _scene, messages = run("block_zeno", "duration=0.4")
    approach = numpy.concatenate([block.approach for block in of(messages, "block/force", ContactForce)])
    times = 0.4 / len(approach) * numpy.arange(len(approach))
    assert approach == pytest.approx(0.5 * GRAVITY * times**2 - 1.0, abs=1e-12)


def test_the_page_of_a_rigid_contact_draws_no_force_over_its_approach(tmp_path):
    run_offline(resolved("block_zeno", "duration=0.6"), tmp_path / "bag")
    assert main(["report", str(tmp_path / "bag")]) == 0
    page = (tmp_path / "bag" / "report.html").read_text()
    assert "Normal force and approach of the block contact over time" in page
    assert "Normal force of the block contact over its approach" not in page


VALLEYS = ("block.ground.heights=[0.1,0,0.1,0.3,0.2,0]", "block.ground.start=-0.5", "block.ground.distance=0.25")


def test_a_ball_that_falls_into_a_valley_of_heights_ends_its_run():
    _scene, messages = run("block_zeno", *VALLEYS, "duration=2", "block.velocity=[0.3,0.1,0]")
    ledgers = of(messages, "bench/energy", EnergyLedger)
    totals = numpy.array([ledger.kinetic + ledger.potential for ledger in ledgers])
    assert numpy.diff(totals).max() <= 1e-9


@pytest.mark.parametrize(
    "values",
    [
        ("block.motion=plane", "block.shape=box"),
        ("block.motion=plane", "block.shape=points", "block.points=[[-0.05,-0.04],[0.05,-0.04],[0,0.06]]"),
        ("block.motion=plane", "block.shape=sphere"),
        ("block.motion=space", "block.shape=box"),
        ("block.motion=space", "block.shape=points", "block.points=[[0,0,0],[0.1,0,0],[0,0.1,0],[0,0,0.1]]"),
        ("block.motion=space", "block.shape=sphere"),
    ],
)
@pytest.mark.parametrize("ground", [(), ("block.ground.slope=0.2",), VALLEYS])
def test_every_body_runs_over_every_ground(values, ground):
    _scene, messages = run(
        "block_fall", *values, *ground, "duration=0.75", "block.position=[0,0,0.5]", "block.rotation=[0,0.2,0]"
    )
    ledgers = of(messages, "bench/energy", EnergyLedger)
    totals = numpy.array([ledger.kinetic + ledger.potential for ledger in ledgers])
    assert numpy.diff(totals).max() <= 1e-6
    depth = max(block.approach.max() for block in of(messages, "block/force", ContactForce))
    if ground == VALLEYS and "block.motion=space" in values and "block.shape=sphere" not in values:
        # in space the corners alone of a box or hull meet heights, so that a peak goes into its
        # faces
        return
    assert depth <= 1e-7


def test_a_compliant_ball_bounces_on_a_peak_sharper_than_a_right_angle():
    """A mass on a spring while it touches, `y = g/w^2 (cos wt - 1) - v/w sin wt`; it rises at the
    speed that it came with.
    """
    drop, stiffness, duration = 0.1, 1e5, 0.25
    _scene, messages = run(
        "block_zeno", "block.ground={heights: [0, 0.2, 0], start: -0.1, distance: 0.1}",
        f"block.position=[0, 0, {0.25 + drop}]", "effects.block.rigid_contact.restitution=1",
        "effects.block.rigid_contact.friction=0", f"effects.block.compliant_contact={{stiffness: {stiffness}}}",
        f"duration={duration}", "accuracy=1e-6",
    )  # fmt: skip
    _names, position, _velocity = rows(messages)
    speed, swing = math.sqrt(2.0 * GRAVITY * drop), math.sqrt(stiffness)
    pressed = 2.0 * (math.pi - math.atan(speed * swing / GRAVITY)) / swing
    rising = numpy.arange(position.shape[1]) * duration / position.shape[1] - speed / GRAVITY - pressed
    after = rising > 0.0
    assert after.sum() > 20
    height = 0.25 + speed * rising[after] - 0.5 * GRAVITY * rising[after] ** 2
    assert position[2, after] == pytest.approx(height, abs=1e-9)
    assert abs(position[0]).max() < 1e-9


def _wrenches_over_heights(heights, *values):
    ground = (f"block.ground.heights={list(heights)}", "block.ground.start=-1", "block.ground.distance=1")
    _scene, messages = run("block_zeno", *ground, *values)
    found = of(messages, "block/wrench", WrenchStamped)
    return tuple(numpy.array([getattr(each.wrench, name) for each in found]) for name in ("force", "torque"))


def test_a_ball_that_rests_in_a_valley_is_pushed_up_with_its_weight():
    """Each face gives m g / (2 cos a), along its own normal."""
    ball = ("block.position=[0,0,0.06]", "effects.block.rigid_contact.restitution=0", "duration=0.5")
    force, torque = _wrenches_over_heights((0.2, 0.0, 0.2), *ball)
    assert force[-1] == pytest.approx((0.0, 0.0, GRAVITY), abs=1e-9)
    assert torque[-1] == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize("motion", ["plane", "space"])
def test_the_wrench_of_a_ball_that_rolls_down_a_slope_of_heights_is_that_of_rolling(motion):
    """In world axes: N = m g cos a along the normal, friction 2/7 m g sin a up the slope, and its
    moment R about the centre.
    """
    angle, radius = math.atan(0.2), 0.05
    height = radius / math.cos(angle)
    ball = (
        f"block.position=[0,0,{height!r}]", "block.velocity=[0,0,0]", "effects.block.rigid_contact.restitution=0",
        "duration=0.3", f"block.motion={motion}",
    )  # fmt: skip
    force, torque = _wrenches_over_heights((-0.2, 0.0, 0.2), *ball)
    along, normal = (
        numpy.array([math.cos(angle), 0.0, math.sin(angle)]),
        numpy.array([-math.sin(angle), 0.0, math.cos(angle)]),
    )
    friction = 2.0 / 7.0 * GRAVITY * math.sin(angle)
    assert force[-1] == pytest.approx(GRAVITY * math.cos(angle) * normal + friction * along, abs=1e-9)
    assert torque[-1] == pytest.approx((0.0, -friction * radius, 0.0), abs=1e-9 * radius)


def test_a_box_that_tumbles_above_heights_feels_no_wrench():
    """Its momentum changes by its weight alone, its angular momentum not at all, though its spin
    does.
    """
    _scene, messages = run(
        "box_3d_tumble",
        "duration=0.5",
        "block.position=[0,0,20]",
        "block.ground.heights=[0,0.1]",
        "block.velocity=[1,0,0]",
    )
    _names, _position, velocity = rows(messages)
    assert numpy.ptp(velocity[3:], axis=1).max() > 1.0
    for wrench in of(messages, "block/wrench", WrenchStamped):
        assert wrench.wrench.force == pytest.approx((0.0, 0.0, 0.0), abs=1e-8)
        assert wrench.wrench.torque == pytest.approx((0.0, 0.0, 0.0), abs=1e-8)


def test_a_box_that_rolls_over_its_edges_has_the_forces_of_the_requested_accuracy():
    """An error of a turn on active points comes back many times greater from the impacts
    behind it.
    """
    found, tight = (
        numpy.concatenate(
            [
                each.normal
                for each in of(
                    run("box_3d_tumble", "duration=1.2", f"accuracy={tolerance}")[1], "block/force", ContactForce
                )
            ]
        )
        for tolerance in (1e-3, 1e-8)
    )
    assert tight.max() > 100.0
    assert numpy.abs(found - tight).max() <= 1e-3 * tight.max()
