"""`bench goals`: goals of the bench, and what this machine reaches; `bench growth`: how cost grows."""

from __future__ import annotations

import os
from pathlib import Path

import click

from contact_sim_pkg.cli.output.say import announce
from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json_rows, show_sections


@click.command("goals")
@click.option("--start", is_flag=True, help="The first block of every scene instead, cold and warm: some minutes.")
@click.option(
    "--latency", type=click.FloatRange(min=5.0), metavar="S",
    help="Only the latency of the full bench at real time, over a run of S seconds (the table: 60 s).",
)  # fmt: skip
@json_option
def command(start: bool, latency: float | None, as_json: bool) -> None:
    """Start-up, speed, latency, report and error against their goals, measured in one run; a missed goal is
    shown only.
    """
    from contact_sim_lab.goals import goals, starts

    rows = starts.study(announce) if start else goals.study(announce, latency)
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(starts.sections(rows) if start else goals.sections(rows))


@click.command("growth")
@click.option("--page", type=click.Path(path_type=Path), metavar="FILE", help="The page docs/performance.md, too.")
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE", help="Time over each axis as a picture.")
@overwrite_option
@json_option
def growth_command(page: Path | None, plot: Path | None, overwrite: bool, as_json: bool) -> None:
    """Time of a simulated second over cells, contact area, speed, contacts and rates.

    Takes two to four minutes.
    """
    from contact_sim_lab.growth import growth, growth_plot
    from contact_sim_pkg.files import check_output, new_file
    from contact_sim_pkg.report.drawing import check_picture

    if page is not None:
        check_output(page, [], overwrite=overwrite)
    if plot is not None:
        check_picture(plot, [], overwrite=overwrite)
    rows = growth.study(announce)
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(growth.sections(rows))
    if page is not None:
        picture = None if plot is None else os.path.relpath(plot, page.parent)
        with new_file(page, overwrite=overwrite) as file:
            file.write(growth.page(rows, picture).encode())
    if plot is not None:
        growth_plot.write_plot(rows, plot, overwrite=overwrite)
