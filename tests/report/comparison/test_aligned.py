"""A mat laid over a run: shift and turn of maps by closed form, and what `bench compare` prints of them."""

import json
import math

import numpy as np
import pytest
from tests.report.page import Page
from tests.report.sitting import SEAT, grid, mat_file, run_bag

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.report.comparison.aligned import align, laid_over
from contact_sim_pkg.report.series import PressureMap


@pytest.mark.parametrize(
    ("turn", "shift"), [(0.0, (0.0, 0.0)), (5.0, (0.02, -0.03)), (-87.0, (0.01, 0.05)), (166.0, (-0.03, 0.01))]
)
def test_shift_and_turn_are_found_between_the_cells(turn, shift):
    mat = grid(0.0127, 44, 40, math.radians(turn), shift)
    found = align(SEAT, mat)
    assert math.degrees(found.turn) == pytest.approx(turn, abs=0.1)
    assert (found.shift_x, found.shift_y) == pytest.approx(shift, abs=2e-4)
    assert found.correlation > 0.999
    assert found.as_good is None
    # Straight lines between cells of 12.7 mm miss a bump of 30 mm by p'' h²/8 at most, 2.2 % of the peak, both ways
    assert np.abs(laid_over(mat, found, SEAT).pressure - SEAT.pressure).max() < 0.05 * SEAT.pressure.max()


def test_a_map_that_shows_no_turn_is_not_turned_and_that_is_said():
    x = 0.01 * np.arange(-15, 16)
    even = np.maximum(0.0, 1e4 * (1.0 - (x[:, None] ** 2 / 0.12**2 + x[None, :] ** 2 / 0.08**2)))
    both = PressureMap(even, 0.01, 0.01, -0.15, -0.15)
    found = align(both, both)
    assert found.turn == pytest.approx(0.0, abs=1e-3)
    assert abs(found.as_good) == pytest.approx(math.pi)


def test_a_mat_and_a_run_are_compared_in_either_order_by_file_or_bag(tmp_path, capsys):
    run = run_bag(tmp_path / "ride")
    mat = mat_file(tmp_path / "mine.csv", grid(0.0127, 44, 40, math.radians(5.0), (0.02, -0.03)))
    picture = tmp_path / "maps.png"
    assert main(["compare", str(mat), str(run), "--plot", str(picture)]) == 0
    said = capsys.readouterr().out
    assert (
        "A: mine lies on B: ride turned by 5.0° to the left, shifted by 20.0 mm forward and -30.0 mm to the left"
        in said
    )
    assert "load of the mean map, N" in said
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert main(["import", str(mat), "--out", str(tmp_path / "bag")]) == 0
    capsys.readouterr()
    assert main(["compare", str(run), str(tmp_path / "bag"), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["alignment"]["turn_deg"] == pytest.approx(5.0, abs=0.1)
    assert found["alignment"]["moved"] == "B: bag"
    load = next(row for row in found["metrics"] if row["key"] == "seat.map_load")
    assert load["A: ride"] == pytest.approx(SEAT.pressure.sum() * 1e-4, rel=1e-6)
    assert load["relative"] == pytest.approx(0.0, abs=5e-3)  # cells at the edge, on 12.7 and on 10 mm
    tolerances = tmp_path / "t.yaml"
    tolerances.write_text("seat.map_peak: {relative: 0.001}")
    assert main(["compare", str(run), str(tmp_path / "bag"), "--tolerances", str(tolerances)]) == 1
    assert "MISSED" in capsys.readouterr().out


def test_the_page_of_a_mat_and_a_run_has_both_maps_and_what_the_run_presses_more(tmp_path, capsys):
    run = run_bag(tmp_path / "ride")
    mat = mat_file(tmp_path / "mine.csv", grid(0.0127, 44, 40, math.radians(5.0), (0.02, -0.03)))
    out = tmp_path / "page.html"
    assert main(["report", str(mat), str(run), "--out", str(out)]) == 0
    page = Page(out.read_text(encoding="utf-8"))
    assert [text for text in page.texts if text.endswith(": seat") or text.startswith("B − A: ")] == [
        "A: seat", "B: seat", "B − A: seat",
    ]  # fmt: skip
    said = " ".join(page.texts)
    assert "turned by 5.0° to the left" in said
    assert "cells of 12.7 × 12.7 mm and 10 × 10 mm in A and B" in said
    assert main(["report", str(mat), str(run), str(run), "--out", str(out)]) == 2
    assert "compared with one run or one mat; 3 bags" in capsys.readouterr().err


def test_what_cannot_lie_on_each_other_is_refused(tmp_path, capsys):
    run = run_bag(tmp_path / "ride")
    other = run_bag(tmp_path / "back", contact="backrest")
    mat = mat_file(tmp_path / "mine.csv", SEAT)
    assert main(["compare", str(mat), str(other)]) == 2
    assert "no pressure field of the contact seat; its fields are of backrest" in capsys.readouterr().err
    assert main(["compare", str(mat), str(run), str(run)]) == 2
    assert "compared with one run or one mat; 3 bags" in capsys.readouterr().err
    assert main(["compare", str(mat), str(run), "--loaded", "1e9"]) == 2
    assert "no pressure above 1e+09 Pa" in capsys.readouterr().err
    assert main(["compare", str(run), str(run), "--plot", str(tmp_path / "a.png")]) == 2
    assert "--plot draws the maps of a mat and a run" in capsys.readouterr().err
    assert not (tmp_path / "a.png").exists()
    (tmp_path / "bare.csv").write_text(mat.read_text().replace("UNITS Pa\n", ""))
    assert main(["compare", str(tmp_path / "bare.csv"), str(run)]) == 2
    assert "state it by --unit Pa|kPa|mmHg|psi|N/cm^2 (options of `bench import`" in capsys.readouterr().err
    turned = mat_file(tmp_path / "turned.csv", grid(0.01, 48, 48, math.pi))
    assert main(["compare", str(turned), str(run)]) == 0
    assert "`bench import --front` turns it" in capsys.readouterr().out
