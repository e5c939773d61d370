"""System *distance* on bodies of closed form, and on ones that are none."""

import math

import numpy
import pytest
from scipy import optimize

from contact_sim_lab.papers.driver_seat.system_distance import body_of, distance, rotation_about
from contact_sim_lab.records.paper import PaperError
from contact_sim_pkg.files import RefusedError

SEED = {"seed": 1}


def file_of(tmp_path, first, second):
    path = tmp_path / "bodies.yaml"
    path.write_text(f"body_1: {first}\nbody_2: {second}\n", encoding="utf-8")
    return path


def test_all_three_find_the_distance_of_a_ball_from_a_box(tmp_path):
    """The nearest point of the box is its corner: the distance to it less the radius."""
    ball, crate = (
        "{kind: sphere, centre: [1, 1, 1], radius: 0.3}",
        "{kind: box, centre: [0, 0, 0], half_sides: [0.2, 0.1, 0.3]}",
    )
    result = distance(file_of(tmp_path, ball, crate), SEED)
    wanted = math.sqrt(0.8**2 + 0.9**2 + 0.7**2) - 0.3
    rough, polished, newton = (row["distance_m"] for row in result.rows)
    assert rough == pytest.approx(wanted, rel=1e-3)
    assert polished == pytest.approx(wanted, rel=1e-6)
    assert newton == pytest.approx(wanted, rel=1e-12)
    assert result.rows[1]["residual"] < 1e-5
    assert result.rows[2]["residual"] < 1e-10


def test_turned_ellipsoids_are_as_far_apart_as_a_search_over_their_surfaces(tmp_path):
    first = "{kind: ellipsoid, centre: [0, 0, 0], half_axes: [0.3, 0.1, 0.2], rotation: [0.5, 0.2, -0.4]}"
    second = "{kind: ellipsoid, centre: [0.6, 0.3, 0.2], half_axes: [0.1, 0.2, 0.15], rotation: [0, 1.1, 0]}"

    def surface(centre, axes, turn, angles):
        u, v = angles
        unit = numpy.array([math.cos(u) * math.cos(v), math.sin(u) * math.cos(v), math.sin(v)])
        return numpy.array(centre) + rotation_about(numpy.array(turn)) @ (numpy.array(axes) * unit)

    def gap(angles):
        one = surface([0, 0, 0], [0.3, 0.1, 0.2], [0.5, 0.2, -0.4], angles[:2])
        other = surface([0.6, 0.3, 0.2], [0.1, 0.2, 0.15], [0, 1.1, 0], angles[2:])
        return numpy.linalg.norm(one - other)

    starts = numpy.random.default_rng(3).uniform(-3.0, 3.0, (20, 4))
    wanted = min(optimize.minimize(gap, start, tol=1e-12).fun for start in starts)
    result = distance(file_of(tmp_path, first, second), SEED)
    assert result.rows[2]["distance_m"] == pytest.approx(wanted, rel=1e-7)


def test_spheres_overlap_by_the_sum_of_their_radii_less_their_distance(tmp_path):
    one, other = "{kind: sphere, centre: [0, 0, 0], radius: 0.5}", "{kind: sphere, centre: [0.6, 0, 0], radius: 0.3}"
    result = distance(file_of(tmp_path, one, other), SEED)
    assert [row["interference_m"] for row in result.rows] == pytest.approx([0.2, 0.2], rel=1e-6)
    assert "the penetration depth" in result.note


@pytest.mark.parametrize(
    ("section", "sentence"),
    [
        ({"kind": "cone"}, "a kind of sphere, ellipsoid, box"),
        ({"kind": "sphere", "centre": [0, 0, 0]}, "sphere takes centre, kind, radius"),
        ({"kind": "sphere", "centre": [0, 0], "radius": 1}, r"body_1.centre: 3 finite numbers are needed"),
        ({"kind": "sphere", "centre": [0, 0, 0], "radius": -1}, "body_1: "),
        ({"kind": "sphere", "centre": [0, 0, "x"], "radius": 1}, "body_1.centre: 3 numbers are needed"),
        ("sphere", "a kind of"),
    ],
)  # fmt: skip
def test_a_body_that_is_none_is_refused_with_its_place(section, sentence):
    with pytest.raises(PaperError, match=sentence):
        body_of(section, "body_1")


def test_a_file_without_two_bodies_is_refused(tmp_path):
    path = tmp_path / "bodies.yaml"
    path.write_text("body_1: {kind: sphere}\n", encoding="utf-8")
    with pytest.raises(PaperError, match="the keys body_1 and body_2 are needed, not body_1"):
        distance(path, SEED)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("body_1: [1, 2\n", r"bodies\.yaml:\d+:\d+: "),
        ("%YAML 1.1\n---\nbody_1: 1\n", "another YAML version"),
        ("body_1: " + "[" * 30 + "]" * 30 + "\n", "nested deeper than 20 levels"),
        ("body_1: " + "[" * 5000 + "\n", "nested deeper than 20 levels"),
        ("body_1: [" + "1," * 20000 + "1]\n", "more than 10000 keys and values"),
        ("a: &a [1, 2]\nb: [" + "*a," * 40 + "]\n", "more than 32 aliases"),
        ("body_1: !!python/name:os.system x\n", "the tag .* is not allowed"),
        ("body_1: 1\nbody_1: 2\n", "the key is given twice"),
        ("", "is empty"),
        ("- 1\n", "keys with values are needed"),
        ("body_1: 1\n" + "#" * (1 << 20), "at most 1048576 are read"),
    ],
)
def test_a_file_outside_the_limits_of_a_scene_is_refused(tmp_path, text, sentence):
    path = tmp_path / "bodies.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(RefusedError, match=sentence):
        distance(path, SEED)
