"""A seat on foam of finite thickness: one law with and without its map, scipy's motion, and what is refused."""

from types import SimpleNamespace

import numpy
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator
from tests.run.scenes import resolved

from contact_sim_lab.rigs.vehicle.accuracy_cushion import cushion_rows
from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.laws.elastic_law import elastic_force
from contact_sim_pkg.pressure.cushion.sitter import PERCENTILES, pan_gap
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, ContactPatch, EnergyLedger
from contact_sim_pkg.report.ranges import cushion_warnings
from contact_sim_pkg.report.signal.spectrum import transmissibility
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatCushion
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolve import read_resolved

KINDS = {
    "seat/force": ContactForce,
    "seat/patch": ContactPatch,
    "backrest/force": ContactForce,
    "backrest/patch": ContactPatch,
}
WITH_MAP = "effects.seat.contact_field={}"


def messages(name, *values, kinds=KINDS):
    """Messages of a run by topic."""
    scene = resolved(name, *values)
    simulation, sources = make_simulation(scene), make_sources(scene)
    simulation.prepare()
    found = {topic: [] for topic in kinds}
    for block in range(simulation.blocks):
        inputs = {topic: source.block(block) for topic, source in sources.items()}
        for topic, _stamp, data in simulation.advance(block, inputs).messages:
            if topic in kinds:
                found[topic].append(decode(kinds[topic], data))
    return found


def joined(forces, name):
    return numpy.concatenate([getattr(message, name) for message in forces])


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("seat_ride", ()),
        ("car_full_bench", ()),
        ("seat_ride", ("vibration={kind: sine, frequency: 4, amplitude: 12}",)),
    ],
)
def test_the_motion_is_the_same_with_and_without_the_map(name, values):
    length = "duration=0.3" if name == "car_full_bench" else "duration=1"
    with_map = messages(name, length, *values, WITH_MAP)
    without = messages(name, length, *values, *((f"{WITH_MAP[:-3]}=null",) if name == "car_full_bench" else ()))
    assert not without["seat/patch"]
    assert len(with_map["seat/patch"]) in (30, 100)
    for column in ("normal", "approach"):
        assert numpy.array_equal(joined(with_map["seat/force"], column), joined(without["seat/force"], column))


@pytest.mark.parametrize("amplitude", [3, 14])
def test_every_map_adds_up_to_the_force(amplitude):
    shaken = f"vibration={{kind: sine, frequency: 4, amplitude: {amplitude}}}"
    found = messages("seat_ride_full", "duration=1", shaken)
    for contact in ("seat", "backrest"):
        forces, patches = found[f"{contact}/force"], found[f"{contact}/patch"]
        assert len(patches) == 100
        for force, patch in zip(forces, patches, strict=True):
            total = patch.pressure.astype(float).sum() * patch.cell_x * patch.cell_y
            assert total == pytest.approx(force.normal[0], rel=1e-6, abs=1e-9)


def test_the_occupant_stands_as_deep_as_its_weight_presses_the_layer():
    """50.8 kg at 40.1 mm (``tests/pressure/cushion``), on 1100 cm^2 at 4.5 kPa mean."""
    found = messages("seat_ride", "duration=0.02", WITH_MAP, "vibration={kind: sine, frequency: 4, amplitude: 0}")
    assert joined(found["seat/force"], "approach") == pytest.approx(0.0401, rel=5e-3)
    assert joined(found["seat/force"], "normal") == pytest.approx(50.8 * 9.81, rel=1e-6)
    patch = found["seat/patch"][0]
    assert patch.peak == pytest.approx(10.5e3, rel=0.01)
    assert patch.centre_x == pytest.approx(0.060, abs=0.002)


