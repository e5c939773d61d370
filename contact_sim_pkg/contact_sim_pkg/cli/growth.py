"""`bench growth`: how cost grows with what a scene asks for."""

from __future__ import annotations

import os
from pathlib import Path

import click

from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json_rows, show_sections


@click.command("growth")
@click.option("--page", type=click.Path(path_type=Path), metavar="FILE", help="The page docs/performance.md, too.")
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE", help="Time over each axis as a picture.")
@overwrite_option
@json_option
def command(page: Path | None, plot: Path | None, overwrite: bool, as_json: bool) -> None:
    """Time of a simulated second over cells, contact area, speed, contacts and rates.

    Takes two to four minutes.
    """
    from contact_sim_pkg.files import check_output, new_file
    from contact_sim_pkg.report.drawing import check_picture
    from contact_sim_pkg.studies.growth import growth, growth_plot

    if page is not None:
        check_output(page, [], overwrite=overwrite)
    if plot is not None:
        check_picture(plot, [], overwrite=overwrite)
    rows = growth.study(lambda line: click.echo(line, err=True))
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
