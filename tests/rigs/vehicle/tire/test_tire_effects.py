"""The effects of a richer tire in whole runs: balance at rest, the ledger, and what each effect must bring about."""

import numpy
import pytest
from tests.rigs.vehicle.test_simulation import messages_of
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import (
    BodyMotion,
    ContactForce,
    ContactPatch,
    ContactShear,
    EnergyLedger,
    WrenchStamped,
)

GRAVITY = 9.81
WEIGHT = 340.0 * GRAVITY  # wheel and body of the shipped tire scenes
FLAT = ("road={kind: flat}", "duration=0.2")
EFFECTS = ("rigid_ring", "tread_viscoelasticity")
ALL = tuple(f"effects.tire.{name}={{}}" for name in EFFECTS)
COULOMB = (
    "effects.tire.brush={coefficient_static: 1, coefficient_kinetic: 0.75, sliding_speed: 0, "
    "load_exponent: 0, load_exponent_across: 0}"
)


def forces(found, field="normal"):
    return numpy.concatenate([getattr(decode(ContactForce, data), field) for data in found["tire/force"]])


@pytest.mark.parametrize("effects", [ALL[:1], ALL[1:], ALL], ids=lambda chosen: "+".join(chosen))
def test_a_tire_on_a_flat_road_stands_still_under_its_weight(effects):
    found = messages_of(resolved("tire_bump", *FLAT, "travel.speed=0", "accuracy=1e-3", *effects))
    assert forces(found) == pytest.approx(WEIGHT, rel=2e-3)
    motion = [decode(BodyMotion, data) for data in found["bench/motion"]]
    assert max(abs(block.velocity).max() for block in motion) < 3e-3


HALF_SPACE = [("effects.tire.envelopment={}",), (*ALL, "effects.tire.envelopment={}")]


@pytest.mark.parametrize("effects", HALF_SPACE, ids=lambda chosen: "+".join(chosen))
def test_a_half_space_tire_on_a_flat_road_stands_still_under_its_weight(effects):
    found = messages_of(resolved("tire_half_space", *FLAT, "travel.speed=0", "accuracy=1e-3", *effects))
    assert forces(found) == pytest.approx(WEIGHT, rel=2e-3)
    motion = [decode(BodyMotion, data) for data in found["bench/motion"]]
    assert max(abs(block.velocity).max() for block in motion) < 3e-3


def test_the_belt_stands_between_road_and_wheel_as_two_springs_in_series():
    scene = resolved("tire_bump", *FLAT, "effects.tire.rigid_ring={stiffness: 1000000, belt_mass: 10}")
    motion = decode(BodyMotion, messages_of(scene, 1)["bench/motion"][0])
    height = dict(zip(motion.bodies, motion.position[:, 0], strict=True))
    assert motion.bodies == ("wheel_z", "body_z", "belt_z")
    assert height["belt_z"] - height["wheel_z"] == pytest.approx(330.0 * GRAVITY / 1000000.0, rel=1e-9)
    assert height["wheel_z"] - height["body_z"] == pytest.approx(300.0 * GRAVITY / 20000.0, rel=1e-9)


def test_the_ledger_closes_with_a_belt_and_impulses():
    found = messages_of(
        resolved("tire_bump", "duration=1.3", "effects.tire.rigid_ring={}", "effects.tire.asperity_impulses={}")
    )
    ledger = [decode(EnergyLedger, data) for data in found["bench/energy"]]
    moved = max(abs(entry.supplied) + entry.dissipated for entry in ledger)
    assert moved > 50.0
    assert max(abs(entry.residual) for entry in ledger) < 1e-4 * moved


def test_a_belt_softens_the_shock_of_a_bump():
    stiff = forces(messages_of(resolved("tire_half_space", "duration=1.3")))
    soft = forces(messages_of(resolved("tire_half_space", "duration=1.3", "effects.tire.rigid_ring={}")))
    assert soft.max() < 0.9 * stiff.max()


def test_impulses_carry_their_share_of_the_load_on_an_even_road():
    # 0.02 m apart under a footprint of 0.092 m: 4 or 5 sites act, on average contact length over spacing
    scene = resolved("tire_half_space", *FLAT, "travel.speed=9.7", "effects.tire.asperity_impulses={share: 0.2}")
    found = messages_of(scene)
    impulses = forces(found, "impulses")
    step = 0.2 * WEIGHT * 0.02 / (2.0 * 0.0460556)  # Hertz: semi-axis along the road of 3335 N
    assert set(numpy.round(impulses / step, 3)) == {4.0, 5.0}
    assert impulses.mean() == pytest.approx(0.2 * WEIGHT, rel=0.02)
    wrench = decode(WrenchStamped, found["tire/wrench"][3]).wrench
    assert wrench.force.z == pytest.approx(forces(found)[30] + impulses[30])


