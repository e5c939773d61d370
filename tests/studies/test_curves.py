"""Published curves beside those of the bench: judged by their points, listed, drawn; the tables that they stand in."""

import math
import re
from pathlib import Path

import pytest
from PIL import Image

import contact_sim_lab
import contact_sim_pkg
from contact_sim_lab.rigs.vehicle.curves_tire import HERE
from contact_sim_lab.validation import curves, validation
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.records.published_curve import (
    FORMULA,
    MEASURED,
    PublishedCurve,
    curves_of,
    points_inside,
    read_published,
)
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "validation.md").read_text(encoding="utf-8")
TABLES = sorted(
    path
    for package in (contact_sim_pkg, contact_sim_lab)
    for path in Path(package.__file__).parent.glob("rigs/**/published/*.csv")
)
TABLE = """# kind: measured
# source: a book, 1901
# licence: free
inflation (kPa),load (N),length (mm),length sd (mm)
150,1000,100,2
150,2000,150,3
200,1000,90,2
200,2000,,
"""


def curve(ours, y=(10.0, 20.0, 30.0, 40.0), **changes):
    given = {
        "picture": "Scale", "name": "1 kg", "across": "place, m", "up": "weight, N", "kind": MEASURED, "blind": True,
        "x": (1.0, 2.0, 3.0, 4.0), "y": y, "error": (1.0,) * len(y), "own": 0.1, "ours": lambda _x: ours,
        "source": "a book, 1901", "note": "the pan is bent", **changes,
    }  # fmt: skip
    return PublishedCurve(**given)


def test_a_point_is_inside_by_both_uncertainties_added():
    """|ours - y| <= 1 + 0.1 ours: at 10 up to 12.2222, at 20 down to 19 / 1.1."""
    ours = (12.22, 12.23, 17.28, 17.27)
    found = points_inside(curve(ours, y=(10.0, 10.0, 20.0, 20.0)), ours)
    assert found == [True, False, True, False]
    assert points_inside(curve((math.nan,) * 4), (math.nan,) * 4) == [None] * 4


@pytest.mark.parametrize(
    ("ours", "inside", "holds"),
    [((10.0, 20.0, 30.0, 40.0), 4, True), ((10.0, 20.0, 30.0, 99.0), 3, True), ((10.0, 20.0, 99.0, 99.0), 2, False),
     ((10.0, 20.0, math.nan, 99.0), 2, False), ((math.nan,) * 4, 0, None)],
)  # fmt: skip
def test_a_curve_holds_by_the_share_of_its_points(ours, inside, holds):
    found = curves.judged(curve(ours))
    assert sum(found.valued) == inside
    assert found.holds is holds


@pytest.mark.parametrize(
    ("ours", "code"), [((10.0, 20.0, 30.0, 99.0), 0), ((99.0,) * 4, 1), ((10.0, 20.0, 30.0, math.nan), 3)]
)
def test_the_command_ends_by_its_curves(monkeypatch, capsys, ours, code):
    monkeypatch.setattr(curves, "all_curves", lambda: [curve(ours)])
    monkeypatch.setattr(validation, "all_published", list)
    assert main(["validation"]) == code
    assert "weight, N over place" in capsys.readouterr().out


def test_the_page_has_the_total_the_pictures_and_why_a_curve_misses(monkeypatch, tmp_path):
    held, missed = curve((10.0, 20.0, 30.0, 40.5), kind=FORMULA, blind=False), curve((99.0,) * 4, name="2 kg")
    monkeypatch.setattr(curves, "all_curves", lambda: [held, missed])
    monkeypatch.setattr(validation, "all_published", list)
    page = tmp_path / "page.md"
    assert main(["validation", "--page", str(page)]) == 1
    text = " ".join(page.read_text(encoding="utf-8").split())
    assert (
        "1 of 2 curves hold; 4 of 8 points lie inside, of the measured ones 0 of 4, of those of blind curves 0 of 4; "
        in text
    )
    assert "4 by the published uncertainty alone" in text
    assert "| weight, N over place | formula | 2 kg | 1 kg | +0 to +890 % | 4 of 8 | **1 of 2** |" in text
    assert "* weight, N over place, 2 kg: the pan is bent" in text
    assert "](page/scale.png)" in text
    with Image.open(tmp_path / "page" / "scale.png") as picture:
        assert picture.width > 700
    assert main(["validation", "--page", str(page)]) == 2  # it is there


