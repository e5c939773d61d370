"""Sobol indices of a sweep, on a function whose own are known."""

import math

import pytest

from contact_sim_pkg.sweep.sensitivity import drawn_points, sobol_indices
from contact_sim_pkg.sweep.table import SweepTable
from contact_sim_pkg.sweep.variation import SweepError, read_variation, samples_of

POINTS = 1024
A, B = 7.0, 0.1


def ishigami(values):
    """sin x + A sin² y + B z⁴ sin x over [-pi, pi]."""
    x, y, z = (float(values[key]) for key in "xyz")
    return math.sin(x) + A * math.sin(y) ** 2 + B * z**4 * math.sin(x)


def table_of(values, function=ishigami):
    rows = [
        {
            "number": number, "outcome": "finished", "sentence": "", "case": "", "machine": "",
            "metrics": [{"key": "f", "unit": "", "value": function(each), "error": None, "spread": None, "broken": [],
                         "verdict": "no band", "basis": "state"}],
        }
        for number, each in enumerate(values)
    ]  # fmt: skip
    return SweepTable(values, rows)


def drawn(points, seed=1):
    return samples_of([read_variation(f"{key}={-math.pi}:{math.pi}") for key in "xyz"], f"saltelli:{points}", 0, seed)


def test_the_indices_are_those_of_the_closed_form():
    """Variances of Ishigami's function by its parts (Saltelli et al., Global sensitivity analysis, 2008, section 2.9)."""
    of_x = 0.5 * (1.0 + B * math.pi**4 / 5.0) ** 2
    of_y = A**2 / 8.0
    of_both = 8.0 * B**2 * math.pi**8 / 225.0  # of x and z together
    whole = of_x + of_y + of_both
    expected = {"x": (of_x, of_x + of_both), "y": (of_y, of_y), "z": (0.0, of_both)}
    found = sobol_indices(table_of(drawn(POINTS)), POINTS)
    assert [each.key for each in found] == ["x", "y", "z"]
    for each in found:
        first, total = (part / whole for part in expected[each.key])
        assert each.first == pytest.approx(first, abs=0.03)
        assert each.total == pytest.approx(total, abs=0.03)
        assert each.first_ends[0] <= each.first <= each.first_ends[1]
        assert each.total_ends[0] <= each.total <= each.total_ends[1]


def test_a_metric_that_a_case_lacks_has_none():
    values = drawn(8)
    lacking = table_of(values, lambda each: math.nan if each is values[5] else ishigami(each))
    assert sobol_indices(lacking, 8) == []


def test_other_samples_are_refused():
    assert drawn_points("saltelli:64") == 64
    assert drawn_points("sobol:64") == 0
    table = table_of(drawn(8)[:-1])
    with pytest.raises(SweepError, match="saltelli:N"):
        sobol_indices(table, 8)
    with pytest.raises(SweepError, match="power of two, 16"):
        drawn(20)
