"""The genetic search against closed forms, and the work-precision studies of contact search and shell."""

from __future__ import annotations

import numpy
import pytest

from contact_sim_lab.papers.distance import work_precision as study_closest
from contact_sim_lab.papers.distance.convex_body import box, ellipsoid, half_space, sphere
from contact_sim_lab.papers.distance.genetic_search import genetic_distance, genetic_interference
from contact_sim_lab.rigs.backrest import work_precision_shell as study_shell

SPHERES = sphere([0, 0, 0], 0.3), sphere([0.3, 0.5, 0.1], 0.1)
GAP = float(numpy.linalg.norm([0.3, 0.5, 0.1])) - 0.4


@pytest.mark.parametrize("seed", [1, 2])
def test_the_genetic_distance_is_that_of_spheres_and_boxes(seed: int) -> None:
    rough, polished = (genetic_distance(*SPHERES, seed=seed, polish=polish) for polish in (False, True))
    assert rough.value == pytest.approx(GAP, rel=1e-5)
    assert polished.value == pytest.approx(GAP, rel=1e-9)
    assert polished.residual < 1e-5 < rough.evaluations * 1e-5 + rough.residual
    assert numpy.linalg.norm(polished.points[0]) == pytest.approx(0.3, rel=1e-8)
    faces = genetic_distance(box([0, 0, 0], [1, 1, 1]), box([2.5, 0.4, 0], [1, 1, 1]), seed=seed)
    assert faces.value == pytest.approx(0.5, abs=1e-7)


def test_the_same_seed_gives_the_same_result_and_another_one_does_not() -> None:
    first, again, other = (genetic_distance(*SPHERES, seed=seed, polish=False) for seed in (1, 1, 2))
    assert first.value == again.value
    assert first.value != other.value


def test_the_residual_tells_a_point_that_is_not_the_closest(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("contact_sim_lab.papers.distance.genetic_search.GENERATIONS", 2)
    assert genetic_distance(*SPHERES, polish=False).residual > 1e-3


def test_the_genetic_interference_is_that_of_spheres_and_half_space() -> None:
    found = genetic_interference(sphere([0, 0, 0], 0.3), half_space([0, 0, 1], -0.2))
    assert found.value == pytest.approx(0.1, rel=1e-8)
    assert found.points[0] == pytest.approx([0.0, 0.0, -0.25], abs=1e-4)
    assert found.residual < 1e-4
    nested = genetic_interference(ellipsoid([0, 0, 0], [3, 2, 1]), ellipsoid([0.1, 0.1, 0.05], [0.5, 0.2, 0.4]))
    assert nested.value == pytest.approx(0.4, rel=1e-6)


@pytest.fixture(scope="module")
def search_rows() -> list[dict[str, object]]:
    return study_closest.rows()


def test_bounds_stay_on_their_side_and_each_rung_of_the_search_is_better(search_rows: list[dict[str, object]]) -> None:
    for case, bound in (("separated", 0.0), ("overlapping", 1.0)):
        chosen = {row["level"]: row for row in search_rows if row["case"] == case}
        errors = [chosen[name]["error"] for name in chosen]
        assert errors[:3] == sorted(errors[:3], reverse=True)
        assert errors[2] > 1e-9 > errors[3]
        assert errors[4] < 1e-12
        assert errors[1] > 1e-2
        for name in ("bounding spheres", "support points along the centres"):
            value, expected = chosen[name]["value"], chosen[name]["expected"]
            assert (value > expected) == bool(bound)


def test_more_modes_come_closer_to_the_deflection() -> None:
    rows = study_shell.rows()
    for case, errors in (("plate", [0.1237, 0.0359, 0.0165]), ("back", [0.223, 0.0682, 0.0315])):
        found = [
            row["error"]
            for row in rows
            if (row["case"], row["quantity"]) == (case, study_shell.STATIC) and row["level"] != "4 modes"
        ]
        assert found == pytest.approx(errors, rel=5e-3)
