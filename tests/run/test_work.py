"""The work of a run is estimated before it, and a computation that does not come back does not hold a run."""

import math
import re
import signal
import threading

import numpy
import pytest
from tests.bench_process import LONGEST, bench, end, start_bench
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.records.messages import SolverCost
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatSection
from contact_sim_pkg.run import offline
from contact_sim_pkg.run.computing import Computing
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.run.work import BOUND, estimated_work, refuse_long
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import shipped_names

GENERAL = "effects.backrest.general_dissipative"
DAMPER = (f"{GENERAL}.restitution=null", f"{GENERAL}.reference_speed=null", f"{GENERAL}.coefficient=1e12")
SEAT_LOSS, SEAT_GENERAL = "effects.seat.normal_dissipative=null", "effects.seat.general_dissipative"
MODES, SHELL = "effects.backrest.shell_modes", ("backrest.preload=20",)
STIFF_SHELL = (*SHELL, f"{MODES}={{modes: 25, points_up: 64, points_across: 64, young_modulus: 1e12}}")
ON_A_HALF_SPACE = ("effects.seat={normal_elastic: {}, half_space_field: {rows: 512, cols: 512}}",)


@pytest.mark.parametrize(
    ("scene", "values", "cause"),
    [
        ("seat_general", DAMPER, "backrest.general_dissipative"),
        ("seat_ride", (SEAT_LOSS, f"{SEAT_GENERAL}.coefficient=1e12"), "seat.general_dissipative"),
        ("block_fall", ("block.mass=1e6", "block.torque=[0,1e12,0]"), "spins"),
        ("box_3d_tumble", ("duration=60", "block.angular_velocity=[0,0,1e6]"), "spins"),
        ("roller_corrugation", ("roller.radius=100",), "turns of the track"),
        (
            "roller_corrugation",
            ("effects.roller.damage.table_rows=1000", "effects.roller.subsurface.cells_z=512"),
            "damage.table_rows",
        ),
        ("seat_ride", ("duration=3600", *ON_A_HALF_SPACE), "seat.half_space_field"),
        ("seat_slap", STIFF_SHELL, "backrest.shell_modes"),
    ],
)
def test_more_than_ten_minutes_are_refused_by_name_unless_they_are_allowed(scene, values, cause):
    asked = resolved(scene, *values)
    with pytest.raises(SceneError, match=rf"{cause}.* of computing, more than .*--allow-long") as refused:
        refuse_long(asked, allowed=False)
    assert "\n" not in str(refused.value)
    assert cause in refuse_long(asked, allowed=True)


@pytest.mark.parametrize("name", shipped_names())
def test_nothing_is_reported_of_a_shipped_scene(name):
    scene = resolved(name)
    assert refuse_long(scene, allowed=False) == ""
    assert sum(part.seconds for part in estimated_work(scene)) < BOUND


def test_a_loss_is_estimated_at_the_depth_of_the_law_that_carries():
    """A nearly linear foam without densification: force S E x / h, loss B x^2 v; foam takes the place of a stiff power law."""
    foam = "{area: 1, thickness: 2, modulus: 1e6, plateau: 999999, densification: 0}"
    laws = f"{{normal_elastic: {{coefficient: 1e9}}, foam: {foam}, general_dissipative: {{approach_exponent: 2}}}}"
    scene = resolved("seat_ride", f"effects.seat={laws}", f"{SEAT_GENERAL}.coefficient=1e12")
    model = scene.section(SeatSection).occupant.model_of()
    depth = model.mass * 9.80665 * 2.0 / 1e6
    expected = 1e12 * depth**2 / (model.masses[0] or model.mass) / 3.3 * scene.duration
    found = {part.what: part.number for part in estimated_work(scene)}
    assert found["steps of the integrator for seat.general_dissipative"] == pytest.approx(expected, rel=0.01)
    swing = math.sqrt(1e6 / 2.0 / (model.masses[0] or model.mass))  # of the mass on the stiffness S E / h
    assert found["steps of the integrator for seat.foam"] == pytest.approx(swing / 1.2 * scene.duration, rel=0.01)
    assert "steps of the integrator for seat.normal_elastic" not in found


def work_of_shell(modes=9, points=16, young_modulus=1e10):
    keys = f"{{modes: {modes}, points_up: {points}, points_across: {points}, young_modulus: {young_modulus}}}"
    parts = estimated_work(resolved("seat_slap", "duration=1", *SHELL, f"{MODES}={keys}"))
    return next(part for part in parts if part.what.endswith("backrest.shell_modes"))


def test_the_work_of_a_shell_grows_with_its_stiffness_modes_and_points():
    """Frequencies go with the square root of the modulus; steps pass 3.3 over the highest of them. Of a shell
    0.4 m by 0.5 m, 30 mm thick, whose 9th mode has three half-waves each way (Soedel, Vibrations of Shells and
    Plates, 6.3)."""
    along, up = (3.0 * math.pi / length for length in (0.4, 0.5))
    waves = along**2 + up**2
    bending = 0.03**2 / (12.0 * (1.0 - 0.45**2)) * waves**2
    highest = math.sqrt(1e10 / 1050.0 * (bending + ((along**2 / 1.5 + up**2 / 0.6) / waves) ** 2))
    usual = work_of_shell()
    assert usual.number == pytest.approx(highest / 3.3, rel=1e-6)
    assert work_of_shell(young_modulus=1e12).number == pytest.approx(10.0 * usual.number)
    assert work_of_shell(modes=25).seconds > 2.0 * usual.seconds
    assert 10.0 < work_of_shell(points=64).seconds / usual.seconds < 16.0


