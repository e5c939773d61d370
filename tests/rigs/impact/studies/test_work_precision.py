"""Work and precision of the impact: published errors of inexpensive levels; expensive ones meet the reference."""

import pytest

from contact_sim_lab.accuracy import work_precision
from contact_sim_lab.records import work_precision as records
from contact_sim_lab.rigs.impact import work_precision as impact_levels
from contact_sim_lab.rigs.impact import work_precision_material as impact_material
from contact_sim_lab.rigs.impact import work_precision_memory as memory_studies


@pytest.fixture(scope="module", autouse=True)
def few_samples():
    kept = records.FEWEST, records.BUDGET
    records.FEWEST, records.BUDGET = 1, 0.0
    yield
    records.FEWEST, records.BUDGET = kept


@pytest.fixture(scope="module")
def rows():
    return impact_levels.rows()


def value_of(rows, loss_tangent, quantity, level, end="force", key="value"):
    case = f"tan β = {loss_tangent:g}, end {end}"
    found = [row[key] for row in rows if (row["case"], row["quantity"], row["level"]) == (case, quantity, level)]
    return found[0] if found else None


@pytest.mark.parametrize("level", ["table", "integrated"])
def test_the_expensive_levels_meet_the_reference_in_every_quantity(rows, level):
    chosen = [row for row in rows if row["level"] == level]
    assert {row["quantity"] for row in chosen} == set(impact_levels.QUANTITIES)
    assert max(row["error"] for row in chosen) < 1e-9
    assert len(chosen) >= 60


@pytest.mark.parametrize(
    ("loss_tangent", "of_66", "printed", "corrected"), [(0.01, 0.9811, 0.9540, 0.9647), (0.2, 0.6793, 0.3509, 0.4672)]
)
def test_the_published_restitutions_of_the_inexpensive_levels_come_out(rows, loss_tangent, of_66, printed, corrected):
    for level, expected in (
        ("closed forms, printed", of_66),
        ("equivalent constants, printed", printed),
        ("equivalent constants, corrected", corrected),
    ):
        assert value_of(rows, loss_tangent, "restitution", level) == pytest.approx(expected, abs=5.1e-5)


def test_a_form_without_an_answer_has_no_row(rows):
    assert value_of(rows, 0.4, "restitution", "equivalent constants, printed") is None
    assert value_of(rows, 0.4, "restitution", "equivalent constants, corrected") is not None
    assert value_of(rows, 0.6, "restitution", "equivalent constants, corrected") is None


def test_the_corrected_constants_are_nearer_where_the_bodies_part_at_the_gap(rows):
    for loss_tangent in (0.05, 0.1, 0.2, 0.3):
        by_end = [
            value_of(rows, loss_tangent, "restitution", "equivalent constants, corrected", end, "error")
            for end in ("gap", "force")
        ]
        assert by_end[0] < 0.01
        assert by_end[0] < by_end[1]


def test_the_material_comes_back_by_the_motion_and_twice_as_stiff_by_the_closed_form():
    found = impact_material.rows()
    assert max(row["error"] for row in found if row["level"] == "exact") < 1e-9
    first = next(row for row in found if (row["level"], row["quantity"]) == ("corrected", "E'"))
    assert first["value"] / first["expected"] == pytest.approx(2.2, abs=0.05)


def test_the_front_s_formulas_come_nearer_for_slow_impacts():
    found = impact_material.front_rows()
    assert max(row["error"] for row in found if row["level"] == "integrated") < 1e-9
    small = [row["error"] for row in found if row["level"] == "small times"]
    assert small == sorted(small)
    assert small[-1] < 2e-3


def test_the_rig_has_a_work_precision_study():
    assert [entry.part for entry in work_precision.studies_of("impact")] == [
        impact_levels.PART,
        impact_material.PART,
        impact_material.FRONT_PART,
        memory_studies.HISTORY_PART,
        memory_studies.RESPONSE_PART,
    ]
