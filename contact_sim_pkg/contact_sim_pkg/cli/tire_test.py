"""`bench tire test`: the standard procedures of a tire's test bench on the tire of a scene."""

from __future__ import annotations

import shlex
import time
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json, show_rows
from contact_sim_pkg.cli.output.working import doing

if TYPE_CHECKING:
    from contact_sim_pkg.records.procedure import Procedure
    from contact_sim_pkg.rigs.vehicle.machines.specimen import Specimen
    from contact_sim_pkg.rigs.vehicle.tire.magic_formula.coefficients import MagicFormula
    from contact_sim_pkg.sweep.procedure import Tested

ALL = "all"


@click.command("test")
@click.argument("name", required=False, metavar="NAME|all")
@click.argument("scene", required=False, metavar="SCENE|FILE.tir")
@click.option("--out", type=click.Path(path_type=Path), default=None, metavar="DIR", help="Folder of tables and pages.")
@click.option(
    "--at",
    "at",
    multiple=True,
    metavar="QUANTITY=V,V,...",
    help="Other values of a condition, in SI units: load=2000,4000.",
)
@click.option("--set", "assignments", multiple=True, metavar="A.B.C=VALUE", help="Change one value of the scene.")
@click.option(
    "--beside",
    type=click.Path(path_type=Path),
    default=None,
    metavar="FILE.tir",
    help="Magic Formula drawn beside, dashed.",
)
@click.option(
    "--jobs", type=click.IntRange(1, 1024), default=None, metavar="N", help="Processes.  [default: processors]"
)
@click.option("--junit", "junit_file", type=click.Path(path_type=Path), default=None, metavar="FILE", help="JUnit XML.")
@overwrite_option
@json_option
def test_command(
    name: str | None, scene: str | None, out: Path | None, at: tuple[str, ...], assignments: tuple[str, ...],
    beside: Path | None, jobs: int | None, junit_file: Path | None, overwrite: bool, as_json: bool,
) -> int:  # fmt: skip
    """Run the standard procedure NAME, or all, on the tire of SCENE: a table in SI units and a page with its curves a
    procedure. SCENE may be a property file: the tire that is fitted to it, the Magic Formula of the file beside. Without
    NAME, list them.

    The tire is that of the scene's effects, alone on a test machine: its road, speed and slip do not count. Cases that
    have run do not run again. Exit code 1 where a case failed.
    """
    from contact_sim_pkg.rigs.vehicle.machines.procedures import QUANTITIES, procedures_of
    from contact_sim_pkg.rigs.vehicle.machines.specimen import refuse_beyond_law

    if name is None:
        from contact_sim_pkg.rigs.vehicle.machines.specimen import USUAL

        _list(procedures_of(USUAL), as_json=as_json)
        return 0
    if scene is None:
        raise click.UsageError("Missing argument 'SCENE'.")
    if out is None:
        raise click.UsageError("--out DIR is where tables and pages go")
    from contact_sim_pkg.files import check_output
    from contact_sim_pkg.rigs.vehicle.tire.magic_formula.coefficients import magic_formula
    from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file
    from contact_sim_pkg.sweep.procedure import Subject, junit_of, run_procedures, write_tables
    from contact_sim_pkg.sweep.procedure_page import write_test_page
    from contact_sim_pkg.sweep.sweep import check_folder

    check_folder(out)
    if junit_file is not None:
        check_output(junit_file, overwrite=overwrite)
    began = time.monotonic()
    specimen, own = _specimen(scene, assignments)
    beside = beside or own
    chosen = _changed(_chosen(name, procedures_of(specimen)), at)
    subjects = [Subject("bench", specimen.effects)]
    if beside is not None:
        formula = magic_formula(read_property_file(beside))
        subjects.append(Subject(beside.name, str(beside.absolute()), is_formula=True))
        _say_keys(formula)
    for conditions in _heaviest(chosen, specimen.inflation):
        doing(f"checking the load at {1e-3 * conditions['inflation']:g} kPa")
        refuse_beyond_law(specimen.effects, conditions)

    options = "".join(
        f" {option} {shlex.quote(str(value))}"
        for option, values in (("--set", assignments), ("--at", at), ("--beside", [beside] if beside else []))
        for value in values
    )
    again = {each.name: f"bench tire test {each.name} {shlex.quote(scene)} --out {shlex.quote(str(out))}{options}"
             for each in chosen}  # fmt: skip
    notes = f"inflation {1e-3 * specimen.inflation:g} kPa, standing load {specimen.load:.0f} N" + (
        f"; dashed: {beside.name}" if beside else ""
    )

    def finish(tested: Tested) -> None:
        write_tables(tested, QUANTITIES, out)
        own = tested.procedure.name
        write_test_page(out / f"{own}.html", f"{Path(scene).stem}, {own}", [tested], QUANTITIES, notes, again)

    try:
        found = run_procedures(chosen, subjects, out, jobs=jobs, notify=doing, ended=finish)
    except KeyboardInterrupt:
        say(f"interrupted; what has ended is in {out}, the same command goes on", err=True)
        return 1
    if junit_file is not None:
        from contact_sim_pkg.files import new_file

        with new_file(junit_file, overwrite=overwrite) as file:
            file.write(junit_of("tire test", found).encode())
    page = out / f"{name}.html"
    if name == ALL:
        doing("drawing the page")
        write_test_page(page, Path(scene).stem, found, QUANTITIES, notes, again)
    _show(found, out, page, time.monotonic() - began, as_json=as_json)
    return 1 if any(each.failures for each in found) else 0


