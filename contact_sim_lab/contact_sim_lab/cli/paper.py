"""`bench paper`: the five papers, figure by figure, equation by equation, system by system."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from contact_sim_pkg.cli.output.say import announce, say
from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json, show_sections
from contact_sim_pkg.cli.output.working import doing

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

    from contact_sim_lab.records.paper import Number, Paper

DOT = 110  # of a picture [1/inch]


@click.command("paper")
@click.argument("paper", required=False)
@click.argument("source", required=False, metavar="[INPUT]")
@click.option("--figure", metavar="N", help="Draw a figure, and its numbers beside the expected ones.")
@click.option("--equation", metavar="N", help="Evaluate an equation.")
@click.option("--system", metavar="NAME", help="Run a system on an INPUT of your own: a file or a bag.")
@click.option("--set", "given", multiple=True, metavar="KEY=VALUE", help="A value of the figure, equation or system.")
@click.option(
    "--output",
    type=click.Path(path_type=Path),
    metavar="PNG",
    help="Where to draw; with --all the folder of the pages.",
)
@click.option("--all", "everything", is_flag=True, help="Every figure, and the pages of docs/papers.")
@overwrite_option
@json_option
def command(
    paper: str | None, source: str | None, figure: str | None, equation: str | None, system: str | None,
    given: tuple[str, ...], output: Path | None, everything: bool, overwrite: bool, as_json: bool,
) -> None:  # fmt: skip
    """The five papers: systems, figures, equations and errata; each figure with the number expected
    beside the number obtained. Status 1 where a number of a figure is OUTSIDE its tolerance.
    """
    chosen = [name for name, value in (("--figure", figure), ("--equation", equation), ("--system", system)) if value]
    _check_use(paper, chosen, given, output, source, everything)
    from contact_sim_lab.papers import registry

    if everything:
        _all(None if paper is None else registry.paper_of(paper), output, overwrite, as_json)
    elif paper is None:
        _list(as_json)
    elif figure is not None:
        _figure(registry.paper_of(paper), figure, given, output, overwrite, as_json)
    elif equation is not None:
        _equation(registry.paper_of(paper), equation, given, as_json)
    elif system is not None:
        _system(registry.paper_of(paper), system, source, given, output, overwrite, as_json)
    else:
        _contents(registry.paper_of(paper), as_json)


def _check_use(
    paper: str | None, chosen: list[str], given: tuple[str, ...], output: Path | None, source: str | None, everything: bool
) -> None:  # fmt: skip
    """UsageError for options that do not go together."""
    if len(chosen) + everything > 1:
        raise click.UsageError(f"{' and '.join([*chosen, *(['--all'] if everything else [])])} do not go together")
    if chosen and paper is None:
        raise click.UsageError(f"{chosen[0]} needs a PAPER; `bench paper` lists them")
    if given and not chosen:
        raise click.UsageError("--set needs --figure, --equation or --system")
    if source is not None and chosen != ["--system"]:
        raise click.UsageError(f"INPUT {source!r} needs --system")
    if output is not None and (chosen == ["--equation"] or not (chosen or everything)):
        raise click.UsageError("--output needs --figure, --system or --all")


def _list(as_json: bool) -> None:
    from contact_sim_lab.papers.registry import papers
    from contact_sim_pkg.records.table import Section

    rows = [
        {
            "paper": each.key, "title": each.title, "systems": len(each.systems), "figures": len(each.figures),
            "equations": len(each.equations), "errata": len(each.errata),
        }
        for each in papers()
    ]  # fmt: skip
    if as_json:
        print_json({"papers": rows})
    else:
        show_sections([Section("", rows, "bench paper PAPER lists its systems, figures and equations")])


def _contents(paper: Paper, as_json: bool) -> None:
    from contact_sim_pkg.records.table import Section

    systems = [
        {
            "system": each.name,
            "what": each.title,
            "equations": each.equations,
            "command": each.command,
            "shown in": "; ".join(place for _, place in each.shows),
        }
        for each in paper.systems
    ]
    figures = [
        {"figure": each.number, "what": each.title, "judged": each.kind, "by": each.judged_by} for each in paper.figures
    ]
    equations = [
        {
            "equation": each.number, "what": each.title, "formula": each.formula,
            "keys": ", ".join(f"{one.name}={_shown(one.default)}" for one in each.parameters), "lives in": each.place,
        }
        for each in paper.equations
    ]  # fmt: skip
    if as_json:
        print_json({
            "paper": paper.key, "title": paper.title, "authors": paper.authors, "year": paper.year, "models": paper.models,
            "systems": systems, "figures": figures, "equations": equations, "errata": [each._asdict() for each in paper.errata],
        })  # fmt: skip
        return
    say(f"{paper.title}\n{paper.authors} ({paper.year})\n\n{paper.models}\n")
    show_sections(
        [
            Section("Systems", systems),
            Section("Figures", figures, paper.not_shown),
            Section("Equations", equations, f"{len(paper.errata)} errata: docs/papers/{paper.page}"),
        ]
    )


def _figure(
    paper: Paper, number: str, given: Sequence[str], output: Path | None, overwrite: bool, as_json: bool
) -> None:
    from contact_sim_lab.papers.registry import drawn, figure_of, values_of
    from contact_sim_pkg.records.table import Section

    figure = figure_of(paper, number)
    owner = f"{paper.key}, figure {number}"
    values = values_of(owner, figure.parameters, given)
    place = _output(output, f"{paper.key}_figure_{number}.png", overwrite)
    doing(f"{paper.short}, figure {number}: {figure.title}")
    found = drawn(figure, values)
    rows = [each.row() for each in found.numbers]
    save(place, found.draw, found.size, overwrite=overwrite)
    if as_json:
        print_json({
            "paper": paper.key, "figure": number, "title": figure.title, "kind": figure.kind, "judged_by": figure.judged_by,
            "values": values, "numbers": rows, "output": str(place),
        })  # fmt: skip
    else:
        shown = [_line(each) for each in found.numbers]
        title = f"{paper.short}, figure {number}: {figure.title}"
        show_sections([Section(title, shown, f"{figure.kind}: {figure.judged_by}\ndrawn in {place}")])
    _end([row["verdict"] for row in rows])


def _end(verdicts: Sequence[str]) -> None:
    """Status 1 where a number is beyond its tolerance, 3 where one was not obtained."""
    from contact_sim_pkg.records.metric import exit_status

    status = exit_status(missed="OUTSIDE" in verdicts, unjudged="not reached" in verdicts)
    click.get_current_context().exit(status)


def _line(number: Number) -> dict[str, Any]:
    """A number of a figure as a person reads it."""
    row = number.row()
    values = {key: None if row[key] is None else f"{row[key]:.6g}" for key in ("expected", "obtained")}
    allowed = f"{row['tolerance']:.2g}{' of it' if row['relative'] else ''}" if row["expected"] is not None else ""
    return {
        "quantity": row["quantity"], "unit": row["unit"], **values, "difference": number.shown_difference(3), "allowed": allowed,
        "verdict": row["verdict"], "origin of the expected value": row["origin"], "note": row["note"],
    }  # fmt: skip


def _equation(paper: Paper, number: str, given: Sequence[str], as_json: bool) -> None:
    from contact_sim_lab.papers.registry import equation_of, evaluate, values_of
    from contact_sim_pkg.records.table import Section

    equation = equation_of(paper, number)
    values = values_of(f"{paper.key}, equation {number}", equation.parameters, given)
    results = evaluate(equation, values)
    units = dict(equation.results)
    if as_json:
        print_json({
            "paper": paper.key, "equation": number, "formula": equation.formula, "values": values, "results": results,
            "units": units, "place": equation.place,
        })  # fmt: skip
        return
    keys = [
        {"key": each.name, "value": _shown(values[each.name]), "unit": each.unit, "range": each.range}
        for each in equation.parameters
    ]
    found = [{"result": name, "value": _shown(value), "unit": units[name]} for name, value in results.items()]
    title = f"{paper.short}, eq {number}: {equation.title}"
    show_sections([Section(title, keys, equation.formula), Section("", found, equation.place)])


def _system(
    paper: Paper, name: str, source: str | None, given: Sequence[str], output: Path | None, overwrite: bool, as_json: bool
) -> None:  # fmt: skip
    from contact_sim_lab.papers.registry import load, system_of, values_of
    from contact_sim_lab.records.paper import PaperError, SystemResult
    from contact_sim_pkg.records.table import Section

    system = system_of(paper, name)
    if bool(system.input) != (source is not None):
        needed = f"an INPUT is needed: {system.input}" if system.input else "it takes no INPUT"
        raise PaperError(f"{paper.key}, system {name}: {needed}")
    values = values_of(f"{paper.key}, system {name}", system.parameters, given)
    place = _output(output, f"{paper.key}_{name}.png", overwrite, [] if source is None else [Path(source)])
    doing(f"{paper.short}: {system.title}")
    result: SystemResult = load(system.run)(None if source is None else Path(source), values)
    if result.draw is not None:
        save(place, result.draw, result.size, overwrite=overwrite)
    drawn = None if result.draw is None else str(place)
    if as_json:
        print_json({"paper": paper.key, "system": name, "values": values, "rows": list(result.rows),
                    "course": list(result.course), "note": result.note, "output": drawn})  # fmt: skip
        return
    note = "\n".join(filter(None, (result.note, drawn and f"drawn in {drawn}")))
    rows, course = (
        [{key: _six_digits(value) for key, value in row.items()} for row in table]
        for table in (result.rows, result.course)
    )
    sections = [Section(f"{paper.short}: {system.title}", rows, note)]
    show_sections([*sections, *([Section("", course)] if course else [])])


def _all(paper: Paper | None, output: Path | None, overwrite: bool, as_json: bool) -> None:
    from contact_sim_lab.pages.paper_pages import write_pages
    from contact_sim_lab.papers.registry import papers
    from contact_sim_pkg.records.table import Section

    chosen = papers() if paper is None else [paper]
    rows = write_pages(chosen, output or Path("docs/papers"), overwrite=overwrite, progress=announce)
    counted = {
        verdict: sum(row["verdict"] == verdict for row in rows)
        for verdict in dict.fromkeys(row["verdict"] for row in rows)
    }
    if as_json:
        print_json({"figures": rows, "counted": counted})
    else:
        show_sections([Section("", rows, ", ".join(f"{count} {verdict}" for verdict, count in counted.items()))])
    _end([*counted, *("not reached" for row in rows if row["not reached"])])


def _output(output: Path | None, name: str, overwrite: bool, inputs: Sequence[Path] = ()) -> Path:
    """The picture's place, refused before anything is computed where it cannot be written. A picture of this command
    is made again.
    """
    from contact_sim_lab.papers.drawing import made_here
    from contact_sim_pkg.files import check_output

    place = output if output is not None else Path(name)
    check_output(place, list(inputs), overwrite=overwrite, ours=made_here)
    return place


def save(place: Path, draw: Callable[[Canvas], None], size: tuple[float, float], *, overwrite: bool) -> None:
    """Draw on a canvas of this size [inch] and write it as PNG."""
    from contact_sim_lab.papers.drawing import made_here, picture
    from contact_sim_pkg.files import new_file

    with new_file(place, overwrite=overwrite, ours=made_here) as file:
        file.write(picture(draw, size, DOT))


def _six_digits(value: Any) -> Any:
    if isinstance(value, (tuple, list)):
        return ", ".join(_six_digits(each) for each in value)
    return f"{value:.6g}" if isinstance(value, float) else value


def _shown(value: Any) -> str:
    if isinstance(value, (tuple, list)):
        return ", ".join(_shown(each) for each in value)
    return f"{value:.9g}" if isinstance(value, float) else str(value)
