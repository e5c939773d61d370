"""The part of the page on a rigid body: where it is drawn, and its numbers."""

import math
from types import SimpleNamespace

import numpy
import pytest

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.report import render
from contact_sim_pkg.rigs.body.report.metrics import block_metrics
from contact_sim_pkg.rigs.body.report.numbers import rest_from
from contact_sim_pkg.rigs.body.report.pose import chosen, ground_line, outline, poses_of
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve

GRAVITY = 9.81


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """Recordings by scene."""
    found = {}

    def of(name, *values):
        if name not in found:
            folder = tmp_path_factory.mktemp(name) / "bag"
            run_offline(resolve(load_scene(name, [set_value(value) for value in values])), folder)
            found[name] = read_recording(open_bag(folder))
        return found[name]

    return of


def test_the_outline_of_the_block_is_where_its_corners_are(recorded):
    recording = recorded("block_slope")
    poses = poses_of(recording.scene, recording.motion)
    angle, first = math.radians(15.0), outline(poses, 0)
    along, normal = numpy.array([math.cos(angle), math.sin(angle)]), numpy.array([-math.sin(angle), math.cos(angle)])
    places = (first - poses.centre[0, [0, 2]]) @ numpy.column_stack([along, normal])
    assert numpy.abs(places) == pytest.approx(numpy.full((5, 2), 0.05), abs=1e-12)
    assert (first @ normal).min() == pytest.approx(0.0, abs=1e-12)


def test_the_ground_is_drawn_as_the_slope_that_it_is(recorded):
    recording = recorded("block_slope")
    x, z = ground_line(poses_of(recording.scene, recording.motion), -1.0, 2.0)
    assert z == pytest.approx(math.tan(math.radians(15.0)) * x, abs=1e-12)


def test_the_outline_of_a_turned_box_has_its_lowest_corner_at_the_gap(recorded):
    recording = recorded("box_3d_tumble", "duration=0.3")
    poses = poses_of(recording.scene, recording.motion)
    for sample in (0, 100, 200, 299):
        lowest = outline(poses, sample)[:, 1].min()
        assert lowest == pytest.approx(-recording.contacts["block"].approach[sample], abs=1e-9)


def test_instants_are_spread_along_the_way_with_both_ends(recorded):
    recording = recorded("block_slope")
    poses = poses_of(recording.scene, recording.motion)
    samples = chosen(poses)
    gaps = numpy.linalg.norm(numpy.diff(poses.centre[samples], axis=0), axis=1)
    assert samples[0] == 0
    assert numpy.abs(poses.centre[samples[-1]] - poses.centre[-1]).max() < 1e-9
    assert gaps.max() < 1.2 * gaps.min()


def test_the_numbers_are_those_of_the_bounces(recorded):
    numbers = {each.key: each.value for each in block_metrics(recorded("block_zeno"))}
    first = math.sqrt(2.0 * GRAVITY)
    assert numbers["block.impulse_largest"] == pytest.approx(
        1.8 * first, rel=1e-6
    )  # no weight of the rest until the end
    assert numbers["block.rest"] == pytest.approx(math.sqrt(2.0 / GRAVITY) * 9.0, abs=2e-3)
    assert numbers["block.mass"] == pytest.approx(1.0, rel=1e-6)
    assert numbers["block.impulse"] == pytest.approx(GRAVITY * 5.0, rel=1e-6)


def test_a_body_that_rests_up_to_rounding_rests():
    """A compliant contact may leave 1e-17 m/s where a body has come to rest."""
    time = numpy.arange(6.0)
    speed = numpy.array([1.0, 0.5, 1e-17, -1e-17, 0.0, 1e-17])
    motion = SimpleNamespace(time=time, sample_period=1.0, velocity={"block_x": speed, "block_z": 0.0 * speed})
    assert rest_from(motion) == 2.0
    motion.velocity["block_z"][-1] = 1e-6
    assert rest_from(motion) is None


@pytest.mark.parametrize("name", ["block_slope", "block_zeno", "box_3d_tumble"])
def test_the_page_shows_way_motion_modes_and_impulse(recorded, name):
    page = render(recorded(name))
    for words in (
        "Way of the body over the ground", "Velocity and spin of the body over time",
        "Points in contact over time, sticking and slipping", "Impulse of the ground on the body over time",
        "Normal force and approach of the block contact over time",
    ):  # fmt: skip
        assert words in page
