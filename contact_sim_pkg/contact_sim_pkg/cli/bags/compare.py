"""`bench compare`: the metrics of several bags side by side, against tolerances."""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from contact_sim_pkg.cli.bags.mats import bag_of
from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import overwrite_option, print_json, require_option, show_rows
from contact_sim_pkg.cli.output.working import doing

if TYPE_CHECKING:
    from contact_sim_pkg.compare.side_by_side import Compared, Miss
    from contact_sim_pkg.report.comparison.aligned import MapPair
    from contact_sim_pkg.report.metrics.requirements import Requirement
    from contact_sim_pkg.report.series import Recording


@click.command("compare")
@click.argument("bags", nargs=-1, required=True, metavar="A B...", type=click.Path(path_type=Path))
@click.option(
    "--tolerances", type=click.Path(path_type=Path), metavar="FILE",
    help="YAML: metric or curve, absolute, relative; exit code 1 where a bag misses one against A, 3 where none can be judged.",
)  # fmt: skip
@click.option("--json", "form", flag_value="json", help="One JSON object on standard output.")
@click.option("--csv", "form", flag_value="csv", help="A row a metric.")
@click.option("--junit", "form", flag_value="junit", help="JUnit XML: a test case a tolerance.")
@click.option(
    "--plot", type=click.Path(path_type=Path), metavar="FILE", help="Of a mat and a run: their maps and the difference."
)
@click.option(
    "--loaded",
    type=click.FloatRange(min=0.0),
    default=1.0,
    show_default=True,
    metavar="PA",
    help="Of a mat and a run: pressure above which a cell counts.",
)
@require_option
@overwrite_option
@click.option("--skip-bad", is_flag=True, help="Continue after damaged chunks.")
def command(
    bags: tuple[Path, ...],
    tolerances: Path | None,
    form: str | None,
    plot: Path | None,
    loaded: float,
    wanted: tuple[str, ...],
    overwrite: bool,
    skip_bad: bool,
) -> int:
    """Print the metrics of bags of one rig side by side, what moved most first.

    `bench report A B` draws the page. With tolerances a bag is a regression test of another. A pressure mat (its
    file, or the bag of `bench import`) and a run are laid over each other by shift and turn, which are printed.
    """
    from contact_sim_pkg.bag.errors import BagError
    from contact_sim_pkg.compare.side_by_side import misses, read_tolerances, side_by_side, undecided
    from contact_sim_pkg.records.metric import exit_status
    from contact_sim_pkg.report.comparison.rows import csv_text, junit_text_of, rows_of, table_rows
    from contact_sim_pkg.report.drawing import check_picture
    from contact_sim_pkg.report.metrics.requirements import exit_code, read_requirements

    if form == "junit" and tolerances is None:
        raise click.UsageError("--junit needs --tolerances FILE: a test case is a tolerance.")
    if plot is not None:
        check_picture(plot, bags, overwrite=overwrite)
    allowed = [] if tolerances is None else read_tolerances(tolerances)
    requirements = read_requirements(wanted)
    runs, pair = _runs(bags, loaded, requirements, skip_bad=skip_bad, drawn=plot is not None)
    names, sides, missed = [each.name for each in runs], side_by_side(runs), misses(runs, allowed)
    if not sides:
        raise BagError(f"{', '.join(names)} have no metrics: there is nothing to compare")
    failed, unsure = [miss for _, found in missed for miss in found], undecided(runs, allowed)
    warnings = [f"{each.name}: {said}" for each in runs for said in each.warnings]
    for warning in warnings:
        say(warning, err=True)
    if form == "json":
        print_json({"bags": [str(each) for each in bags], "warnings": warnings, "metrics": rows_of(names, sides),
                    **_alignment(pair),
                    "misses": [miss._asdict() for miss in failed],
                    "undecided": [each._asdict() for each in unsure]})  # fmt: skip
    elif form == "csv":
        say(csv_text(names, sides), nl=False)
    elif form == "junit":
        say(junit_text_of(names, missed, unsure), nl=False)
    else:
        for sentence in [] if pair is None else pair.sentences:
            say(sentence)
        show_rows(table_rows(names, sides), as_json=False)
        _say_judgement(len(allowed), failed, unsure)
    if pair is not None and plot is not None:
        _draw(pair, plot, overwrite=overwrite)
    codes = {exit_code(each.metrics) for each in runs} if requirements else {0}
    return exit_status(missed=bool(failed) or 1 in codes, unjudged=bool(unsure) or 3 in codes)


def _say_judgement(count: int, failed: Sequence[Miss], unsure: Sequence[Miss]) -> None:
    """What misses and what cannot be judged, or that all ``count`` tolerances hold."""
    for miss in failed:
        say(f"MISSED {miss.run}: {miss.sentence}")
    for each in unsure:
        say(f"UNDECIDED {each.sentence}")
    if count and not failed and not unsure:
        say(f"all {count} tolerances hold")


def _runs(
    paths: Sequence[Path], loaded: float, requirements: Sequence[Requirement], *, skip_bad: bool, drawn: bool
) -> tuple[list[Compared], MapPair | None]:
    """The bags as they are compared; of a mat and a run their maps on each other."""
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.compare.side_by_side import Compared
    from contact_sim_pkg.report.comparison.aligned import compare_maps
    from contact_sim_pkg.report.comparison.curves import compared
    from contact_sim_pkg.report.comparison.runs import distinct_names
    from contact_sim_pkg.report.facts import warnings_of
    from contact_sim_pkg.report.metrics.of_bag import recording_of
    from contact_sim_pkg.report.metrics.requirements import required as judged
    from contact_sim_pkg.report.reading import refuse_incomparable

    with ExitStack() as kept:
        opened = [open_bag(bag_of(each, kept.enter_context), skip_bad=skip_bad) for each in paths]
        mats = refuse_incomparable(opened)
        if drawn and not mats:
            raise click.UsageError(
                "--plot draws the maps of a mat and a run; `bench report A B` draws the page of two runs."
            )
        recordings: list[Recording] = []
        for bag in opened:
            doing(f"compare: reading {bag.path}", len(recordings) / len(opened))
            recordings.append(recording_of(bag))
        doing("compare: metrics and curves")
    names = distinct_names(recordings)
    if not mats:
        return [
            compared(name, each, requirements)._replace(warnings=tuple(warnings_of(each)))
            for name, each in zip(names, recordings, strict=True)
        ], None
    pair = compare_maps(names, recordings, loaded)
    return [
        Compared(name, judged(each, requirements), {}) for name, each in zip(names, pair.metrics, strict=True)
    ], pair


def _alignment(pair: MapPair | None) -> dict[str, Any]:
    if pair is None:
        return {}
    by = pair.alignment
    found = {"turn_deg": math.degrees(by.turn), "forward_mm": 1e3 * by.shift_x, "left_mm": 1e3 * by.shift_y,
             "correlation": by.correlation, "moved": pair.names[pair.moved], "notes": "; ".join(pair.sentences[1:])}  # fmt: skip
    return {"alignment": found}


def _draw(pair: MapPair, path: Path, *, overwrite: bool) -> None:
    from contact_sim_pkg.report.comparison.maps import figure_of_maps
    from contact_sim_pkg.report.drawing import save_picture, style

    with style():
        figure, _ = figure_of_maps(pair.names, pair.maps, pair.difference)
        save_picture(figure, path, overwrite=overwrite, dpi=150, facecolor="white")