def test_a_rigid_occupant_follows_scipy_through_lift_off():
    values = (
        "seat.occupant={model: own, frame_mass: 50.8, masses: [], stiffness: [], damping: []}",
        "integrator.relative_tolerance=1e-9",
        "vibration={kind: sine, frequency: 4, amplitude: 14, sample_rate: 100000}", "duration=0.5",
    )  # fmt: skip
    scene = resolved("seat_ride", *values)
    law = build(scene).rig.seat_contact.elastic
    nodes = law.spacing * numpy.arange(len(law.pieces))
    table = PchipInterpolator(nodes, law.pieces[:, 1])
    force = joined(messages("seat_ride", *values)["seat/force"], "normal")
    share, energy, damping, mass = 0.12, 1.0, 0.5, 50.8

    def forces(x, v, z):
        inside = min(x, nodes[-1])
        elastic = float(table(inside)) + (x - inside) * float(table(inside, 1)) if x > 0.0 else 0.0
        return elastic, elastic * max(0.0, 1.0 + share * z + damping * v)

    def rates(t, state):
        x, v, z = state
        elastic, total = forces(x, v, z)
        power = elastic * v
        floor = 14.0 * numpy.sin(8.0 * numpy.pi * t)
        return v, 9.81 + floor - total / mass, (power - abs(power) * z) / energy

    start = build(scene).rig
    standing = numpy.interp(mass * start.gravity, law.pieces[:, 1], nodes)
    for _ in range(20):
        standing -= (float(table(standing)) - mass * start.gravity) / float(table(standing, 1))
    times = numpy.arange(len(force)) * (0.5 / len(force))
    run = solve_ivp(rates, (0.0, 0.5), [standing, 0.0, 0.0], "RK45", times, rtol=1e-8, atol=1e-11, max_step=2e-4)
    expected = numpy.array([forces(*state)[1] for state in run.y.T])
    assert (force == 0.0).any(), "the occupant does not leave the seat"
    assert numpy.abs(force - expected).max() <= 2e-4 * expected.max()


def test_the_energies_balance():
    found = messages(
        "seat_ride", "duration=1", "integrator.relative_tolerance=1e-8", "vibration={kind: sine, frequency: 4, amplitude: 12}",
        kinds={"bench/energy": EnergyLedger},
    )["bench/energy"]  # fmt: skip
    held = [e.kinetic + e.potential + e.stored + e.dissipated - e.supplied for e in found]
    assert max(e.dissipated for e in found) > 1.0
    assert numpy.ptp(held) <= 1e-6 * max(e.supplied for e in found)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        (
            ("effects.seat.cushion.thickness=0.02",),
            r"the load at rest is 498.* N: its strain reaches 0\.75; take a harder cushion, one thicker than 0\.02 m, or",
        ),
        (
            (
                "effects.seat.cushion.thickness=0.2",
                "effects.seat.cushion.hardness=1600",
                "seat.occupant.percentile=95",
            ),
            r"the load at rest is 730.* N: under more the contact reaches its edge; take a harder cushion or a lighter body$",
        ),
    ],
)
def test_a_cushion_that_does_not_carry_the_occupant_is_refused_with_what_it_carries(values, sentence):
    with pytest.raises(SceneError, match=r"effects\.seat\.cushion: carries .* N at most, " + sentence):
        build(resolved("seat_ride", *values))


def test_the_body_on_the_cushion_is_that_of_the_occupant():
    for values, percentile in (
        ((), 50),
        (("seat.occupant.percentile=95",), 95),
        (("seat.occupant.percentile=95", "effects.seat.cushion.percentile=5"), 5),
    ):
        assert resolved("seat_ride", *values).data["effects"]["seat"]["cushion"]["percentile"] == percentile
    whole = resolved("seat_ride_full", "seat.occupant.percentile=5").data["effects"]
    assert whole["seat"]["cushion"]["percentile"] == whole["backrest"]["cushion"]["percentile"] == 5


def test_the_energy_of_a_reversal_grows_with_the_load_on_a_cushion():
    heavy = resolved("seat_ride", "seat.occupant.mass=101.6").data["effects"]["seat"]["foam_hysteresis"]["energy"]
    assert heavy == pytest.approx(2.0)
    on_foam = "effects.seat={normal_elastic: {}, foam: {}, foam_hysteresis: {}}"
    alone = resolved("seat_ride", "seat.occupant.mass=101.6", on_foam)
    assert alone.data["effects"]["seat"]["foam_hysteresis"]["energy"] == 1.0


def test_a_hardness_is_the_stress_at_forty_per_cent():
    from contact_sim_pkg.laws.elastic_law import elastic_force
    from contact_sim_pkg.rigs.vehicle.seat.schema import SeatCushion
    from contact_sim_pkg.run.contact_laws import foam_of

    foam = foam_of(SeatCushion(hardness=9.0e3))
    assert elastic_force(foam, 0.4 * foam.thickness) == pytest.approx(9.0e3, rel=1e-12)
    assert foam.modulus / foam.plateau == pytest.approx(45.0 / 3.4)


