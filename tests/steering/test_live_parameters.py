"""Parameters that change between two blocks of a run: whole, or refused and the run unharmed."""

import re
from pathlib import Path

import numpy
import pytest

from contact_sim_pkg import ContactBench, load_scene, run
from contact_sim_pkg.bag.block_encoder import encode_block
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.excitation.blocks import AHEAD
from contact_sim_pkg.excitation.changed_road import CHANGE_LENGTH
from contact_sim_pkg.report.facts import warnings_of
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.rigs.vehicle.run.bodies import Bodies
from contact_sim_pkg.run.from_bag import changes_from_bag, refuse_steered, sources_from_bag
from contact_sim_pkg.run.live_parameters import RAMP, Change, ParameterError, parameters_of
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.load import shipped_names
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import read_explicit
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.catalog import catalog, without_kinds

INFLATION, FRICTION = "effects.tire.inflation.pressure", "effects.block.rigid_contact.friction"
ROUGH = ("road={kind: iso8608, roughness: 64e-6}", "travel={speed: 20}")
LOSS = "effects={seat: {normal_elastic: {}, normal_dissipative: {}}}"
GENERAL = "effects={seat: {normal_elastic: {}, general_dissipative: {}}}"
BACK_GENERAL = ("effects={backrest: {normal_elastic: {}, general_dissipative: {}}}",)
BACK = ("effects={backrest: {normal_elastic: {}, normal_dissipative: {}}}", "backrest.sliding.amplitude=0")

CASES = [
    ("tire_bump", (), 55, 10, {INFLATION: 180e3}),
    ("tire_cleat", (), 80, 6, {INFLATION: 180e3, "effects.tire.rigid_ring.stiffness": 9e5}),
    ("car_full_bench", (), 10, 8, {INFLATION: 180e3}),
    ("tire_cleat", (), 80, 6, {"effects.tire.rigid_ring.damping": 400.0}),
    ("tire_bump", (), 55, 10, {"tire.suspension_damping": 500.0}),
    ("tire_bump", (), 55, 10, {"tire.suspension_stiffness": 30e3}),
    ("tire_bump", (), 55, 10, {"tire.wheel_mass": 50.0, "tire.body_mass": 350.0}),
    ("tire_bump", (), 55, 10, {"travel.speed": 8.0}),
    ("tire_bump", (), 55, 10, {"effects.tire.normal_dissipative.damping": 0.05}),
    ("tire_bump", ROUGH, 10, 10, {"road.roughness": 256e-6}),
    ("tire_braking", (), 6, 6, {"effects.tire.brush.coefficient_static": 0.95, "effects.tire.brush.sliding_speed": 2.0}),
    ("tire_braking", (), 6, 6, {"effects.tire.brush.coefficient_kinetic": 0.6}),
    ("tire_irregular_road", (), 6, 6, {"road.rms": 1e-3}),
    ("tire_magic_formula", (), 10, 6, {INFLATION: 200e3, "tire.suspension_damping": 500.0}),
    ("seat_ride", (LOSS,), 30, 20, {"effects.seat.normal_elastic.coefficient": 3e5}),
    ("seat_ride", (LOSS,), 30, 20, {"effects.seat.normal_dissipative.damping": 0.4}),
    ("seat_ride", (GENERAL,), 30, 20, {"effects.seat.general_dissipative.coefficient": 2e5}),
    ("seat_ride", (LOSS,), 30, 20, {"seat.occupant.frame_mass": 20.0}),
    ("seat_ride_full", (), 10, 8, {"seat.occupant.frame_mass": 20.0}),
    ("seat_ride_full", (), 10, 8, {"backrest.preload": 40.0, "effects.backrest.normal_dissipative.damping": 1.0}),
    ("suspension_seat", (), 10, 10, {"vibration.scale": 1.5}),
    ("seat_slap", (), 30, 20, {"vibration.amplitude": 6.0}),
    ("seat_slap", (), 30, 20, {"backrest.preload": 300.0, "backrest.mass": 30.0}),
    ("seat_slap", BACK, 30, 20, {"effects.backrest.normal_elastic.coefficient": 2e5}),
    ("seat_slap", BACK, 30, 20, {"effects.backrest.normal_dissipative.damping": 1.0}),
    ("tire_cleat", ("effects.tire.wheel_spin.brake=1", "effects.tire.wheel_spin.drive=1"), 10, 6,
     {"effects.tire.wheel_spin.brake": 300.0, "effects.tire.wheel_spin.drive": 100.0}),
    ("seat_general", BACK_GENERAL, 30, 20, {"effects.backrest.general_dissipative.coefficient": 3e5}),
    ("block_fall", (), 18, 40, {FRICTION: 0.05, "effects.block.rigid_contact.restitution": 0.6}),
]  # fmt: skip
"""Scene, its values, blocks before and behind the change, what changes."""


