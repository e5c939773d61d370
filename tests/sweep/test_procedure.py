"""Test procedures: their cases, their tables with units, cases that fail, and their page."""

import csv
import math
from xml.etree import ElementTree

from contact_sim_pkg.records.procedure import Curve, Procedure, ProcedureError, Quantity, Sheet
from contact_sim_pkg.report.place import is_page
from contact_sim_pkg.sweep.procedure import Subject, junit_of, run_procedures, write_tables
from contact_sim_pkg.sweep.procedure_page import write_test_page

HERE = "tests.sweep.test_procedure"
QUANTITIES = {
    "load": Quantity("load", "N", "kN", 1e-3),
    "speed": Quantity("speed", "m/s", zero="at rest"),
    "force": Quantity("force", "N"),
    "share": Quantity("share", ""),
}
PROCEDURE = Procedure(
    "spring", "A spring", f"{HERE}:stretched", f"{HERE}:stretched", {"speed": (0.0, 2.0), "load": (1.0, 3.0)}, {"offset": 5.0},
    (Sheet("", ("force", "share"), (Curve("load", "force"),)),), "Hooke",
)  # fmt: skip


def stretched(factor, conditions):
    if conditions["load"] > 3.0:
        raise ProcedureError("too heavy")
    share = math.nan if conditions["speed"] == 0.0 else 0.5
    return {"": [{"force": factor * conditions["load"] + conditions["offset"], "share": share}]}


OWN = (Subject("bench", 10.0),)


def run(folder, procedure=PROCEDURE, subjects=OWN):
    (found,) = run_procedures([procedure], subjects, folder, jobs=1)
    return found


def test_a_case_for_each_combination_with_what_is_held():
    assert list(PROCEDURE.conditions()) == [
        {"offset": 5.0, "speed": speed, "load": load} for speed in (0.0, 2.0) for load in (1.0, 3.0)
    ]


def test_a_held_quantity_at_several_values_is_varied_and_one_at_one_value_stays_what_it_is():
    several = PROCEDURE.at("offset", (1.0, 2.0))
    assert several.varied["offset"] == (1.0, 2.0)
    assert several.held == {}
    assert PROCEDURE.at("offset", (1.0,)).held == {"offset": 1.0}
    assert PROCEDURE.at("load", (7.0,)).varied["load"] == (7.0,)
    assert PROCEDURE.at("mass", (7.0,)) is PROCEDURE


def test_the_table_holds_si_units_subjects_and_nothing_for_what_is_unknown(tmp_path):
    tested = run(tmp_path, subjects=(Subject("bench", 10.0), Subject("a.tir", 100.0, is_formula=True)))
    (path,) = write_tables(tested, QUANTITIES, tmp_path)
    header, *rows = csv.reader(path.open())
    assert header == ["tire", "speed [m/s]", "load [N]", "force [N]", "share"]
    assert rows[:3] == [
        ["bench", "0", "1", "15", ""], ["bench", "0", "3", "35", ""], ["bench", "2", "1", "15", "0.5"],
    ]  # fmt: skip
    assert rows[-1] == ["a.tir", "2", "3", "305", "0.5"]


def test_a_case_that_has_run_does_not_run_again_and_other_data_do(tmp_path):
    run(tmp_path)
    again = run(tmp_path)
    assert all(row["again"] for _, row in again.cases)
    other = run(tmp_path, subjects=(Subject("bench", 11.0),))
    assert not any(row.get("again") for _, row in other.cases)
    assert other.cases[0][1]["sheets"][""][0]["force"] == 16.0


def test_a_case_that_fails_leaves_the_others_and_is_an_error_of_junit(tmp_path):
    tested = run(tmp_path, PROCEDURE.at("load", (1.0, 4.0)))
    assert [(case.conditions["load"], sentence) for case, sentence in tested.failures] == [(4.0, "too heavy")] * 2
    root = ElementTree.fromstring(junit_of("spring", [tested]))
    assert [suite.get("errors") for suite in root] == ["2"]
    assert root.findall(".//error")[0].get("message") == "too heavy"


def test_the_page_has_curves_rows_and_the_command(tmp_path):
    tested = run(tmp_path, subjects=(Subject("bench", 10.0), Subject("a.tir", 100.0, is_formula=True)))
    path = write_test_page(tmp_path / "spring.html", "spring", [tested], QUANTITIES | {"offset": QUANTITIES["force"]}, "", {
        "spring": "bench tire test spring"})  # fmt: skip
    text = path.read_text()
    assert is_page(path)
    for said in (
        "load [kN]",
        "at rest",
        "All 8 rows of spring",
        "bench tire test spring",
        "Dashed: a.tir",
        "8 of 8 cases",
    ):
        assert said in text
