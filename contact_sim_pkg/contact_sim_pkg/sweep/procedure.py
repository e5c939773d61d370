"""Test procedures over the processors: each case on its machine, the rows of all in one table a sheet."""

from __future__ import annotations

import csv
import hashlib
import io
import json
import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree

from contact_sim_pkg.files import RefusedError, new_file
from contact_sim_pkg.records.procedure import Procedure, Quantity, Rows, Sheet
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.metrics.views import suite_of_cases, xml_text
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.sweep.case import FAILED, FINISHED, Row, failed, kept_row, sources_hash
from contact_sim_pkg.sweep.pool import Workers
from contact_sim_pkg.sweep.sweep import CASES, Notify, processors

__all__ = ["Subject", "Test", "Tested", "junit_of", "run_procedures", "write_tables"]


class Subject(NamedTuple):
    """What is put on the machines."""

    name: str
    data: Any  # first argument of a machine, plain
    is_formula: bool = False  # measured by the formula of a procedure, not by its machine


class Test(NamedTuple):
    """One case of a procedure."""

    number: int
    procedure: str
    subject: str
    machine: str  # `module:name`
    data: Any
    conditions: Mapping[str, float]
    folder: str
    sources: str

    @property
    def condition_text(self) -> str:
        """`load=3335, speed=16.67`."""
        return ", ".join(f"{name}={value:.6g}" for name, value in self.conditions.items())


class Tested(NamedTuple):
    """A procedure that has run."""

    procedure: Procedure
    cases: list[tuple[Test, Row]]

    @property
    def failures(self) -> list[tuple[Test, str]]:
        """Cases that gave nothing, and why."""
        return [(case, row["sentence"]) for case, row in self.cases if row["outcome"] != FINISHED]

    def rows(self, sheet: Sheet, subject: str) -> Rows:
        """Varied quantities and columns of a sheet of one subject."""
        own = [(case, row) for case, row in self.cases if case.subject == subject and row["outcome"] == FINISHED]
        return [
            {**{name: case.conditions[name] for name in self.procedure.varied}, **_numbers(cells)}
            for case, row in own for cells in row["sheets"].get(sheet.name, [])
        ]  # fmt: skip

    @property
    def subjects(self) -> list[str]:
        """In their order."""
        return list(dict.fromkeys(case.subject for case, _ in self.cases))


def run_procedures(
    procedures: Sequence[Procedure], subjects: Sequence[Subject], folder: Path, *, jobs: int | None = None,
    notify: Notify = lambda _text, _done: None, ended: Callable[[Tested], None] = lambda _tested: None,
) -> list[Tested]:  # fmt: skip
    """Run every case that has not run in the ``folder`` before, and return the procedures with their rows.

    Args:
        procedures: one after another.
        subjects: tires and files.
        folder: keeps a row a case.
        jobs: processes; None: as many as there are processors.
        notify: gets what is being done, and how much of all.
        ended: gets each procedure when its cases have run.
    """
    (folder / CASES).mkdir(parents=True, exist_ok=True)
    planned = [(each, list(_tests(each, subjects, folder))) for each in procedures]
    total, done, began = sum(len(tests) for _, tests in planned), 0, time.perf_counter()
    found, left = [], ""
    with Workers(jobs or processors(), run_test) as workers:
        for procedure, tests in planned:
            rows: dict[int, Row] = {}
            notify(f"{procedure.name}: {len(tests)} cases; {done} of {total} done", done / max(total, 1))
            # The first alone compiles what the others load
            for row in chain(workers.run(tests[:1]), workers.run(tests[1:])):
                rows[row["number"]] = row
                done += 1
                if done > 2:
                    left = f", about {(time.perf_counter() - began) / done * (total - done):.0f} s left"
                notify(
                    f"{procedure.name}: {len(rows)} of {len(tests)} cases; {done} of {total} in all{left}", done / total
                )
            found.append(Tested(procedure, [(each, rows[each.number]) for each in tests]))
            ended(found[-1])
    return found


def _tests(procedure: Procedure, subjects: Sequence[Subject], folder: Path) -> Iterator[Test]:
    number = 0
    for subject in subjects:
        machine = procedure.formula if subject.is_formula else procedure.machine
        for conditions in procedure.conditions() if machine else ():
            yield Test(
                number,
                procedure.name,
                subject.name,
                machine,
                subject.data,
                conditions,
                str(folder.absolute()),
                sources_hash(),
            )
            number += 1


def run_test(test: Test) -> Row:
    """The row of a case, kept in the folder; one that is there does not run again."""
    key = json.dumps([test.machine, test.data, dict(test.conditions), test.sources], sort_keys=True)
    kept = Path(test.folder) / CASES / f"{hashlib.sha256(key.encode()).hexdigest()[:20]}.json"
    if (found := kept_row(kept)) is not None:
        return {**found, "number": test.number, "again": True}
    began = time.process_time()
    try:
        sheets = load(test.machine)(test.data, test.conditions)
    except (RunError, RefusedError, MemoryError, ArithmeticError) as error:
        return failed(test, str(error) or "memory ran out", FAILED)
    row = {"number": test.number, "outcome": FINISHED, "sentence": "", "sheets": _plain(sheets),
           "cpu": time.process_time() - began}  # fmt: skip
    with new_file(kept, overwrite=True) as file:
        file.write(json.dumps(row).encode())
    return row


def write_tables(tested: Tested, quantities: Mapping[str, Quantity], folder: Path) -> list[Path]:
    """Write ``NAME.csv`` and ``NAME_SHEET.csv``: whose row it is, the varied quantities and the columns, in SI units."""
    procedure, paths = tested.procedure, []
    for sheet in procedure.sheets:
        names = (*procedure.varied, *(each for each in sheet.columns if each not in procedure.varied))
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(["tire", *(_heading(name, quantities[name]) for name in names)])
        for subject in tested.subjects:
            for row in tested.rows(sheet, subject):
                writer.writerow([subject, *(_cell(row.get(name, math.nan)) for name in names)])
        paths.append(folder / f"{'_'.join(filter(None, (procedure.name, sheet.name)))}.csv")
        with new_file(paths[-1], overwrite=True) as file:
            file.write(text.getvalue().encode())
    return paths


def junit_of(name: str, tested: Sequence[Tested]) -> str:
    """JUnit XML: a suite a procedure, in it a test a case; one that did not finish is an error."""
    root = ElementTree.Element("testsuites", name=name)
    for each in tested:
        cases = []
        for case, row in each.cases:
            element = ElementTree.Element("testcase", classname=case.subject, name=case.condition_text)
            if row["outcome"] != FINISHED:
                ElementTree.SubElement(element, "error", message=row["sentence"])
            cases.append(element)
        root.append(suite_of_cases(each.procedure.name, cases))
    return xml_text(root)


def _heading(name: str, quantity: Quantity) -> str:
    return f"{name} [{quantity.unit}]" if quantity.unit else name


def _cell(value: float) -> str:
    return f"{value:.9g}" if math.isfinite(value) else ""


def _plain(sheets: Mapping[str, Rows]) -> dict[str, Any]:
    """JSON knows no nan: None."""
    return {
        name: [{key: value if math.isfinite(value) else None for key, value in row.items()} for row in rows]
        for name, rows in sheets.items()
    }


def _numbers(cells: Mapping[str, float | None]) -> dict[str, float]:
    return {name: math.nan if value is None else value for name, value in cells.items()}