def bits(outputs):
    return encode_block([each for each in outputs if each.topic != "bench/cost"])


def residuals(outputs):
    """[J] of the energy ledger, block by block."""
    return numpy.array([each.record.residual for each in outputs if each.topic == "bench/energy"])


def ledger(outputs):
    return next(each.record for each in outputs if each.topic == "bench/energy")


def map_less_force(outputs):
    """[N] largest difference of a pressure map and the force of its contact at that instant."""
    worst = 0.0
    for contact in ("tire", "seat"):
        forces = {each.stamp: each.record for each in outputs if each.topic == f"{contact}/force"}
        for each in outputs:
            if each.topic == f"{contact}/patch":
                start = max(stamp for stamp in forces if stamp <= each.stamp)
                sample = round((each.stamp - start) * 1e-9 / forces[start].sample_period)
                worst = max(worst, abs(each.record.load - forces[start].normal[sample]))
    return worst


def benched(scene, values, blocks):
    bench = ContactBench(load_scene(scene, *values))
    assert blocks <= bench.blocks
    return bench


@pytest.mark.parametrize(("scene", "values", "before", "behind", "changes"), CASES)
def test_energy_and_map_are_as_without_a_change(scene, values, before, behind, changes):
    bench = benched(scene, values, before + behind)
    length = bench.block_length
    first = bench.step(before * length).outputs
    saved = bench.save()
    plain = bench.step(behind * length).outputs
    bench.load(saved)
    steered = bench.step(behind * length, parameters=changes).outputs
    assert bits(steered) != bits(plain)
    assert [(each.record.key, each.record.value) for each in steered if each.topic == "bench/steering"] == [
        *changes.items()
    ]
    # The instant of the change: the ledger leaves open what it did
    assert residuals(steered)[0] == pytest.approx(residuals(plain)[0], rel=1e-6, abs=1e-9)
    whole = residuals([*first, *plain])
    size = max(abs(ledger(steered).supplied), abs(ledger(steered).stored), abs(ledger(steered).potential), 1.0)
    assert abs(residuals(steered)).max() <= 5.0 * abs(whole).max() + 1e-7 * size
    assert map_less_force(steered) <= 2.0 * map_less_force([*first, *plain]) + 1e-9


@pytest.mark.parametrize(
    ("scene", "changes"),
    [
        ("tire_bump", {INFLATION: 180e3, "travel.speed": 6.0}), ("seat_slap", {"vibration.amplitude": 6.0}),
        ("block_fall", {FRICTION: 0.05}),
    ],
)  # fmt: skip
def test_before_block_0_it_is_the_scene_with_these_values(scene, changes):
    """With all other keys as they were, those too that once followed from them."""
    bench = ContactBench(scene)
    steps = 6 * bench.block_length
    steered = bench.step(steps, parameters=changes).outputs
    values = [f"{key}={value!r}" for key, value in changes.items()]
    other = read_explicit(bench.scene.to_yaml(), "scene", [set_value(each) for each in values])
    wanted = ContactBench(ResolvedScene(other)).step(steps).outputs
    assert bits([each for each in steered if each.topic != "bench/steering"]) == bits(wanted)


