"""One tire has one stiffness and one footprint, whatever the run: beside fields solved here, closed forms, and the axle
of heavier runs.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk
from tests.rigs.vehicle.test_simulation import messages_of
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.records.messages import BodyMotion, ContactPatch, TireStanding
from contact_sim_pkg.records.metric import STATE
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.rigs.vehicle.field.contact_field import PressureField
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.rigs.vehicle.tire.body import body_of
from contact_sim_pkg.rigs.vehicle.tire.force_table import gap_over_level_road, tire_table
from contact_sim_pkg.rigs.vehicle.tire.report.metrics import tire_metrics
from contact_sim_pkg.rigs.vehicle.tire.standing import of_table
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.sources import make_sources

LOAD = 340.0 * 9.81
"""[N] of the shipped tires"""
LEVEL, BARE = "road={kind: flat}", "effects.tire.contact_field=null"
RUNS = {
    "level road, no field": ("tire_bump", LEVEL, BARE),
    "level road, field": ("tire_bump", LEVEL),
    "rigid ring": ("tire_bump", "effects.tire.rigid_ring={}"),
    "rough road": ("tire_rough_road",),
    "braking": ("tire_braking",),
}
HALF_SPACE = "effects.tire={{normal_elastic: {{young_modulus: 1e6, radius_rolling: {}, radius_lateral: {}}}{}}}"
CELL = 1.25e-3
"""[m] half of those of the force table"""


def standing_in(messages):
    (data,) = messages["tire/standing"]
    return decode(TireStanding, data)


@pytest.fixture(scope="module")
def solved():
    """The tire's field on half the cells: stiffness [N/m] of two solutions; length, width [m] and area [m^2]."""
    body, rows, cols = body_of(resolved("tire_bump")), 192, 132
    assert body.belt.ring_compliance > 0.0  # the ring is part of the field
    settings = FieldSettings(rows, cols, CELL, CELL, body.modulus, 1e-8, 2000, 0, body.belt)
    x, y = (np.arange(rows) - rows // 2) * CELL, (np.arange(cols) - 0.5 * (cols - 1)) * CELL
    gap, field = gap_over_level_road(body.form, x, y), PressureField(settings, "tire")
    less, more, _there = (field.solve_load(gap, share * LOAD) for share in (0.98, 1.02, 1.0))
    pressure = field.pressure
    sizes = [CELL * max(map(edge_to_edge, lines)) for lines in (pressure.T, pressure)]
    return 0.04 * LOAD / (more - less), *sizes, CELL**2 * np.count_nonzero(pressure)


def edge_to_edge(line):
    """Cells between the zeros of the square of the pressure, straight through the outermost two at both ends."""
    loaded = np.flatnonzero(line)
    if len(loaded) < 2:
        return 0.0
    ends = [line[loaded[:2]] ** 2, line[loaded[:-3:-1]] ** 2]
    return loaded[-1] - loaded[0] + sum(min(outer / (inner - outer), 1.0) for outer, inner in ends if inner > outer)


@pytest.mark.parametrize("run", RUNS.values(), ids=RUNS)
def test_in_five_runs_one_tire_has_the_stiffness_and_the_footprint_of_its_field(run, solved):
    stands = standing_in(messages_of(resolved(*run, "duration=0.1")))
    stiffness, length, width, area = solved
    assert stands.load == pytest.approx(LOAD, rel=1e-9)
    assert stands.stiffness == pytest.approx(stiffness, rel=5e-3)
    assert stands.length == pytest.approx(length, rel=8e-3)
    assert stands.width == pytest.approx(width, rel=5e-3)
    assert stands.area == pytest.approx(area, rel=8e-3)
    assert stands.mean_pressure == pytest.approx(LOAD / area, rel=8e-3)


BELT = HALF_SPACE.format(0.3, 1.0, ", contact_field: {}, envelopment: {}")


@pytest.mark.parametrize(
    "keys",
    [(), (BARE,), ("effects.tire.rigid_ring={}",), (HALF_SPACE.format(0.3, 1.0, ", rigid_ring: {}"),), (BELT,)],
    ids=["field", "bare", "ring", "half-space on a ring", "half-space under a belt"],
)
def test_the_axle_of_a_heavier_run_stands_deeper_by_the_load_over_the_stiffness(keys):
    """By the place of the wheel in runs of 2 % less and more load, at rest on a level road; the sidewalls of a ring that is
    a body do not bear its weight there.
    """
    scene = ("tire_bump", LEVEL, "duration=0.1", *keys)
    stands = standing_in(messages_of(resolved(*scene)))
    places = []
    for share in (0.98, 1.02):
        messages = messages_of(resolved(*scene, f"tire.body_mass={340.0 * share - 40.0}"))
        motion = decode(BodyMotion, messages["bench/motion"][0])
        places.append(motion.position[motion.bodies.index("wheel_z"), 0])
    assert stands.stiffness == pytest.approx(0.04 * LOAD / (places[0] - places[1]), rel=5e-3)
    quarter = build(resolved(*scene)).quarter
    weight = 0.0 if quarter.belt is None else quarter.belt.mass * 9.81 / quarter.sidewalls.stiffness
    assert stands.deflection == pytest.approx(weight - sum(places) / 2.0, rel=5e-3)


@pytest.mark.parametrize("field", ["", ", contact_field: {}"], ids=["bare", "field"])
@pytest.mark.parametrize("ring", ["", ", rigid_ring: {stiffness: 3e5}"], ids=["alone", "ring"])
def test_a_spherical_half_space_has_the_closed_form_of_hertz(field, ring):
    """F = 4/3 E* R^(1/2) d^(3/2), a^2 = R d, dF/dd = 2 E* a (Johnson, 4.2), the ring in series."""
    stands = build(resolved("tire_bump", LEVEL, HALF_SPACE.format(0.4, 0.4, field + ring))).tire_standing
    modulus = 1e6 / (1.0 - 0.5**2)
    depth = (0.75 * LOAD / (modulus * math.sqrt(0.4))) ** (2.0 / 3.0)
    radius, more = math.sqrt(0.4 * depth), 1.0 / 3e5 if ring else 0.0
    assert stands.stiffness == pytest.approx(1.0 / (1.0 / (2.0 * modulus * radius) + more), rel=1e-5)
    assert stands.deflection == pytest.approx(depth + more * LOAD, rel=1e-9)
    assert (stands.length, stands.width) == pytest.approx((2.0 * radius, 2.0 * radius), rel=1e-9)
    assert stands.area == pytest.approx(math.pi * radius**2, rel=1e-9)
    assert stands.mean_pressure == pytest.approx(LOAD / (math.pi * radius**2), rel=1e-9)


@pytest.mark.parametrize("radii", [(0.3, 1.0), (1.0, 0.3)], ids=["wide", "long"])
def test_an_elliptic_half_space_has_that_of_an_ellipse(radii):
    """Johnson, 4.2: with e^2 = 1 - (b/a)^2, A/B = (b/a)^2 (K - E)/(E - (b/a)^2 K) and c^3 = (ab)^(3/2) from the load; d is
    3 F K/(2 pi E* a), so K = dF/dd = 3/2 F/d.
    """
    stands = build(resolved("tire_bump", LEVEL, HALF_SPACE.format(*radii, ""))).tire_standing
    modulus, flat, sharp = 1e6 / 0.75, 0.5 / 1.0, 0.5 / 0.3

    def missed(ratio):
        m = 1.0 - ratio**2
        return ratio**2 * (ellipk(m) - ellipe(m)) / (ellipe(m) - ratio**2 * ellipk(m)) - flat / sharp

    ratio = brentq(missed, 0.01, 0.99)
    m = 1.0 - ratio**2
    # B = p0/E* b/(e^2 a^2) [(a/b)^2 E - K] and F = 2/3 p0 pi a b give a
    major = (1.5 * LOAD / (math.pi * modulus * sharp) * (ellipe(m) / ratio**2 - ellipk(m)) / m) ** (1.0 / 3.0)
    depth = 1.5 * LOAD * ellipk(m) / (math.pi * modulus * major)
    sizes = 2.0 * major * np.array([ratio, 1.0] if radii[0] < radii[1] else [1.0, ratio])
    assert (stands.length, stands.width) == pytest.approx(tuple(sizes), rel=1e-6)
    assert stands.area == pytest.approx(math.pi * ratio * major**2, rel=1e-6)
    assert stands.deflection == pytest.approx(depth, rel=1e-6)
    assert stands.stiffness == pytest.approx(1.5 * LOAD / depth, rel=1e-5)


def test_under_a_belt_the_footprint_is_that_of_the_run_s_field_at_rest():
    messages = messages_of(resolved("tire_bump", LEVEL, "duration=0.1", BELT))
    stands, patch = standing_in(messages), decode(ContactPatch, messages["tire/patch"][0])
    loaded = patch.pressure > 0.0
    assert stands.area == pytest.approx(patch.area, rel=5e-3)
    assert stands.mean_pressure == pytest.approx(patch.mean, rel=5e-3)
    assert stands.length == pytest.approx(patch.cell_x * loaded.any(axis=1).sum(), abs=1.5 * patch.cell_x)
    assert stands.width == pytest.approx(patch.cell_y * loaded.any(axis=0).sum(), abs=1.5 * patch.cell_y)


@pytest.mark.parametrize("keys", [(), (BELT,)], ids=["inflated", "half-space under a belt"])
def test_a_tread_with_memory_has_relaxed(keys):
    elastic, with_memory = (
        build(resolved("tire_bump", *keys, *more)).tire_standing
        for more in ((), ("effects.tire.tread_viscoelasticity={}",))
    )
    assert with_memory == pytest.approx(elastic, rel=1e-9)


def test_it_is_sent_in_the_first_block_of_a_run_whichever_that_is():
    scene = resolved("tire_bump", LEVEL, BARE, "duration=0.4")
    simulation, sources = Simulation(scene), make_sources(scene)
    simulation.prepare()
    simulation.begin_at(2)
    sent = []
    for block in (2, 3):
        result = simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()})
        sent += [output for output in result.outputs if output.topic == "tire/standing"]
    assert [each.record.block for each in sent] == [2]


def test_beyond_its_table_nothing_is_guessed():
    table = tire_table(body_of(resolved("tire_bump")))
    assert of_table(table, None, 0.99 * table.force[-1]) is not None
    assert of_table(table, None, 1.01 * table.force[-1]) is None


def test_a_car_stands_under_the_occupant_too(tmp_path):
    """Its bag gives the metrics, on the load of the wheel."""
    run_offline(resolved("car_ride", "duration=0.2"), tmp_path / "bag")
    metrics = {each.key: each for each in tire_metrics(read_recording(open_bag(tmp_path / "bag")))}
    car = standing_in(messages_of(resolved("car_ride", "duration=0.08")))
    assert car.load > 1.1 * LOAD
    assert metrics["tire.stiffness"].value == pytest.approx(1e-3 * car.stiffness, rel=1e-12)
    assert metrics["tire.stiffness"].basis == STATE
    assert metrics["tire.load"].band.low < car.load < metrics["tire.load"].band.high
