"""First look at the accuracy of a scene: its rows, marks and picture."""

import pytest

from contact_sim_pkg.compare import first_look as module
from contact_sim_pkg.compare.first_look import Effort, FirstLook, Request, cheapest_for, first_look
from contact_sim_pkg.compare.judgement import Judgement, Unresolved
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.studies.accuracy.first_look_table import rows_of, sections, write_plot

SLOPE = (
    "rig: block\ndescription: slides\nduration: 0.1\naccuracy: 3e-3\nblock: {velocity: [1.0, 0.0, 0.0]}\n"
    "effects: {block: {rigid_contact: {friction: 0.3, restitution: 0.0}}}\n"
)


def request(requested, force, cost, *, own=False, unresolved=()):
    return Request(
        requested=requested,
        errors={"force": force, "motion": 0.5 * force},
        judgements=(
            Judgement("tire", "force", force, "normal", 0.1, unresolved),
            Judgement("wheel_z", "motion", 0.5 * force, "velocity", 0.1),
        ),
        estimated={},
        cost=cost,
        agrees_until=None,
        own=own,
    )


@pytest.fixture
def look():
    rows = (
        request(1e-1, 3.8e-2, 0.2, unresolved=(Unresolved("axle longitudinal", 0.47),)),
        request(1e-2, 1.2e-2, 0.28, own=True),
        request(1e-3, 8e-4, 3.9),
    )
    return FirstLook("tire_rough_road", rows, 0.1, 0.3, 1e-4, 9.6, ())


def test_the_cheapest_that_holds_is_marked(look):
    """1.2e-2 does not hold 1e-2: the run at 1e-3 is the cheapest that does."""
    assert [cheapest_for(look.requests, each).requested for each in (1e-1, 1e-2, 1e-3)] == [1e-1, 1e-3, 1e-3]
    assert cheapest_for(look.requests, 1e-4) is None


def test_a_finer_run_of_the_same_cost_is_not_cheaper():
    rows = (request(1e-1, 1e-9, 0.065), request(1e-2, 1e-9, 0.064))
    assert cheapest_for(rows, 1e-2) is rows[0]


def test_the_table_has_a_line_a_request(look):
    [section] = sections(rows_of(look))
    assert [line["requested"] for line in section.rows] == ["1e-1", "1e-2", "1e-3"]
    assert [line["force"] for line in section.rows] == ["3.8e-2", "1.2e-2 !", "8e-4"]
    assert [line["peak"] for line in section.rows] == ["-", "-", "-"]
    assert [line[""] for line in section.rows] == ["cheapest for 1e-1", "<- this scene", "cheapest for 1e-2, 1e-3"]
    assert section.rows[0]["not resolved"] == "tire axle longitudinal (47 %)"
    assert "0.1 to 0.3 s, against the scene at 1e-4" in section.note


def test_several_scenes_are_one_table_and_those_that_do_not_hold_are_named(look):
    rows = [*rows_of(look), *({**row, "scene": "other", "held": True} for row in rows_of(look))]
    table, held = sections(rows)
    assert [line["scene"] for line in table.rows] == ["tire_rough_road", "", "", "other", "", ""]
    assert [line[""] for line in table.rows][1] == "<- this scene"
    assert [(line["held"], line["not held"]) for line in held.rows] == [
        ("2 of 2", ""), ("1 of 2", "tire_rough_road"), ("2 of 2", ""),
    ]  # fmt: skip


def test_the_picture_of_one_scene_and_of_two(look, tmp_path):
    rows = rows_of(look)
    for name, drawn in (("one.png", rows), ("two.png", [*rows, *({**row, "scene": "other"} for row in rows)])):
        assert write_plot(drawn, tmp_path / name).stat().st_size > 10_000


def test_a_scene_is_run_at_each_request_and_at_its_own(tmp_path):
    lines = []
    scene = tmp_path / "slope.yaml"
    scene.write_text(SLOPE)
    look = first_look(str(scene), lines.append)
    assert [each.requested for each in look.requests] == [1e-1, 1e-2, 3e-3, 1e-3]
    assert [each.own for each in look.requests] == [False, False, True, False]
    assert (look.start, look.end, look.reference) == (0.0, pytest.approx(0.1), 1e-4)
    assert all(each.errors["motion"] < 1e-6 for each in look.requests)
    assert lines[0] == "slope: 0.1, 0.01, 0.003, 0.001 beside 0.0001"


def test_a_scene_is_looked_at_with_values_and_a_request_outweighs_them():
    look = first_look("block_painleve", lambda _line: None, values=("duration=0.05", "accuracy=1e-2"))
    assert [each.requested for each in look.requests] == [1e-1, 1e-2, 1e-3]
    assert look.end == pytest.approx(0.05)


def test_the_span_round_an_event_and_its_lead_are_as_long_as_asked():
    """The bump at 10 m is steepest a quarter of its length beside its middle, at 0.985 and 1.015 s; the scales are those
    of the run, whose motion is larger than that within 20 ms."""
    effort = Effort(repeats=1, length=0.02, lead=0.0)
    look = first_look("tire_half_space", lambda _line: None, values=("duration=1.2",), effort=effort)
    assert look.end - look.start == pytest.approx(0.02)
    assert look.start <= 0.985 <= look.end or look.start <= 1.015 <= look.end
    assert look.requests[0].holds(1e-1)


def test_a_request_at_which_the_run_ends_has_no_row(monkeypatch, tmp_path):
    scene = tmp_path / "slope.yaml"
    scene.write_text(SLOPE.replace("3e-3", "1e-2"))
    real, lines = module.run_span, []

    def ends_at_1e1(scene, *arguments, **options):
        if scene.accuracy == 0.1:
            raise RunError("block 3: the step is too long")
        return real(scene, *arguments, **options)

    monkeypatch.setattr(module, "run_span", ends_at_1e1)
    look = first_look(str(scene), lines.append)
    assert [each.requested for each in look.requests] == [1e-2, 1e-3]
    assert look.ended == ((1e-1, "block 3: the step is too long"),)
    assert "  it ends: block 3: the step is too long" in lines


def test_a_vehicle_is_looked_at_round_its_bump_with_the_scales_of_the_whole_run():
    """The bump of 0.6 m at 10 m is passed at 10 m/s from 0.97 to 1.03 s."""
    look = first_look("tire_half_space", lambda _line: None)
    assert look.start < 0.97
    assert look.end > 1.03
    assert look.end - look.start == pytest.approx(0.2)
    force = [each.errors["force"] for each in look.requests]
    assert force[0] > force[1] > force[2] > 0.0
    assert look.requests[1].holds(1e-2)