def test_a_stiffer_spring_is_supplied_the_energy_that_it_holds():
    """Half of the change of stiffness times the square of the deflection, which is that of wheel and body."""
    bench = ContactBench("tire_bump")
    bench.step(0.6)
    saved = bench.save()
    plain = bench.step().outputs
    bench.load(saved)
    steered = bench.step(parameters={"tire.suspension_stiffness": 30e3}).outputs
    motion = next(each.record for each in plain if each.topic == "bench/motion")
    wheel, body = (motion.position[motion.bodies.index(name), 0] for name in ("wheel_z", "body_z"))
    energy = 0.5 * (30e3 - bench.scene.data["tire"]["suspension_stiffness"]) * (wheel - body) ** 2
    assert energy > 1.0
    assert ledger(steered).stored - ledger(plain).stored == pytest.approx(energy, rel=1e-6)
    assert ledger(steered).supplied - ledger(plain).supplied == pytest.approx(energy, rel=1e-6)


def test_the_slips_of_a_formula_go_on():
    """On level ground another damper changes no force of the tire, which a slip that began anew would."""
    scene = ("tire_magic_formula", "road={kind: flat}")
    forces: list[list[tuple[float, float]]] = [[], []]
    for made, values in zip(forces, (None, {"tire.suspension_damping": 500.0}), strict=True):
        bench = ContactBench(*scene)
        for count in range(12):
            outputs = bench.step(parameters=values if count == 6 else None).outputs
            made += [(each.record.force_x, each.record.force_y) for each in outputs if each.topic == "tire/shear"]
    plain, steered = numpy.array(forces[0]), numpy.array(forces[1])
    assert abs(plain[-1]).max() > 100.0
    assert steered == pytest.approx(plain, rel=1e-6, abs=1e-3)


def test_a_heavier_body_is_supplied_its_motion_and_its_height():
    """m v^2 / 2 and m g z of the mass that is added."""
    bench = ContactBench("tire_bump")
    bench.step(0.6)
    saved = bench.save()
    plain = bench.step().outputs
    bench.load(saved)
    steered = bench.step(parameters={"tire.body_mass": 350.0}).outputs
    motion = next(each.record for each in plain if each.topic == "bench/motion")
    row = motion.bodies.index("body_z")
    more = 350.0 - bench.scene.data["tire"]["body_mass"]
    kinetic, potential = 0.5 * more * motion.velocity[row, 0] ** 2, more * 9.81 * motion.position[row, 0]
    assert ledger(steered).kinetic - ledger(plain).kinetic == pytest.approx(kinetic, rel=1e-6)
    assert ledger(steered).potential - ledger(plain).potential == pytest.approx(potential, rel=1e-6)
    supplied = ledger(steered).supplied - ledger(plain).supplied
    assert supplied == pytest.approx(kinetic + potential, rel=1e-4)


def test_an_energy_that_is_not_booked_is_seen(monkeypatch):
    """So that the test of all keys is one."""
    bench = ContactBench("tire_bump")
    bench.step(0.6)
    before = residuals(bench.step().outputs)[-1]
    monkeypatch.setattr(Bodies, "supply", lambda self, energy: None)
    assert abs(residuals(bench.step(parameters={INFLATION: 180e3}).outputs)[0] - before) > 1.0


def test_a_speed_goes_up_with_its_ramp():
    """v t + RAMP t^2 / 2 up to the new speed, from the place at the change on."""
    bench = ContactBench("tire_bump", "travel.speed=5")
    bench.step(0.1)
    bench.step(0.5, parameters={"travel.speed": 5.6})
    change = 0.6 / RAMP
    for step in range(10, 60, 7):
        behind = max(0.0, step * 0.01 - 0.1)
        ramp = min(behind, change)
        place = 5.0 * (0.01 * step - (behind - ramp)) + 0.5 * RAMP * ramp**2 + 5.6 * (behind - ramp)
        assert bench._run.sources["road/patch"].block(step).travel_start == pytest.approx(place, rel=1e-12)
    force = bench.step(parameters={"travel.speed": 5.6})  # as it is
    assert len(force["tire/force"].time)


