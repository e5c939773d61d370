"""The axle of a tire on a test machine: forces beside closed forms of the same laws."""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.rigs.vehicle.machines.specimen import table_at
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.rigs.vehicle.tire.body import TireForm
from contact_sim_pkg.rigs.vehicle.tire.footprint import height_along, slope_along
from contact_sim_pkg.rigs.vehicle.tire.force_table import gap_over_level_road
from contact_sim_pkg.run.scene_outputs import outputs_with, records_of
from contact_sim_pkg.scene.errors import SceneError

FIELDLESS = ("effects.tire.contact_field=null",)
GRAVITY = 9.81


class Run:
    """Samples of a shipped scene with other values."""

    def __init__(self, name, *sets):
        self.scene = resolved(name, *sets)
        self.simulation = Simulation(self.scene)
        outputs = outputs_with(self.scene, self.simulation)
        forces = records_of(outputs, "tire/force")
        self.normal, self.approach, self.lateral = (
            numpy.concatenate([getattr(each, key) for each in found])
            for found, key in (
                (forces, "normal"), (forces, "approach"), (records_of(outputs, "tire/axle"), "vertical"),
            )
        )  # fmt: skip
        self.time = forces[0].sample_period * numpy.arange(len(self.normal))
        self.wheel = numpy.concatenate([each.position[0] for each in records_of(outputs, "bench/motion")])
        self.energy = records_of(outputs, "bench/energy")[-1]
        self.patches = records_of(outputs, "tire/patch")


def test_a_quarter_car_that_is_named_is_the_one_that_is_not():
    short = ("duration=0.05", "effects.tire.contact_field=null")
    plain, named = Run("tire_bump", *short), Run("tire_bump", *short, "tire.mount={kind: quarter_car}")
    assert "mount" not in plain.scene.data["tire"]
    numpy.testing.assert_array_equal(plain.normal, named.normal)
    numpy.testing.assert_array_equal(plain.wheel, named.wheel)


def test_a_plate_presses_the_standing_table():
    """0.5 mm a millisecond: each sample lies on a node of the table, whose force is a solution of the field."""
    programme = "tire.programme={time: [0, 0.05], deflection: [0.0, 0.025]}"
    run = Run("tire_plate", "duration=0.05", *FIELDLESS, programme)
    table = table_at({"inflation": {}}, {"inflation": 220e3})
    numpy.testing.assert_allclose(run.approach, table.spacing * numpy.arange(50), atol=1e-12)
    numpy.testing.assert_allclose(run.normal, table.force[:50], rtol=1e-9, atol=1e-6)
    assert run.wheel.tolist() == [0.0] * 50
    # What presses it does the work under the curve, to its start of the last block
    work = numpy.trapezoid(table.force[:41], dx=table.spacing)
    assert run.energy.supplied == pytest.approx(work, rel=1e-3)
    assert run.energy.stored == pytest.approx(work, rel=1e-3)
    assert abs(run.energy.residual) < 1e-6 * work


def test_the_field_under_a_plate_carries_the_load_of_its_sample():
    run = Run("tire_plate", "duration=0.1", "tire.programme={time: [0, 0.1], deflection: [0.005, 0.02]}")
    every = len(run.normal) // len(run.patches)
    carried = [each.pressure.sum(dtype=numpy.float64) * each.cell_x * each.cell_y for each in run.patches]
    numpy.testing.assert_allclose(carried, run.normal[::every], rtol=1e-3)


def test_a_belt_between_a_held_rim_and_a_plate_is_in_balance_at_the_start():
    run = Run(
        "tire_plate", "duration=0.01", *FIELDLESS, "effects.tire.rigid_ring={}", "tire.programme=null",
        "tire.mount.deflection=0.02",
    )  # fmt: skip
    quarter = run.simulation.model.quarter
    hangs = quarter.belt.mass * GRAVITY
    rim = (run.normal - hangs) / quarter.sidewalls.stiffness
    numpy.testing.assert_allclose(run.approach + rim, 0.02, atol=1e-9)
    numpy.testing.assert_allclose(run.lateral, run.normal - hangs, rtol=1e-9)


@pytest.mark.parametrize("ring", [(), ("effects.tire.rigid_ring={}",)])
def test_a_servo_holds_its_load_exactly_at_rest(ring):
    run = Run("tire_drum", "duration=0.1", "tire.mount.kind=flat_track", "tire.mount.radius=null", *ring)
    numpy.testing.assert_allclose(run.normal, 4000.0, rtol=1e-9)