@pytest.mark.parametrize(("rms", "lowest", "highest"), [(0.5, 1.9, 2.3), (1.0, 1.75, 2.15)])
def test_the_transmissibility_peaks_near_two_at_four_hertz(rms, lowest, highest):
    """Car seats with people: 1.5 to 2.5 at 3.3 to 4.5 Hz, isolating above 6 Hz."""
    values = (f"vibration={{kind: noise, low: 0.5, high: 20, rms: {rms}}}", "duration=60", "block_length=0.1")
    found = messages("seat_ride", *values, kinds={"bench/motion": BodyMotion})["bench/motion"]
    floor, seat = (
        numpy.concatenate([block.acceleration[block.bodies.index(name)] for block in found])
        for name in ("floor_z", "seat_frame_z")
    )
    way = transmissibility(floor, seat, 1.0 / found[0].sample_period)
    trusted = (way.frequency > 1.0) & (way.frequency < 15.0) & (way.coherence > 0.9)
    peak = numpy.flatnonzero(trusted)[way.magnitude[trusted].argmax()]
    assert lowest < way.magnitude[peak] < highest
    assert 3.3 <= way.frequency[peak] <= 4.5
    assert (way.magnitude[(way.frequency > 6.5) & (way.frequency < 15.0)] < 1.0).all()


@pytest.mark.parametrize(
    ("accuracy", "cell"),
    [("realtime", 0.01), ("0.1", 0.01), ("1e-2", 0.01), ("9e-3", 0.0075), ("1e-3", 0.0075), ("9e-4", 0.005)],
)
def test_the_cells_follow_from_the_accuracy(accuracy, cell):
    effects = resolved("seat_ride_full", f"accuracy={accuracy}").data["effects"]
    assert [effects[contact]["cushion"]["cell"] for contact in ("seat", "backrest")] == [cell, cell]


def test_cells_that_a_scene_gives_stay():
    given = resolved("seat_ride_full", "accuracy=1e-3", "effects.seat.cushion.cell=0.01")
    assert read_resolved(given.to_yaml()).data["effects"]["seat"]["cushion"]["cell"] == 0.01


def test_the_accuracy_study_finds_errors_that_fall_with_cells_and_spacing():
    rows = cushion_rows(resolved("seat_ride"), lambda _sentence: None)
    for quantity in ("force", "pressure (L2)"):
        errors = [row["error"] for row in rows if row["quantity"] == f"seat cushion {quantity}"]
        assert len(errors) == 4
        assert errors == sorted(errors, reverse=True)
        assert errors[-1] < (0.012 if quantity != "force" else 1e-3)
    for quantity, finest in (("sink", 1e-4), ("stiffness", 3e-3), ("peak pressure", 2e-3)):
        of_cells = [row for row in rows if row["quantity"] == f"seat cushion {quantity}"]
        assert [(row["level"], row["tolerance"]) for row in of_cells] == [
            ("", 0.02),
            ("force", 0.01),
            ("field", 0.0075),
            ("reference", 0.005),
        ]
        errors = [row["error"] for row in of_cells]
        assert errors[0] == max(errors)
        assert errors[1] < 0.01
        assert errors[-1] < finest
    assert cushion_rows(resolved("seat_ride", "effects.seat={normal_elastic: {}}"), lambda _sentence: None) == []


@pytest.mark.parametrize(
    "values",
    [
        {"modulus": 1e6},
        {"modulus": 1e6, "plateau": 1e5},
        {"modulus": 1.01e5, "plateau": 1e5},
        {"hardness": 1e5},
        {"hardness": 1e5, "thickness": 0.02},
    ],
)
def test_the_hardest_cushion_is_right_on_the_cells_of_one_per_cent(values):
    """Force at the sink at which cells of 2.5 mm carry the load of the default occupant."""
    from contact_sim_pkg.rigs.vehicle.seat.cushion import pan_layer
    from contact_sim_pkg.rigs.vehicle.seat.schema import SeatCushion

    keys = SeatCushion(percentile=50, cell=0.01, **{"thickness": 0.1, **values})
    fine = pan_layer(keys.model_copy(update={"cell": 0.0025}))
    exact = fine.solve(0.008)
    for _ in range(8):
        exact = fine.solve(exact.approach + (498.0 - exact.force) / fine.tangent(exact), exact)
    assert exact.force == pytest.approx(498.0, rel=1e-4)
    assert pan_layer(keys).solve(exact.approach).force == pytest.approx(exact.force, rel=5e-3)