def test_a_road_changes_ahead_of_what_was_seen():
    """Old heights where the wheel has been, the new road's far ahead, 3 s^2 - 2 s^3 between."""
    bench = ContactBench("tire_bump", *ROUGH, "duration=1")
    bench.step(0.3)
    old = bench._run.sources["road/patch"]
    bench.step(parameters={"road.roughness": 256e-6})
    now = bench._run.sources["road/patch"]
    new = make_sources(load_scene("tire_bump", ROUGH[0].replace("64e-6", "256e-6"), ROUGH[1], "duration=1"))[
        "road/patch"
    ]
    edge = old.rows(0.0, max(0.3, AHEAD))[1] * old.cell_x
    y = numpy.array([0.0])

    def heights(source, places):
        return source.surface.heights(numpy.asarray(places), y)[:, 0]

    assert (heights(now, [0.0, 0.5 * edge, edge]) == heights(old, [0.0, 0.5 * edge, edge])).all()
    far = numpy.linspace(edge + CHANGE_LENGTH, edge + 20.0, 40)
    assert (heights(now, far) == heights(new, far)).all()
    quarter = [edge + 0.25 * CHANGE_LENGTH]
    part = 3.0 * 0.25**2 - 2.0 * 0.25**3
    between = (1.0 - part) * heights(old, quarter) + part * heights(new, quarter)
    assert heights(now, quarter) == pytest.approx(between, abs=1e-15)


def test_every_key_is_live_or_has_its_reason():
    for name in shipped_names():
        for key, each in parameters_of(load_scene(name)).items():
            assert bool(each.live) != bool(each.reason), key
            assert not each.live or (each.live in ("excitation", "law") and each.high is not None)
            assert not each.reason or each.reason.startswith(f"{key} is fixed in a run: ")
    entries = [each for each in catalog().values() if each.kind not in ("section", "kinds")]
    ours = [each for each in entries if not each.live and not each.fixed]
    assert not ours


def test_the_page_lists_the_live_keys():
    page = (Path(__file__).parents[2] / "docs" / "steering.md").read_text(encoding="utf-8")
    rows = [line.split("|")[1:3] for line in page.splitlines() if line.endswith(("| excitation |", "| law |"))]
    listed = {key: live.strip() for keys, live in rows for key in re.findall(r"`([^`]+)`", keys)}
    assert listed == {".".join(without_kinds(where)): each.live for where, each in catalog().items() if each.live}


def test_fixed_keys_are_refused_with_their_reason_and_change_nothing():
    bench, beside = ContactBench("block_fall"), ContactBench("block_fall")
    bench.step(0.1), beside.step(0.1)
    for key, each in bench.parameters.items():
        if not each.live:
            with pytest.raises(ParameterError) as refused:
                bench.step(parameters={FRICTION: 0.2, key: 1.0})
            assert str(refused.value) == each.reason
    for values, words in (
        ({FRICTION: 9.0}, "0 to 5"), ({FRICTION: float("nan")}, "friction"), ({FRICTION: "0.2"}, "a number is needed"),
        ({"road.roughness": 1e-6}, f"no key 'road.roughness'; live are {FRICTION}"), ({FRICTION: 0.1, "x": 1.0}, "no key 'x'"),
    ):  # fmt: skip
        with pytest.raises(ParameterError, match=words):
            bench.step(parameters=values)
    assert bench.parameters[FRICTION].value == beside.parameters[FRICTION].value
    assert bits(bench.step(0.3).outputs) == bits(beside.step(0.3).outputs)


def test_a_change_that_the_physics_refuses_leaves_the_run_unharmed(monkeypatch):
    """A frame that loses its mass, a rule between keys, and a field that cannot be solved."""
    bench, beside = ContactBench("seat_ride", LOSS), ContactBench("seat_ride", LOSS)
    bench.step(0.1), beside.step(0.1)
    with pytest.raises(ParameterError, match="other parts"):
        bench.step(parameters={"seat.occupant.frame_mass": 0.0})
    assert bits(bench.step(0.1).outputs) == bits(beside.step(0.1).outputs)
    bench, beside = ContactBench("tire_braking"), ContactBench("tire_braking")
    bench.step(0.02), beside.step(0.02)
    with pytest.raises(ParameterError, match="coefficient_static"):
        bench.step(parameters={"effects.tire.brush.coefficient_static": 0.1})
    assert bits(bench.step(0.02).outputs) == bits(beside.step(0.02).outputs)


def test_a_ring_so_soft_that_no_footprint_forms_is_refused():
    bench = ContactBench("tire_cleat", "duration=0.1")
    first = bits(bench.step().outputs)
    with pytest.raises(ParameterError, match=r"gives way under .* before it has a footprint"):
        bench.step(parameters={"effects.tire.rigid_ring.stiffness": 1e3})
    bench.reset()
    assert bits(bench.step().outputs) == first