def test_a_load_that_rises_lags_by_the_slide_and_is_there_in_the_end():
    """F = L - c v, v = (dL/dt) / K of a tire that follows slowly."""
    run = Run("tire_plate", "duration=0.8", *FIELDLESS, "tire.mount.control=load",
              "tire.programme={time: [0, 0.1, 0.6], load: [3000, 3000, 4000]}")  # fmt: skip
    table, load = (
        table_at({"inflation": {}}, {"inflation": 220e3}),
        numpy.interp(run.time, [0.1, 0.6], [3000.0, 4000.0]),
    )
    at = int(numpy.argmin(abs(run.time - 0.5)))
    stiffness = numpy.gradient(table.force, table.spacing)[round(run.approach[at] / table.spacing)]
    damping = run.scene.data["tire"]["mount"]["slide_damping"]
    assert load[at] - run.normal[at] == pytest.approx(damping * 2000.0 / stiffness, rel=0.02)
    assert run.normal[-1] == pytest.approx(4000.0, rel=1e-4)
    assert run.normal[50] == pytest.approx(3000.0, rel=1e-9)


def test_an_axle_that_is_held_does_not_move_over_a_bump():
    run = Run("tire_bump", "duration=0.3", "tire.mount={kind: held, load: 4000}", "travel={speed: 10}",
              "road={kind: cleat, position: 1, height: 0.01, length: 0.05}")  # fmt: skip
    assert numpy.ptp(run.wheel) == 0.0
    assert run.normal[0] == pytest.approx(4000.0, rel=1e-9)
    assert run.normal.max() > 4200.0


def test_on_a_drum_the_footprint_is_shorter_and_its_gap_that_of_two_circles():
    drum, level = (
        Run(
            "tire_drum",
            "duration=0.02",
            "effects.tire.contact_field={}",
            f"tire.mount.kind={kind}",
            f"tire.mount.radius={radius}",
        )
        for kind, radius in (("drum", 0.85), ("flat_track", "null"))
    )
    for run in (drum, level):
        patch = run.patches[-1]
        carried = patch.pressure.sum(dtype=numpy.float64) * patch.cell_x * patch.cell_y
        assert carried == pytest.approx(4000.0, rel=1e-3)
    assert drum.approach[-1] > level.approach[-1]
    loaded = [int((run.patches[-1].pressure > 0.0).any(axis=1).sum()) for run in (drum, level)]
    assert loaded[0] / loaded[1] == pytest.approx((1.0 + 0.316 / 0.85) ** -0.5, abs=0.06)
    # the field meets the drum as the table does
    assert drum.normal[-1] == pytest.approx(4000.0, rel=1e-9)


def test_the_height_over_a_drum_is_that_of_the_table_and_its_slope_the_derivative():
    form = TireForm(0.316, 2.29, circular=True, drum=1.0 / 0.85)
    x, step = numpy.linspace(-0.2, 0.2, 9), 1e-6
    found = [height_along(form, each) for each in x.tolist()]
    numpy.testing.assert_allclose(found, gap_over_level_road(form, x, numpy.zeros(1))[:, 0], atol=1e-15)
    slopes = [(height_along(form, each + step) - height_along(form, each - step)) / (2.0 * step) for each in x.tolist()]
    numpy.testing.assert_allclose([slope_along(form, each) for each in x.tolist()], slopes, atol=1e-8)


REFUSED = {
    "a plate stands, the tire does not roll at 5 m/s": ("tire_plate", "travel.speed=5"),
    "the load is kept, the deflection follows from it": (
        "tire_drum",
        "tire.mount.deflection=0.01",
        "tire.mount.control=load",
    ),
    "an axle held in height does not slide": ("tire_plate", "tire.mount.slide_damping=100"),
    "is that of a drum, the mount is flat_track": ("tire_drum", "tire.mount.kind=flat_track"),
    "acts between wheel and body, plate has none": ("tire_plate", "effects.tire.bump_stop={}"),
    "carries no car": ("car_ride", "tire.mount={kind: held}"),
    "a drum takes an inflated tire": ("tire_half_space", "tire.mount={kind: drum}"),
    "is none of a quarter_car": ("tire_bump", "tire.mount={kind: quarter_car, load: 4000}"),
}


@pytest.mark.parametrize("said", REFUSED)
def test_keys_that_a_mount_does_not_have_are_refused_in_one_sentence(said):
    name, *values = REFUSED[said]
    with pytest.raises(SceneError, match=said) as error:
        resolved(name, *values)
    assert len(error.value.faults) == 1


@pytest.mark.parametrize(
    ("where", "values"),
    [
        (r"tire\.programme\.load\.1: 30000 N at 1 s is beyond the law, which ends at \d+ N",
         ("tire.mount.control=load", "tire.programme={time: [0, 1], load: [4000, 30000]}")),
        (r"tire\.programme\.deflection\.1: 0\.09 m at 0\.5 s is beyond the law, which ends at 0\.0\d+ m",
         ("tire.programme={time: [0, 0.5], deflection: [0, 0.09]}",)),
        (r"tire\.mount\.deflection: 0\.09 m is beyond the law", ("tire.programme=null", "tire.mount.deflection=0.09")),
        (r"tire\.mount\.load: 30000 N is beyond the law", ("tire.programme=null", "tire.mount.load=30000")),
    ],
)  # fmt: skip
def test_what_leaves_the_range_of_the_law_is_refused_before_the_run(where, values):
    with pytest.raises(SceneError, match=where):
        build(resolved("tire_plate", *FIELDLESS, *values))