@pytest.mark.parametrize("value", ["modulus=1e7", "plateau=2e5", "hardness=2e5", "densification=1e5"])
def test_a_cushion_harder_than_its_cells_allow_is_refused(value):
    with pytest.raises(SceneError, match=r"effects\.seat\.cushion\." + value.split("=")[0]):
        resolved("seat_drop", f"effects.seat.cushion.{value}")


def test_a_hardness_that_scales_the_modulus_beyond_its_range_is_refused():
    values = ("effects.seat.cushion.modulus=1e6", "effects.seat.cushion.hardness=1e5")
    with pytest.raises(SceneError, match=r"seat\.cushion\.hardness: scales the modulus to .* Pa, 1e\+06 Pa at most"):
        build(resolved("seat_drop", *values))


def test_a_cushion_without_tissue_is_the_foam_layer_to_the_bit():
    from contact_sim_pkg.pressure.cushion.foam_layer import FoamGrid, FoamLayer
    from contact_sim_pkg.pressure.cushion.sitter import PERCENTILES, pan_gap
    from contact_sim_pkg.rigs.vehicle.seat.cushion import pan_layer
    from contact_sim_pkg.rigs.vehicle.seat.schema import SeatCushion
    from contact_sim_pkg.run.contact_laws import foam_of

    keys = SeatCushion(percentile=50, cell=0.01)
    x, y = (numpy.arange(72, dtype=float) - 24) * 0.01, (numpy.arange(64, dtype=float) - 31.5) * 0.01
    exact = FoamLayer(FoamGrid(72, 64, 0.01, 0.01), foam_of(keys), pan_gap(PERCENTILES[50], x, y)).solve(0.04)
    assert (pan_layer(keys).solve(0.04).pressure == exact.pressure).all()
    cushion = resolved("seat_ride").data["effects"]["seat"]["cushion"]
    assert "tissue" not in cushion
    assert "tissue_depth" not in cushion


@pytest.mark.parametrize("name", ["office_chair", "plate"])
def test_a_hard_seat_has_one_law_with_and_without_its_map(name):
    found = {values: messages(name, "duration=0.5", *values) for values in ((), ("effects.seat.contact_field=null",))}
    mapped, bare = found.values()
    assert (joined(mapped["seat/force"], "normal") == joined(bare["seat/force"], "normal")).all()
    assert not bare["seat/patch"]
    normal, stamps = joined(mapped["seat/force"], "normal"), len(mapped["seat/force"])
    for patch in mapped["seat/patch"]:
        total = numpy.asarray(patch.pressure, dtype=float).sum() * patch.cell_x * patch.cell_y
        assert normal.min() * 0.999 <= total <= normal.max() * 1.001
    assert stamps == 50


def test_a_seat_with_tissue_resolves_its_depth():
    data = resolved("plate").data["effects"]["seat"]["cushion"]
    assert (data["tissue"], data["tissue_depth"], data["carrier"]) == (2.0e3, 0.01, "plate")


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        (("effects.seat.cushion.carrier=plate",), r"cushion\.carrier: a rigid body touches a rigid plate at points"),
        (("effects.seat.cushion.tissue_depth=0.02",), r"cushion\.tissue_depth: acts beside tissue"),
        (
            ("effects.seat.cushion={carrier: plate, tissue: 2000, hardness: 9000}",),
            r"cushion\.hardness: acts in foam, the carrier is a plate",
        ),
        (("effects.seat.cushion.tissue=10",), r"cushion\.tissue"),
    ],
)
def test_keys_of_a_hard_seat_that_nothing_uses_are_refused(values, sentence):
    with pytest.raises(SceneError, match=sentence):
        resolved("seat_ride", *values)


def test_a_plate_refuses_a_load_beyond_its_tissue():
    with pytest.raises(SceneError, match=r"the plate carries .* N at most by the tissue"):
        build(resolved("plate", "seat.occupant={mass: 900}"))


FOAM = SeatCushion()


def formula(strain):
    """Stress [Pa] of the default foam, two terms of Hill's hyperfoam."""
    left, power = 1.0 - strain, FOAM.modulus / FOAM.plateau - 1.0
    first = FOAM.plateau * (1.0 / left - left**power)
    return first + FOAM.densification * (left ** (-FOAM.densification_exponent - 1.0) - 1.0 / left)


