"""Cost over what a scene asks for: slopes of known laws, a floor below the run, a page with every axis."""

import pytest

from contact_sim_lab.growth import growth


def test_the_slope_is_the_power_of_the_last_points(monkeypatch):
    def quadratic(axis, value):
        return {
            "axis": axis.name, "unit": axis.unit, "value": value, "seconds": 3e-4 * value**2, "floor": 0.0, "note": "",
        }  # fmt: skip

    monkeypatch.setattr(growth, "_row", quadratic)
    rows = growth.study(lambda _line: None)
    assert len(rows) == sum(len(axis.values) for axis in growth.AXES)
    assert all(row["slope"] == pytest.approx(2.0) for row in rows)
    text = growth.page(rows, "images/growth.png")
    assert all(axis.name[1:] in text for axis in growth.AXES)
    assert text.count("slope 2.00") == len(growth.AXES)


def test_a_run_is_above_its_counted_floor(monkeypatch):
    monkeypatch.setattr(growth, "REPEATS", 2)
    axis = next(each for each in growth.AXES if each.name.startswith("load"))
    row = growth._row(axis._replace(duration=0.2), 3000.0)
    assert 0.0 < row["floor"] < row["seconds"]
    assert row["note"].endswith("iterations/s")
