"""The reference of figures 2 to 5 is apart from what the solver was given: a wrong input is found."""

import pytest

from contact_sim_lab.papers.registry import figure_of, paper_of, values_of
from contact_sim_lab.papers.tire_road import figures
from contact_sim_lab.records.paper import PaperError
from contact_sim_pkg.excitation.obstacle import ObstacleRoad
from contact_sim_pkg.rigs.vehicle.tire.body import TireForm


def _outside(number, *given):
    figures._case.cache_clear()
    figure = figure_of(paper_of("tire-road"), number)
    found = figure.compute(values_of("tire-road", figure.parameters, list(given))).numbers
    figures._case.cache_clear()
    return {each.what for each in found if each.verdict == "OUTSIDE"}


def _half_load(monkeypatch):
    solve = figures.solve_at_load

    def half(half_space, workspace, gap, load, *rest):
        return solve(half_space, workspace, gap, 0.5 * load, *rest)

    monkeypatch.setattr(figures, "solve_at_load", half)


def _dip(monkeypatch):
    """The road turned over where the solver's gap is made; the irregular road is the input of both."""
    solve = figures._solve

    def turned(road, load, grid):
        class Turned:
            def heights(self, x, y):
                return -road.heights(x, y)

        return solve(Turned(), load, grid)

    monkeypatch.setattr(figures, "_solve", turned)


def _exchanged(monkeypatch):
    form = figures.FORM
    monkeypatch.setattr(figures, "FORM", TireForm(form.radius_lateral, form.radius_rolling))


@pytest.mark.parametrize("number", ["2", "3", "4", "5"])
@pytest.mark.parametrize("mutation", [_half_load, _dip, _exchanged])
def test_a_wrong_input_of_the_solver_is_outside(number, mutation, monkeypatch):
    mutation(monkeypatch)
    found = _outside(number)
    assert "load, ∬ p" in found if mutation is _half_load else any("clearance" in each for each in found)


def test_a_bump_that_is_a_dip_in_the_product_is_outside(monkeypatch):
    heights = ObstacleRoad.heights
    monkeypatch.setattr(ObstacleRoad, "heights", lambda self, x, y: -heights(self, x, y))
    assert any("clearance" in each for each in _outside("2"))
    assert any("dense solution" in each for each in _outside("4"))


@pytest.mark.parametrize("given", ["load=500", "load=20000", "height=0.02"])
def test_the_grid_follows_the_load(given):
    assert _outside("4", given) == set()


def test_a_load_below_the_range_is_refused():
    with pytest.raises(PaperError, match=r"load 50\.0"):
        _outside("4", "load=50")
