"""Films of two runs and what the second presses more, by closed form."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from contact_sim_pkg.report.comparison.aligned import Alignment
from contact_sim_pkg.report.comparison.films import LEAST_SCALE, MIDDLE, films_of_runs
from contact_sim_pkg.report.film import Film

PEAK = 5100.0  # [Pa] 20 a byte


def film(frames, times=None, cell=0.01, origin=(0.0, 0.0), largest=PEAK):
    frames = np.array(frames, dtype=np.uint8)
    times = np.arange(len(frames), dtype=float) if times is None else np.array(times)
    return Film(
        times,
        frames.sum(axis=(1, 2)).astype(float),
        frames.max(axis=(1, 2)).astype(float),
        frames,
        largest,
        cell,
        cell,
        *origin,
    )


def films(one, other, **more):
    runs = [SimpleNamespace(fields={"seat": SimpleNamespace(film=each)}) for each in (one, other)]
    return films_of_runs("AB", runs, **more)


def places(found):
    import base64

    return [np.frombuffer(base64.b64decode(each), "<u4").tolist() for each in found.data[2]["places"]]


def test_a_frame_lies_between_two_along_a_straight_line():
    rising = film([[[0]], [[100]], [[100]]], [0.0, 2.0, 3.0])
    assert [float(rising.at(time)[0, 0]) for time in (-1.0, 0.0, 0.5, 1.5, 2.0, 2.5, 9.0)] == [
        0,
        0,
        25,
        75,
        100,
        100,
        100,
    ]
    assert float(film([[[7]]]).at(3.0)[0, 0]) == 7.0


def test_films_of_two_runs_have_one_scale():
    found = films(film([[[255, 0]]]), film([[[255, 0]]], largest=2.0 * PEAK))
    assert [each.largest for each in found.views[:2]] == ["10.2", "10.2"]
    assert [each.name for each in found.views] == ["A: seat", "B: seat", "B − A: seat"]
    assert found.views[2].text == "0.000 s · 0 to 5.08 kPa"  # 255 - 128 bytes of 40 Pa
    assert found.data[2]["largest"] == 127.0


def test_a_grid_beside_the_other_is_met_cell_by_cell_and_nothing_presses_outside():
    found = films(film([[[10, 20, 30]]]), film([[[20, 30, 40]]], origin=(0.0, 0.01)))
    assert places(found) == [[1, 2, 3, 0], [0, 1, 2, 3]]
    assert found.data[2]["largest"] == 40.0
    assert found.notes == []


def test_a_difference_that_is_rounding_is_not_stretched_over_all_colours():
    found = films(film([[[100]]]), film([[[101]]]))
    assert found.data[2]["largest"] == LEAST_SCALE
    assert 0 < MIDDLE < 256


def test_grids_and_instants_that_differ_are_said():
    coarse = films(film([[[10, 20]]]), film([[[20]]], cell=0.02))
    assert coarse.notes == [
        "The grids of the seat differ, cells of 10 × 10 mm and 20 × 20 mm in A and B: nearest cells are compared."
    ]
    apart = films(film([[[10, 20]]]), film([[[20, 30]]], origin=(0.004, 0.0)))
    assert apart.notes == ["The grids of the seat in A and B are part of a cell apart: nearest cells are compared."]
    late = films(film([[[10]], [[20]]]), film([[[10]], [[20]]], [0.25, 0.5]))
    assert late.notes == ["The fields of the seat in A and B are of different instants: linear between two."]


def test_a_mat_that_is_turned_lies_on_the_cells_of_the_run():
    """A quarter to the left: forward becomes left; cell (1, 0) of the mat, 10 mm forward, lies 10 mm to the left."""
    mat = film([[[10], [20]]])
    run = film([[[10, 20]]])
    turned = Alignment(math.pi / 2, 0.0, 0.0, 1.0, None)
    found = films(run, mat, by=turned)
    assert places(found) == [[1, 2], [1, 2]]
    assert found.views[2].text == "0.000 s · 0 to 0 kPa"
    swapped = films(mat, run, moved=0, by=turned)
    assert places(swapped) == [[1, 2], [1, 2]]


def test_a_contact_that_a_run_lacks_shows_that_of_the_others_and_says_so():
    runs = [SimpleNamespace(fields={}), SimpleNamespace(fields={"seat": SimpleNamespace(film=film([[[1]]]))})]
    found = films_of_runs("AB", runs)
    assert [each.name for each in found.views] == ["B: seat"]
    assert found.notes == ["No map of the seat in A."]
    assert films_of_runs("AB", runs[:1] * 2).views == []


@pytest.mark.parametrize("count", [3, 6])
def test_more_runs_are_each_held_against_the_first(count):
    runs = [SimpleNamespace(fields={"seat": SimpleNamespace(film=film([[[10 * k + 10]]]))}) for k in range(count)]
    found = films_of_runs("ABCDEF"[:count], runs)
    assert [each["of"] for each in found.data[count:]] == [[0, k] for k in range(1, count)]
