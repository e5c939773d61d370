"""`bench fit`: keys of a scene from what was measured."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import json_option, print_json, show_rows
from contact_sim_pkg.cli.output.working import doing

if TYPE_CHECKING:
    from contact_sim_pkg.sweep.fit import Fit

COLUMNS = "key", "value", "from", "to", "remark"


@click.command("fit")
@click.argument("scene")
@click.option(
    "--to", "file", type=click.Path(path_type=Path), required=True, metavar="FILE",
    help="What was measured: a table of points, a bag or a table over time, or T(f) over frequency.",
)  # fmt: skip
@click.option(
    "--free",
    "ranges",
    multiple=True,
    required=True,
    metavar="KEY=LOW:HIGH",
    help="Key to fit, and its range; :log behind it.",
)
@click.option(
    "--set", "fixed", multiple=True, metavar="KEY=VALUE", help="Set in every run, as of bench run; an accuracy is held."
)
@click.option("--metric", "metrics", multiple=True, metavar="NAME", help="Column of the points, a metric by its key.")
@click.option(
    "--series", multiple=True, metavar="TOPIC.COLUMN",
    help="What of a run is compared over time; with --by transmissibility the accelerations of floor and seat in FILE.",
)  # fmt: skip
@click.option(
    "--by", type=click.Choice(["series", "spectrum", "transmissibility"]), default="series", show_default=True,
    help="What of a recording is compared: the samples of a series, its densities where runs go apart in time, or T(f) of a "
    "seat.",
)  # fmt: skip
@click.option(
    "--shift", type=click.FloatRange(0.0, 10.0), default=0.02, show_default=True, metavar="S",
    help="With --series: most that the recording may be late or early; 0 holds it.",
)  # fmt: skip
@click.option(
    "--jobs", type=click.IntRange(1, 1024), default=None, metavar="N", help="Processes.  [default: processors]"
)
@click.option(
    "--out", type=click.Path(path_type=Path), required=True, metavar="DIR", help="Folder: fitted.yaml, cases."
)
@json_option
def command(
    scene: str,
    file: Path,
    ranges: tuple[str, ...],
    fixed: tuple[str, ...],
    metrics: tuple[str, ...],
    series: tuple[str, ...],
    by: str,
    shift: float,
    jobs: int | None,
    out: Path,
    as_json: bool,
) -> int:
    """Fit keys of SCENE to what was measured, and say between what they are.

    With --metric FILE is a table: columns of keys set the cases, columns of metrics are what was measured. With --series it
    is a recording of one run, with --by transmissibility it holds T(f) of a seat. Runs request a finer accuracy than the
    scene where the intervals need it. Writes fitted.yaml and fit.html. Exit code 1 where the scene cannot follow what was
    measured, 3 where a key is not identifiable.
    """
    from contact_sim_pkg.sweep.fit import fit
    from contact_sim_pkg.sweep.fit_page import write_fit_page
    from contact_sim_pkg.sweep.measured import read_measured
    from contact_sim_pkg.sweep.page import PAGES
    from contact_sim_pkg.sweep.sweep import check_folder
    from contact_sim_pkg.sweep.variation import read_variation

    check_folder(out)
    free = [read_variation(each, "--free") for each in ranges]
    wrong = next((each for each in fixed if "=" not in each), None)
    if wrong is not None:
        raise click.UsageError(f"--set {wrong}: is not of the form KEY=VALUE")
    given = {key.strip(): value.strip() for key, _, value in (each.partition("=") for each in fixed)}
    to = read_measured(file, metrics, series, by)
    try:
        found = fit(
            scene, to, free, out, fixed=given, jobs=jobs, most_shift=shift, by_spectrum=by == "spectrum", notify=doing
        )
    except KeyboardInterrupt:
        say(f"interrupted; the runs so far are in {out}, the same command goes on", err=True)
        return 1
    doing("drawing the page")
    page = write_fit_page(out / PAGES["fit"], scene, found)
    if as_json:
        facts = {key: value for key, value in found._asdict().items() if key != "compared"}
        parameters = [each._asdict() for each in found.parameters]
        print_json({**facts, "parameters": parameters, "follows": found.follows, "page": str(page)})
    else:
        _say(found, out, page)
    if not found.follows:
        return 1
    return 0 if found.is_identified and not found.coarse else 3


def _say(found: Fit, out: Path, page: Path) -> None:
    from contact_sim_pkg.sweep.fit_page import coarse_sentence, late_words, others_sentence

    show_rows(
        [
            {
                "key": each.key,
                "value": _digits(each.value),
                "from": _digits(each.low),
                "to": _digits(each.high),
                "remark": each.remark,
            }
            for each in found.parameters
        ],
        False,
    )
    late = late_words(found)
    request = f", accuracy {found.accuracy:.2g}" if math.isfinite(found.accuracy) else ""
    say(f"90 % intervals; misfit {found.misfit:.3g} {found.unit}".rstrip() + f"{late}; {found.cases} runs{request}")
    if found.recorded:
        say(f"the intervals hold the numerical error of the recorded run, made at accuracy {found.recorded:.2g}")
    if found.others:
        say(others_sentence(found))
    if not found.follows:
        say(
            f"the scene does not follow what was measured (probability {found.probability:.1g}): an effect, a "
            "filter (--free sensor.low_pass=5:100:log), a delay (--shift) or another model is missing, and the intervals hold "
            "nothing"
        )
    elif found.coarse:
        say(coarse_sentence(found))
    elif math.isnan(found.probability):
        say("whether the scene follows was not judged: the scatter of what was measured is not known, or there is none")
    say(f"{out / 'fitted.yaml'} is the fitted scene, {page} shows it")


def _digits(value: float) -> str:
    """Enough of them to tell an interval of a thousandth; nothing where there is none."""
    return f"{value:.6g}" if math.isfinite(value) else "–"
