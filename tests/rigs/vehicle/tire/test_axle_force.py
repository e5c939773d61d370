"""Force of the rolling tire on its axle: the work that the road takes from the travel, and the balance of the wheel."""

import numpy
import pytest
from tests.rigs.vehicle.test_simulation import messages_of
from tests.run.scenes import resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.records.messages import AxleForce, BodyMotion, ContactForce, ContactPatch
from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.rigs.vehicle.tire.report.axle_series import axle_of
from contact_sim_pkg.rigs.vehicle.tire.report.figures_road import Rolling, along_the_road, near_largest_load, whole_way
from contact_sim_pkg.run.offline import run_offline

WEIGHT = 340.0 * 9.81
SPEED = 5.0
CLEAT = (
    "road={kind: cleat, position: 1.5, height: 0.01, length: 0.05, edge: 0.005}", f"travel.speed={SPEED}", "duration=0.6",
)  # fmt: skip


def joined(found, topic, record, field):
    return numpy.concatenate([getattr(decode(record, data), field) for data in found[topic]])


def works(found, rate):
    """Work that the travel gives, that the road brings into the wheel [J], and that which goes to and fro, of samples
    at a ``rate`` [Hz].
    """
    longitudinal = joined(found, "tire/axle", AxleForce, "longitudinal")
    force, height = (joined(found, "tire/force", ContactForce, name) for name in ("normal", "effective_height"))
    given = -longitudinal * SPEED / rate
    brought = 0.5 * (force[1:] + force[:-1]) * numpy.diff(height)
    return given.sum(), brought.sum(), abs(given).sum()


@pytest.mark.parametrize(
    ("rate", "effects"),
    [(1000, ()), (1000, ("effects.tire.rigid_ring={}",)), (8000, ("effects.tire.contact_field=null",))],
)
def test_what_the_cleat_takes_from_the_travel_it_brings_into_the_wheel(rate, effects):
    """An elastic contact keeps nothing: the work of the force along the road is that of the effective height, which
    without a field has the kinks of the cleat.
    """
    sets = "effects.tire.normal_dissipative=null", "accuracy=1e-3", f"outputs.force_rate={rate}"
    given, brought, moved = works(messages_of(resolved("tire_bump", *CLEAT, *sets, *effects)), rate)
    assert moved > 20.0
    assert given == pytest.approx(brought, abs=2e-3 * moved)


def test_a_cleat_pushes_back_first_and_forward_then():
    longitudinal = joined(messages_of(resolved("tire_bump", *CLEAT)), "tire/axle", AxleForce, "longitudinal")
    # Each push is flat on top: its place is the middle of what lies within a twentieth of the largest, not one sample.
    first, last = (
        numpy.flatnonzero(push > 0.95 * push.max())[[0, -1]].mean() * SPEED * 1e-3
        for push in (-longitudinal, longitudinal)
    )
    assert first == pytest.approx(1.5 - 0.05, abs=0.03)
    assert last == pytest.approx(1.5 + 0.05, abs=0.03)
    assert -600.0 < longitudinal.min() < -200.0
    assert 200.0 < longitudinal.max() < 600.0


def test_on_level_road_nothing_pushes_along():
    found = messages_of(resolved("tire_bump", "road={kind: flat}", "duration=0.1"))
    assert not joined(found, "tire/axle", AxleForce, "longitudinal").any()
    assert joined(found, "tire/axle", AxleForce, "vertical") == pytest.approx(WEIGHT, rel=1e-6)


def test_hysteresis_of_the_tread_drags():
    """Pressure that leads by e pushes against the travel with F e / R: what a loss factor of the tread costs."""
    tread = ("effects.tire.tread_viscoelasticity={}", "road={kind: flat}", f"travel.speed={SPEED}", "duration=0.4")
    found = messages_of(resolved("tire_bump", *tread, "outputs.field_rate=500"))
    longitudinal = joined(found, "tire/axle", AxleForce, "longitudinal")[200:]
    lead = numpy.mean([decode(ContactPatch, data).centre_x for data in found["tire/patch"][100:]])
    assert lead > 5e-4
    assert longitudinal.mean() == pytest.approx(-WEIGHT * lead / 0.316, rel=0.05)


def test_a_wheel_that_stands_without_a_field_is_not_pushed():
    found = messages_of(resolved("tire_bump", "effects.tire.contact_field=null", "travel.speed=0", "duration=0.05"))
    assert not joined(found, "tire/axle", AxleForce, "longitudinal").any()


@pytest.mark.parametrize("ring", [(), ("effects.tire.rigid_ring={}",)], ids=["alone", "ring"])
def test_the_axle_moves_as_its_forces_say(ring):
    found = messages_of(resolved("tire_bump", *CLEAT, *ring))
    motion = [decode(BodyMotion, data) for data in found["bench/motion"]]
    wheel, body = (motion[0].bodies.index(name) for name in ("wheel_z", "body_z"))
    place, speed, acceleration = (
        numpy.concatenate([getattr(block, name) for block in motion], axis=1)
        for name in ("position", "velocity", "acceleration")
    )
    suspension = 20000.0 * (place[wheel] - place[body]) + 1500.0 * (speed[wheel] - speed[body])
    mass = 33.0 if ring else 40.0
    vertical = joined(found, "tire/axle", AxleForce, "vertical")
    assert vertical == pytest.approx(mass * (acceleration[wheel] + 9.81) + suspension, abs=1e-6 * WEIGHT)


def test_the_report_draws_it_over_the_road(tmp_path):
    run_offline(resolved("tire_bump", *CLEAT), tmp_path / "bag")
    recording = read_recording(open_bag(tmp_path / "bag"))
    axle = axle_of(recording)
    recorded = [decode(AxleForce, each.data).longitudinal for each in open_bag(tmp_path / "bag").messages("tire/axle")]
    assert numpy.array_equal(axle.longitudinal, numpy.concatenate(recorded))
    assert axle.time[[0, -1]] == pytest.approx([0.0, 0.599])
    rolling = Rolling(recording.contacts["tire"], None, recording.series["road"], None, axle)
    whole = whole_way(rolling)
    assert whole is not None
    with style():
        drawn = along_the_road("rolling", "tire", rolling, near_largest_load(rolling, whole))
    assert "force of the road along the travel" in drawn.caption