def _specimen(scene: str, assignments: tuple[str, ...]) -> tuple[Specimen, Path | None]:
    """The tire of a scene, or that fitted to a property file, with the file where it has a Magic Formula."""
    from contact_sim_pkg.rigs.vehicle.machines.specimen import specimen_of, specimen_of_file
    from contact_sim_pkg.rigs.vehicle.tire.magic_formula.coefficients import has_formula
    from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file
    from contact_sim_pkg.scene.load import load_scene
    from contact_sim_pkg.scene.overrides import set_value

    if not scene.lower().endswith(".tir"):
        return specimen_of(load_scene(scene, [set_value(each) for each in assignments])), None
    if assignments:
        raise click.UsageError("--set changes a scene; a property file has none")
    doing(f"fitting the tire of {Path(scene).name}")
    tire = read_property_file(Path(scene))
    return specimen_of_file(tire), Path(scene) if has_formula(tire) else None


def _list(procedures: dict[str, Procedure], *, as_json: bool) -> None:
    show_rows(
        [
            {"procedure": each.name, "what": each.title, "cases": len([*each.conditions()]),
             "varied": ", ".join(each.varied), "after": each.source}
            for each in procedures.values()
        ],
        as_json,
    )  # fmt: skip


def _chosen(name: str, known: dict[str, Procedure]) -> list[Procedure]:
    """Raises ProcedureError for a name that is none."""
    from contact_sim_pkg.records.procedure import ProcedureError

    if name == ALL:
        return [*known.values()]
    if name not in known:
        near = get_close_matches(name.lower(), known, n=1, cutoff=0.5)
        hint = f"; did you mean {near[0]}?" if near else ""
        raise ProcedureError(f"{name!r} is no procedure; there are {', '.join(known)}, and {ALL}{hint}")
    return [known[name]]


def _changed(procedures: list[Procedure], at: tuple[str, ...]) -> list[Procedure]:
    """With the values of `--at`. Raises ProcedureError for a quantity or a value that is none of theirs."""
    from contact_sim_pkg.records.procedure import ProcedureError
    from contact_sim_pkg.rigs.vehicle.machines.procedures import QUANTITIES

    for text in at:
        quantity, _, listed = text.partition("=")
        conditions = list(dict.fromkeys(name for each in procedures for name in (*each.varied, *each.held)))
        if quantity not in conditions:
            raise ProcedureError(f"--at {text}: {quantity!r} is no condition here; there are {', '.join(conditions)}")
        try:
            values = tuple(float(part) for part in listed.split(","))
        except ValueError:
            raise ProcedureError(f"--at {text}: numbers with commas between them were expected") from None
        known = QUANTITIES[quantity]
        for value in values:
            if not known.least <= value <= known.most:
                unit = f" {known.unit}" if known.unit else ""
                raise ProcedureError(
                    f"--at {text}: {value:g}{unit}; {known.least:g} to {known.most:g}{unit} is allowed"
                )
        procedures = [each.at(quantity, tuple(dict.fromkeys(values))) for each in procedures]
    return procedures


def _say_keys(formula: MagicFormula) -> None:
    """Which keys of the file count, and which nothing uses, by name."""
    for note in formula.notes:
        say(f"{formula.file}: {note}", err=True)
    ignored = f"; nothing uses {', '.join(formula.ignored)}" if formula.ignored else ""
    say(f"{formula.file}: Magic Formula {formula.version}, {len(formula.used)} keys{ignored}", err=True)


def _heaviest(procedures: list[Procedure], inflation: float) -> list[dict[str, float]]:
    """Of each inflation and drum the conditions with the largest load."""
    found: dict[tuple[float, float], dict[str, float]] = {}
    for each in procedures:
        for conditions in each.conditions():
            if "load" in conditions:
                whole = {"inflation": inflation, **conditions}
                key = whole["inflation"], whole.get("drum_diameter", 0.0)
                found[key] = max(found.get(key, whole), whole, key=lambda one: one["load"])
    return list(found.values())


def _show(found: list[Tested], out: Path, page: Path, spent: float, *, as_json: bool) -> None:
    rows = [
        {"procedure": each.procedure.name, "cases": len(each.cases), "failed": len(each.failures),
         "again": sum(row.get("again", False) for _, row in each.cases),
         "CPU s": round(sum(row.get("cpu", 0.0) for _, row in each.cases if not row.get("again", False)), 1)}
        for each in found
    ]  # fmt: skip
    failures = [(case, sentence) for each in found for case, sentence in each.failures]
    if as_json:
        print_json({
            "procedures": rows, "page": str(page), "out": str(out), "seconds": round(spent, 1),
            "failed": [{"procedure": case.procedure, "conditions": dict(case.conditions), "sentence": sentence}
                       for case, sentence in failures],
        })  # fmt: skip
        return
    show_rows(rows, False)
    for case, sentence in failures:
        say(f"{case.procedure} ({case.condition_text}) did not finish: {sentence}", err=True)
    say(f"{len(found)} procedures in {spent:.0f} s; tables in {out}, {page} shows them")