def test_the_mean_load_of_the_irregular_road_is_the_weight_with_its_asperities(tmp_path):
    """The asperities carry a tenth of the weight beside the contact."""
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.report.reading import read_recording
    from contact_sim_pkg.rigs.vehicle.tire.report.metrics import tire_metrics
    from contact_sim_pkg.run.offline import run_offline

    run_offline(resolved("tire_irregular_road"), tmp_path / "bag")
    recording = read_recording(open_bag(tmp_path / "bag"))
    metrics = {each.key: each for each in tire_metrics(recording)}
    assert metrics["tire.load"].value == pytest.approx(WEIGHT, rel=0.01)
    assert metrics["tire.load"].verdict == "met"
    assert recording.contacts["tire"].normal.mean() == pytest.approx(0.9 * WEIGHT, rel=0.02)


def test_impulses_do_not_push_a_tire_that_is_off_the_road():
    found = messages_of(resolved("tire_bump", "duration=1.4", "road.height=0.1", "effects.tire.asperity_impulses={}"))
    normal, impulses = forces(found), forces(found, "impulses")
    assert (normal == 0.0).any()
    approach = forces(found, "approach")
    assert not impulses[approach < 0.0].any()


def test_a_scene_without_impulses_has_no_samples_of_them():
    found = messages_of(resolved("tire_bump", *FLAT), 2)
    assert forces(found, "impulses").size == 0


def test_a_viscoelastic_tread_drags_and_an_elastic_one_does_not():
    rolling = (*FLAT, "travel.speed=5", "outputs.field_rate=500")
    centre = {}
    for name, effects in (("elastic", ()), ("memory", ALL[1:])):
        found = messages_of(resolved("tire_bump", *rolling, *effects))
        patches = [decode(ContactPatch, data) for data in found["tire/patch"]][50:]
        centre[name] = numpy.mean([patch.centre_x for patch in patches])
    assert abs(centre["elastic"]) < 2e-4
    assert centre["memory"] > 1e-3  # the pressure stands ahead of the axle: a moment against the rolling


def test_a_flat_road_in_a_steady_turn_gives_what_the_brush_gives_and_the_forces_carry_it():
    found = messages_of(resolved("tire_bump", *FLAT, COULOMB, "slip={longitudinal: -0.01, angle: 0.02}"))
    shears = [decode(ContactShear, data) for data in found["tire/shear"]]
    patch, shear = decode(ContactPatch, found["tire/patch"][-1]), shears[-1]
    cell = shear.cell_x * shear.cell_y
    assert shear.shear_x.astype(float).sum() * cell == pytest.approx(shear.force_x, rel=1e-5)
    assert shear.shear_y.astype(float).sum() * cell == pytest.approx(shear.force_y, rel=1e-5)
    assert shear.force_x < 0.0  # braking
    assert shear.force_y < 0.0  # a positive slip angle: the wheel drifts to the left
    assert shear.moment_z > 0.0  # and is turned into its velocity
    assert numpy.array_equal(shear.state > 0, patch.pressure > 0.0)
    size = numpy.hypot(shear.shear_x, shear.shear_y)
    assert (size <= 1.0 * patch.pressure * (1.0 + 1e-5)).all()
    assert size[shear.state == 2] == pytest.approx(0.75 * patch.pressure[shear.state == 2], rel=1e-5)
    block = decode(ContactForce, found["tire/force"][-1])
    at_field = len(block.tangential) // (len(found["tire/shear"]) // len(found["tire/force"]))
    assert block.tangential[-at_field] == shear.force_x
    wrench = decode(WrenchStamped, found["tire/wrench"][-1]).wrench
    assert (wrench.force.x, wrench.force.y, wrench.torque.z) == (shear.force_x, shear.force_y, shear.moment_z)


def test_a_locked_wheel_slides_everywhere():
    found = messages_of(resolved("tire_bump", *FLAT, COULOMB, "slip={longitudinal: -1}"))
    shear = decode(ContactShear, found["tire/shear"][-1])
    assert shear.sliding_share == 1.0
    assert shear.force_x == pytest.approx(-0.75 * WEIGHT, rel=5e-3)


def test_what_is_off_changes_nothing():
    # Equal coupling steps: bristles take shorter ones
    rates = ("outputs.field_rate=1000", "outputs.force_rate=1000")
    plain = messages_of(resolved("tire_bump", *FLAT, *rates), 5)
    rubbing = messages_of(resolved("tire_bump", *FLAT, *rates, "effects.tire.brush={}"), 5)
    for topic in ("tire/patch", "bench/motion", "bench/energy"):
        assert plain[topic] == rubbing[topic]


@pytest.mark.parametrize("height", [-0.5, -0.1])
def test_a_wheel_that_rolls_off_an_edge_is_not_kicked(height):
    road = f"road={{kind: step, position: 5, height: {height}}}"
    coarse = forces(messages_of(resolved("tire_bump", "duration=1.2", road)))
    fine = forces(messages_of(resolved("tire_bump", "duration=1.2", road, "outputs.field_rate=1000")))
    assert coarse.max() == pytest.approx(fine.max(), rel=0.15)
    assert numpy.argmax(coarse) == pytest.approx(numpy.argmax(fine), abs=20)  # [ms] when it lands, not when it leaves