NEEDLE = ("block.sides=[1,1e-3,1e-3]", "block.mass=1", "block.angular_velocity=[0,0,0]", "duration=0.1")
ALONG = 1e-6 / 6.0  # [kg m^2] of the needle, about its length


@pytest.mark.parametrize(
    ("values", "acceleration"),
    [
        (("block.rotation=[0,0,0]", "block.torque=[1000,0,0]"), 1000.0 / ALONG),
        (("block.rotation=[0,0,1.5707963267948966]", "block.torque=[0,1000,0]"), 1000.0 / ALONG),
        (("block.rotation=[0,0,1.5707963267948966]", "block.torque=[1000,0,0]"), 12_000.0 / (1.0 + 1e-6)),
        (("block.rotation=[0,0,0]", "block.torque=[1000,0,0]", "block.force=[0,0,-1e12]"), 0.0),  # pressed down
        (("block.rotation=[0,0,0]", "block.torque=[1e-3,0,0]", "block.force=[0,0,10]"), 1e-3 / ALONG),  # lifted off
    ],
)
def test_a_torque_is_estimated_about_the_axis_that_it_turns(values, acceleration):
    """A slender box turns about its length 500 000 times as fast as across it; angle alpha T^2 / 2 in parts of 0.02 rad."""
    parts = {part.what: part.number for part in estimated_work(resolved("box_3d_tumble", *NEEDLE, *values))}
    expected = 0.5 * acceleration * 0.1**2 / 0.02
    assert parts["sub-steps of flight of a body that spins"] == pytest.approx(expected, rel=1e-6)


def test_a_block_that_slides_is_estimated_by_how_fast_its_spring_relaxes():
    """At the rate C / D of a spring of 2e6 N/m on a damper of 1e-3 N s/m."""
    contact = "{rigid_contact: {}, compliant_contact: {tangential_stiffness: 2e6, tangential_damping: 1e-3}}"
    scene = resolved("block_fall", f"effects.block={contact}")
    found = [part.number for part in estimated_work(scene) if part.what.endswith("block.compliant_contact")]
    assert max(found) == pytest.approx(2e9 / 3.3 * scene.duration)


def test_the_time_that_a_run_lasts_anyway_is_no_reason_to_refuse_it():
    """At the pace of real time an hour takes an hour."""
    assert sum(part.seconds for part in estimated_work(resolved("seat_ride", "duration=3600"))) < 3600.0
    assert refuse_long(resolved("seat_ride", "duration=3600"), allowed=False) != ""


def test_the_estimate_counts_the_steps_of_a_stiff_contact():
    scene = resolved("seat_ride", "duration=0.1", "effects.seat={normal_elastic: {coefficient: 1e12}}")
    expected = {part.what: part.number for part in estimated_work(scene)}
    simulation, source = make_simulation(scene), make_sources(scene)["platform/vibration"]
    simulation.prepare()
    counted = sum(
        decode(SolverCost, data).steps
        for block in range(simulation.blocks)
        for topic, _stamp, data in simulation.advance(block, {"platform/vibration": source.block(block)}).messages
        if topic == "bench/cost"
    )
    assert counted > 500
    assert 0.3 < expected["steps of the integrator for seat.normal_elastic"] / counted < 3.0


@entry
def third(value):
    return value / 3.0


def test_a_block_that_does_not_come_back_is_left_and_the_bag_closed(tmp_path, monkeypatch):
    """The blocks before it are there, and what the lost computation brings later is not."""
    scene, arrived, released = resolved("seat_ride", "duration=0.05"), threading.Event(), threading.Event()
    usual = make_simulation(scene)

    class Stuck:
        inputs, blocks, prepare = usual.inputs, usual.blocks, usual.prepare

        def advance(self, block, inputs):
            if block == 2:
                arrived.set()
                released.wait(60.0)
            return usual.advance(block, inputs)

    monkeypatch.setattr(offline, "make_simulation", lambda scene: Stuck())
    computing = Computing()
    assert computing.abandon() is None
    worker = threading.Thread(
        target=offline.run_offline, args=(scene, tmp_path / "bag"), kwargs={"computing": computing}, daemon=True
    )
    worker.start()
    assert arrived.wait(60.0)
    outcome = computing.abandon()
    released.set()
    worker.join(0.5)
    assert worker.is_alive()  # it waits for ever: nothing is written behind the end
    assert outcome.stopped
    assert outcome.blocks == 2
    assert outcome.failure == ""
    assert third(6.0) == 2.0  # the process may compile again
    bag = open_bag(tmp_path / "bag")
    assert bag.count("/seat/force") == 2
    assert numpy.isfinite(bag.columns("/bench/energy")["supplied"]).all()


def test_the_command_refuses_what_is_too_long_and_its_flag_lifts_that():
    """It tells of a long computation while it lasts, and ends it at an interrupt, though compiled code runs."""
    values = [word for value in DAMPER for word in ("--set", value)]
    refused = bench("run", "seat_general", "--offline", "--no-record", *values)
    assert refused.returncode == 2
    assert refused.stderr.startswith("bench: seat_general: about 3.2e+09 steps of the integrator")
    assert refused.stderr.count("\n") == 1
    process = start_bench("run", "seat_general", "--offline", "--no-record", "--allow-long", *values)
    try:
        assert next(line for line in process.stderr).startswith("seat_general: about 3.2e+09 steps")
        assert any(re.search(r"\(for \d+ s\)", line) for line in process.stderr)
        process.send_signal(signal.SIGINT)
        assert process.wait(LONGEST) == 0
    finally:
        end(process)