def test_a_state_knows_the_parameters_it_was_saved_with():
    bench, other = ContactBench("tire_bump"), ContactBench("tire_bump")
    bench.step(0.1)
    early = bench.save()
    bench.step(0.1, parameters={INFLATION: 180e3, "travel.speed": 6.0})
    late = bench.save()
    rest = bits(bench.step(0.1).outputs)
    other.load(late)
    assert other.parameters[INFLATION].value == 180e3
    assert bits(other.step(0.1).outputs) == rest
    other.load(early)
    assert other.parameters[INFLATION].value == other.scene.data["effects"]["tire"]["inflation"]["pressure"]
    plain = ContactBench("tire_bump")
    plain.step(0.1)
    assert bits(other.step(0.1).outputs) == bits(plain.step(0.1).outputs)
    bench.reset()
    assert bits(bench.step(0.1).outputs) == bits(ContactBench("tire_bump").step(0.1).outputs)


def recorded(path):
    return [
        (message.topic, message.log_time, message.data)
        for message in open_bag(path).messages()
        if not TOPICS[message.topic.lstrip("/")].wall_time
    ]


STEERED = [
    ("tire_bump", ROUGH, {0.1: {INFLATION: 180e3, "travel.speed": 18.0}, 0.15: {"road.roughness": 256e-6}}),
    ("tire_bump", (), {0.1: {"travel.speed": 8.0}, 0.2: {"travel.speed": 12.0}}),
    ("tire_braking", (), {0.0: {"effects.tire.brush.coefficient_static": 1.0}, 0.04: {INFLATION: 200e3}}),
    ("seat_slap", (), {0.1: {"vibration.amplitude": 6.0}, 0.2: {"backrest.preload": 300.0}}),
    ("block_fall", (), {0.1: {FRICTION: 0.05}}),
]  # fmt: skip


@pytest.mark.parametrize(("scene", "values", "changes"), STEERED)
def test_a_steered_run_is_a_bag_that_repeats_its_bytes(scene, values, changes, tmp_path):
    made = load_scene(scene, *values, f"duration={max(changes) + 0.05}")
    run(made, tmp_path / "first", progress=False, changes=changes)
    found = changes_from_bag(tmp_path / "first")
    wanted = [Change(round(t / 0.01), key, value) for t, each in changes.items() for key, value in each.items()]
    assert [*found] == wanted
    sources = sources_from_bag(tmp_path / "first", made)
    run_offline(made, tmp_path / "again", sources=sources, changes=found)
    assert recorded(tmp_path / "again") == recorded(tmp_path / "first")
    # The bench that is stepped says the same
    bench = ContactBench(made)
    outputs = []
    while not bench.is_over:
        outputs += bench.step(parameters=changes.get(round(bench.time, 9))).outputs
    found = [each.data for each in open_bag(tmp_path / "first").messages("bench/steering")]
    assert [each[2] for each in bits([each for each in outputs if each.topic == "bench/steering"])] == found
    energy = [each.record.stored for each in outputs if each.topic == "bench/energy"]
    assert (open_bag(tmp_path / "first").columns("bench/energy")["stored"] == energy).all()
    # Its page names what changed, before the numbers
    (said,) = [
        each for each in warnings_of(read_recording(open_bag(tmp_path / "first"))) if "Parameters changed" in each
    ]
    assert all(f"{each.key} {each.value:.6g} from {each.block * 0.01:.3f} s" in said for each in wanted)
    with pytest.raises(BagError, match="run it again"):
        refuse_steered(tmp_path / "first", "run it again")


def test_a_run_refuses_its_changes_before_there_is_a_bag(tmp_path):
    for changes, words in (
        ({0.105: {FRICTION: 0.1}}, "lies within one"), ({9.0: {FRICTION: 0.1}}, "before block 900"),
        ({0.1: {"block.mass": 2.0}}, "block.mass is fixed"), ({0.1: {FRICTION: 7.0}}, "0 to 5"),
    ):  # fmt: skip
        with pytest.raises(ParameterError, match=words):
            run("block_fall", tmp_path / "bag", progress=False, changes=changes)
    assert not [*tmp_path.iterdir()]