def foam_test(path, share=0.0, last=70):
    """A test of the default foam on 0.05 m^2, 100 mm thick, every millimetre up to `last` and back."""
    way = numpy.arange(0.0, last + 1.0)
    force = 0.05 * formula(way / 100.0)
    rows = [*zip(way, (1.0 + share) * force, strict=True), *zip(way[::-1], (1.0 - share) * force[::-1], strict=True)]
    path.write_text("deflection_mm,force_N\n" + "\n".join(f"{x:.6f},{y:.9f}" for x, y in rows))
    return f"effects.seat.cushion.curve={{file: {path}, area: 0.05, thickness: 0.1}}"


def test_a_curve_of_the_formula_carries_as_the_formula(tmp_path):
    """Columns alone: the force is the sum of the closed form over the cells."""
    law = build(resolved("seat_ride", foam_test(tmp_path / "foam.csv"), "effects.seat.cushion.shear_share=0")).rig
    table = law.seat_contact.elastic
    x, y = (0.0025 * numpy.arange(-96, 192), 0.0025 * (numpy.arange(-128, 128) + 0.5))
    gap = pan_gap(PERCENTILES[50], x, y)
    for approach in (0.01, 0.02, 0.03, 0.04, 0.05):
        expected = formula(numpy.maximum(approach - gap, 0.0) / FOAM.thickness).sum() * 0.0025**2
        assert elastic_force(table, approach) == pytest.approx(expected, rel=2e-3)


def test_a_curve_of_the_formula_moves_as_the_formula(tmp_path):
    plain, curved = (
        joined(messages("seat_ride", "duration=0.3", *values)["seat/force"], "normal")
        for values in ((), (foam_test(tmp_path / "foam.csv", 0.12), "effects.seat.foam_hysteresis={energy: 1.0}"))
    )
    assert numpy.abs(curved - plain).max() <= 3e-4 * plain.max()


def test_the_loop_of_a_curve_is_that_of_the_contact(tmp_path):
    scene = resolved("seat_ride", foam_test(tmp_path / "foam.csv", 0.2), "effects.seat.foam_hysteresis={}")
    assert build(scene).rig.seat_contact.hysteresis.share == pytest.approx(0.2, rel=1e-6)


def test_a_load_beyond_the_end_of_a_curve_is_refused(tmp_path):
    with pytest.raises(SceneError, match=r"strain reaches 0\.4, where its curve ends"):
        build(resolved("seat_ride", foam_test(tmp_path / "foam.csv", last=40)))


def test_a_curve_that_begins_too_stiff_is_refused(tmp_path):
    path = tmp_path / "foam.csv"
    foam_test(path)
    with pytest.raises(SceneError, match=r"cushion\.curve: begins with a modulus of"):
        build(resolved("seat_ride", f"effects.seat.cushion.curve={{file: {path}, area: 0.001, thickness: 0.1}}"))


@pytest.mark.parametrize(
    ("deepest", "said"),
    [
        (0.031, ""),
        (
            0.04,
            "compressed to 0.50 of its thickness; its measured curve ends at 0.4, beyond it (2 of 3 samples) the slope stays.",
        ),
    ],
)
def test_a_run_beyond_the_end_of_a_curve_says_so(deepest, said):
    keys = {"thickness": 0.08, "curve": {"points": [[0.1, 1e3], [0.4, 5e3]]}}
    series = SimpleNamespace(approach=numpy.array([0.01, deepest, deepest]))
    recording = SimpleNamespace(scene={"effects": {"seat": {"cushion": keys}}}, contacts={"seat": series})
    found = cushion_warnings("seat", recording)
    assert len(found) == (said != "")
    assert all(said in each for each in found)


def test_another_curve_has_another_table(tmp_path):
    first, second = (
        build(resolved("seat_ride", foam_test(tmp_path / f"{share}.csv", share))).rig.seat_contact.elastic
        for share in (0.0, 0.1)
    )
    assert first.pieces == pytest.approx(second.pieces, rel=1e-5, abs=1e-3)  # the mean is the same
    other = tmp_path / "other.csv"
    other.write_text((tmp_path / "0.0.csv").read_text().replace("40.000000,", "40.050000,"))
    curve = f"effects.seat.cushion.curve={{file: {other}, area: 0.05, thickness: 0.1}}"
    assert not numpy.array_equal(first.pieces, build(resolved("seat_ride", curve)).rig.seat_contact.elastic.pieces)