def test_a_table_becomes_a_curve_for_each_value_of_a_column(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text(TABLE, encoding="utf-8")

    def measure(conditions):
        return conditions["load"] + conditions["inflation"]

    first, second = curves_of(
        read_published(path), "Tire", "length", "load", "inflation", error=(1.0, 0.1), own=0.05, measure=measure, fitted=(200.0,)
    )  # fmt: skip
    assert (first.name, first.across, first.up, first.kind) == ("150 kPa", "load, N", "length, mm", MEASURED)
    assert (first.x, first.y, first.error) == ((1000.0, 2000.0), (100.0, 150.0), (11.0, 16.0))
    assert first.blind
    assert not second.blind
    assert second.x == (1000.0,)  # the other has no length
    assert first.ours(first.x) == [1150.0, 2150.0]
    assert second.ours(second.x) == [1200.0]
    spread = next(curves_of(read_published(path), "Tire", "length", "load", "inflation", error="length sd", own=0.0))
    assert spread.error == (4.0, 6.0)


@pytest.mark.parametrize("path", TABLES, ids=lambda path: path.stem)
def test_a_table_that_travels_names_kind_source_and_licence(path):
    table = read_published(path)
    assert table.notes["kind"] in (MEASURED, FORMULA)
    assert table.notes["source"]
    assert table.notes["licence"]
    assert len(table.rows) >= 6
    readme = (path.parent / "README.md").read_text(encoding="utf-8")
    assert f"`{path.name}`" in readme
    assert "BSD" not in table.notes["licence"] or "Redistribution and use in source and binary forms" in readme


def test_the_formula_of_the_large_tire_has_the_stiffness_of_its_file():
    rows = read_published(HERE / "255_55R20.csv").rows
    (found,) = [
        row["stiffness"] for row in rows if (row["inflation"], row["load"], row["speed"]) == ("260", "6752", "")
    ]
    stated = read_property_file(HERE / "255_55R20.tir").get("VERTICAL_STIFFNESS")
    assert float(found) == pytest.approx(1e-3 * stated, rel=1e-3)


def test_the_page_in_the_project_has_every_curve():
    """`bench validation --page docs/validation.md --overwrite` makes it anew."""
    every = curves.all_curves()
    assert len(every) >= 20
    assert len({each.source for each in every if each.kind == MEASURED}) >= 3
    text = " ".join(PAGE.split())
    held, count = map(int, re.search(r"\*\*(\d+) of (\d+) curves hold", text).groups())
    assert count == len(every)
    measured = re.search(r"of the measured ones (\d+) of (\d+)", text)
    assert int(measured[1]) >= 0.7 * int(measured[2]) > 0
    assert int(measured[2]) == sum(len(each.x) for each in every if each.kind == MEASURED)
    assert f"{count} curves" in (ROOT / "README.md").read_text(encoding="utf-8")
    pictures = re.findall(r"\]\(validation/([^)]+\.png)\)", PAGE)
    assert sorted(pictures) == sorted(path.name for path in (ROOT / "docs" / "validation").iterdir())
    assert "no reason is known" not in text
    assert held >= 0.7 * count


def test_the_deflection_of_the_default_tire_is_that_of_the_published_one_at_inflations_it_was_not_fitted_to():
    found = [
        curves.judged(each) for each in curves.all_curves()
        if (each.picture, each.up, each.blind) == ("205/60 R15, standing", "deflection, mm", True)
    ]  # fmt: skip
    assert len(found) == 4
    assert all(abs(end) < 0.06 for each in found for end in each.extremes)
