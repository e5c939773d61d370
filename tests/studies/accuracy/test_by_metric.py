"""Dials for the accuracy of metrics: beside a run whose metrics err by a formula, and where no short run pays."""

import math

import pytest

pytest.importorskip("numba")

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.compare.companion import cells_of, halved
from contact_sim_pkg.records.metric import NO_BAND, Metric
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.studies.accuracy import by_metric
from contact_sim_pkg.studies.accuracy.by_metric import choose, lines_of, parsed

ROWS = "effects.tire.contact_field.rows"


def made(accuracy):
    return load_resolved("car_ride", f"accuracy={accuracy:g}", "duration=36")


USUAL = made(0.1)


def errs(scene, by_steps, by_cells):
    """Relative error of a metric of first order in the request of the steps and in the side of a cell."""
    return by_steps * scene.data["accuracy"] + by_cells * cells_of(USUAL)[ROWS] / cells_of(scene)[ROWS]


@pytest.fixture
def pilots(monkeypatch):
    """Short runs whose metrics err by `errs`; the scenes that were run."""
    ran = []

    def begin(laws, spread=math.nan):
        def pilot(scene, notify, said):
            ran.append(scene)
            metrics = {
                key: Metric(key, key, 50.0 * (1.0 + errs(scene, *law)), "", NO_BAND, None, spread=spread)
                for key, law in laws.items()
            }
            return by_metric._Pilot(metrics, 1.0)

        monkeypatch.setattr(by_metric, "_pilot", pilot)
        return ran

    return begin


@pytest.mark.parametrize("requested", [0.05, 0.02, 0.01, 0.005])
@pytest.mark.parametrize("laws", [
    {"tire.force": (0.3, 1e-4)}, {"tire.force": (0.01, 4e-3)}, {"tire.force": (1.0, 2e-3), "seat.factor": (0.2, 1e-3)},
    {"tire.force": (0.0, 0.0)},
])  # fmt: skip
def test_what_is_chosen_delivers(pilots, laws, requested):
    pilots(laws)
    choice = choose(made, dict.fromkeys(laws, requested), lambda text: None)
    for each in choice.deliveries:
        true = errs(choice.scene, *laws[each.key])
        assert each.note or true <= requested
        assert each.estimated >= 0.9 * true  # three steps of a third are 0.1 to 0.03, not to 0.033
    assert choice.scene.duration == 36.0


def test_a_loose_request_takes_half_the_cells_and_the_loosest_steps(pilots):
    ran = pilots({"seat.factor": (0.01, 1e-4)})
    choice = choose(made, {"seat.factor": 0.01}, lambda text: None)
    assert cells_of(choice.scene) == cells_of(halved(USUAL))
    assert choice.scene.data["accuracy"] == 0.1
    assert len(ran) == 3  # half the cells at two requests, usual cells at one


def test_peaks_refine_the_cells_alone_and_loads_the_steps_alone(pilots):
    pilots({"tire.peak_pressure": (0.0, 6e-3), "tire.dlc": (0.2, 0.0)})
    peak = choose(made, {"tire.peak_pressure": 0.01}, lambda text: None)
    assert (peak.steps, peak.cells) == (0.1, "fine")
    assert cells_of(peak.scene)[ROWS] == cells_of(made(1e-3))[ROWS]
    load = choose(made, {"tire.dlc": 0.005}, lambda text: None)
    assert (load.steps, load.cells) == (0.01, "half")


def test_cells_that_the_scene_gives_stay(pilots):
    pilots({"tire.dlc": (0.01, 1e-4)})

    def given(*values):
        return choose(
            lambda accuracy: load_resolved("car_ride", "duration=36", f"accuracy={accuracy:g}", *values),
            {"tire.dlc": 0.02}, lambda text: None,
        )  # fmt: skip

    own = tuple(f"effects.tire.contact_field.{side}" for side in ("rows", "cols"))
    found = given(*(f"{key}=60" for key in own))
    assert [cells_of(found.scene)[key] for key in own] == [60, 60]
    assert cells_of(found.scene)["effects.seat.cushion.cell"] == cells_of(halved(USUAL))["effects.seat.cushion.cell"]
    found = given(*(f"{key}=60" for key in own), "effects.seat.cushion.cell=0.01")
    assert (found.cells, cells_of(found.scene)["effects.seat.cushion.cell"]) == ("given", 0.01)


def test_what_no_dial_delivers_and_what_chance_does_is_named(pilots):
    pilots({"tire.gradient": (0.0, 0.4), "tire.dlc": (90.0, 0.0)}, spread=3.0)
    choice = choose(made, {"tire.gradient": 0.01, "tire.dlc": 0.01}, lambda text: None)
    gradient, load = choice.deliveries
    # 50 (1 + 0.4 * 2) are 90 on half the cells; 3 of 90 in 4 s, and a third of it in 36 s, are 1/90; (1/0.9)^2 as long for 0.01
    assert gradient.note == "no cells deliver it; chance alone moves it by 1.1e-2: 44 s would be needed"
    assert load.note == "no request of the steps delivers it"  # 3 of 500 in 4 s are less
    assert "no cells deliver it" in lines_of(choice)[0]


def test_of_two_requests_for_one_metric_the_smaller_counts(pilots):
    pilots({"tire.dlc": (0.2, 0.0), "tire.force": (0.0, 0.0)})
    choice = choose(made, {"tire.*": 0.05, "tire.dlc": 0.005}, lambda text: None)
    assert {each.key: each.requested for each in choice.deliveries} == {"tire.dlc": 0.005, "tire.force": 0.05}
    assert choice.steps == 0.01


@pytest.mark.parametrize(("name", "values", "why"), [
    ("impact_rubber_drop", (), "no contact of the scene has cells"),
    ("car_ride", ("duration=20",), "short runs would cost more than they save in 20 s"),
    ("tire_bump", ("duration=30",), "not alike over the run"),
    ("tire_rough_road", ("duration=30", "travel={points: [[0, 5], [20, 10]]}"), "not alike over the run"),
])  # fmt: skip
def test_without_short_runs_the_smallest_request_holds_for_all(pilots, name, values, why):
    ran = pilots({})

    def at(accuracy):
        return load_resolved(name, *values, f"accuracy={accuracy:g}")

    choice = choose(at, {"a": 0.02, "b": 0.004}, lambda text: None)
    assert why in choice.why
    assert choice.scene.data == at(0.004).data
    assert ran == []


def test_requests_are_percent_or_shares():
    assert parsed(("seat.factor=0.5%", " DLC = 0.01 ")) == {"seat.factor": pytest.approx(0.005), "DLC": 0.01}


@pytest.mark.parametrize(
    "text", ["seat.factor", "=1%", "seat.factor=0", "seat.factor=-1%", "seat.factor=nan", "a=200%", "a=1e-9"]
)
def test_what_is_no_request_is_refused(text):
    with pytest.raises(BagError, match=r"is no request: write METRIC=0\.5%"):
        parsed((text,))


def test_a_metric_that_the_scene_does_not_have_is_refused(pilots):
    pilots({"tire.dlc": (0.0, 0.0)})
    with pytest.raises(BagError, match=r"--within seat\.x: the list has no such metric"):
        choose(made, {"seat.x": 0.01}, lambda text: None)
