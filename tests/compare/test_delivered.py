"""The companion run of a recorded run: what it finds, where it looks, what it leaves out."""

import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.compare.companion import companion_of
from contact_sim_pkg.compare.delivered import Check, check_bag
from contact_sim_pkg.compare.judgement import Judgement, judged, largest_by_kind, scales_of, standing_of
from contact_sim_pkg.compare.parting import Parting, Statistic
from contact_sim_pkg.compare.sentences import DRIFT, facts_of, lines_of
from contact_sim_pkg.compare.span import Span, begins_later, run_span
from contact_sim_pkg.records.table import number_of
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.resolve import load_resolved

SCENE = ("tire_bump", "duration=1.2")  # the bump begins at 0.97 s


def silent(_line):
    return None


@pytest.fixture(scope="module")
def scene():
    return load_resolved(*SCENE)


@pytest.fixture(scope="module")
def bag(scene, tmp_path_factory):
    path = tmp_path_factory.mktemp("delivered") / "bag"
    run_offline(scene, path)
    return path


@pytest.fixture(scope="module")
def check(bag):
    return check_bag(bag, silent)


def test_a_check_looks_round_the_bump_with_every_dial_finer(check):
    assert (check.scene, check.requested, check.limited, check.parting) == ("tire_bump", 0.01, "", None)
    assert all(each.end <= 1.2 + 1e-9 and each.end > 0.95 for each in check.windows)
    assert {"integrator.coupling_tolerance", "effects.tire.contact_field.rows"} <= set(check.dials)
    assert {(each.place, each.kind) for each in check.judgements} == {
        ("tire", "force"), ("tire", "peak"), ("tire", "area"), ("wheel_z", "motion"), ("body_z", "motion"),
    }  # fmt: skip


def test_the_delivered_force_is_that_of_a_run_two_levels_finer(scene, check):
    """The order that is assumed: the error by one finer run is within a factor of 3 of that by two."""
    window = check.windows[0]
    first, end = (round(time / scene.block_length) for time in (window.start, window.end))
    span = Span(first - 10, first, end)
    finest = companion_of(companion_of(scene).scene).scene
    run, reference = (run_span(each, span, silent).columns for each in (scene, finest))
    true = largest_by_kind(judged(run, reference, scales_of(run, standing_of(scene))))["force"]
    delivered = next(each.error for each in check.judgements if each.kind == "force")
    assert true / 3.0 < delivered < 3.0 * true


def test_the_whole_run_is_one_window(bag):
    found = check_bag(bag, silent, whole=True)
    [window] = found.windows
    assert (window.start, window.end) == (0.0, 1.2)
    assert DRIFT not in lines_of(found)


def test_on_a_foreign_road_the_grid_stays(scene, tmp_path):
    foreign = load_resolved(*SCENE, "road.height=0.02")
    run_offline(scene, tmp_path / "bag", sources=make_sources(foreign))
    found = check_bag(tmp_path / "bag", silent)
    assert found.limited == "road/patch of the bag is not what its scene makes"
    assert not any(dial.endswith(".rows") for dial in found.dials)
    lines = [*lines_of(found)]
    assert "coupling and integration only: road/patch of the bag is not what its scene makes" in lines


def test_the_lines_say_request_delivery_and_what_is_not_judged(check):
    lines = [*lines_of(check)]
    assert lines[0].startswith("tire force: requested 1e-2, delivered ")
    assert sum(line.startswith("not judged: ") for line in lines) == 1
    assert lines[-1].startswith("numerical error only")
    assert DRIFT in lines  # windows begin at rest, and see no drift
    facts = facts_of(check)
    assert facts["delivered"][0]["kind"] == "force"
    assert facts["delivered"][0]["held"] == (facts["delivered"][0]["error"] <= 0.01)


def test_a_bag_that_holds_no_block_is_refused(scene, tmp_path):
    run_offline(scene, tmp_path / "bag", stop=iter([False, True]).__next__)
    with pytest.raises(BagError, match="holds nothing that accuracy bounds"):
        check_bag(tmp_path / "bag", silent)


def test_a_rig_that_begins_nowhere_else_runs_from_its_start(tmp_path):
    scene = load_resolved("block_slope", "duration=0.3")
    run_offline(scene, tmp_path / "bag")
    found = check_bag(tmp_path / "bag", silent)
    assert not begins_later(scene)
    assert found.windows[0].start == 0.0
    assert all(each.error < 1e-3 for each in found.judgements)


def test_a_vehicle_that_begins_later_stands_there():
    """The load of a wheel that begins on a flat road is its weight, 3335.4 N."""
    scene = load_resolved("tire_bump")
    run = run_span(scene, Span(40, 40, 42), silent)
    normal = next(column for key, column in run.columns.items() if key.field == "normal")
    assert normal.instants[0] == 400_000_000
    assert normal.values == pytest.approx(340.0 * 9.81, rel=2e-3)


def test_runs_that_part_are_no_failure():
    """A back that hardly loses energy in its slaps: the finer run leaves it at the instant of one of them."""
    judgement = Judgement("backrest", "force", 1.01e-3, "normal", 4.18)
    parting = Parting(4.181, (Statistic("occupant_x", "position", 1.3e-2, 1.2e-2, 2.3e-2),))
    check = Check("seat_slap", 1e-3, (judgement,), (), (), "", parting, (), 1.0, is_whole=False)
    lines = [*lines_of(check)]
    assert lines[0] == "backrest force: requested 1e-3, delivered 1e-3 (until the runs part) (normal at 4.18 s)"
    assert lines[1] == (
        "the runs agree until 4.181 s and part there; beyond it means differ by 1.3e-2, rms by 1.2e-2, quantiles by 2.3e-2 of "
        "the scale at most (occupant_x position)"
    )
    assert facts_of(check)["delivered"][0]["held"]
    assert facts_of(check)["agrees_until_s"] == 4.181


@pytest.mark.parametrize(
    ("value", "text"),
    [(7.04e-3, "7e-3"), (1.24e-2, "1.2e-2"), (0.99e-2, "9.9e-3"), (9.99e-3, "1e-2"), (1.66, "1.7"), (1e-17, "0")],
)
def test_numbers_have_two_digits(value, text):
    assert number_of(value) == text
