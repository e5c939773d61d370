"""`bench accuracy`: error beside time, on this machine."""

from __future__ import annotations

from pathlib import Path

import click

from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json_rows, show_sections


@click.command("accuracy")
@click.argument("what", metavar="SCENE|RIG")
@click.option(
    "--plot", type=click.Path(path_type=Path), metavar="FILE", help="Error over time, both logarithmic, as a picture."
)
@overwrite_option
@json_option
def command(what: str, plot: Path | None, overwrite: bool, as_json: bool) -> None:
    """Error against a reference beside time, for each method (work-precision study).

    SCENE, a name or a path: each fidelity level, tolerance and grid. RIG (tire, seat, block,
    impact, roller): each quantity of its contact by inexpensive and expensive formulas, on the same
    input. For a file named like a rig write ./NAME.
    """
    from contact_sim_pkg.report.drawing import check_picture
    from contact_sim_pkg.studies.accuracy import work_precision

    if plot is not None:
        check_picture(plot, [Path(what)], overwrite=overwrite)
    if what in work_precision.measured_rigs():
        from contact_sim_pkg.studies.accuracy import work_precision_plot, work_precision_table

        rows = work_precision.study(what, _tell)
        draw, sections = work_precision_plot.write_plot, work_precision_table.sections
    else:
        from contact_sim_pkg.studies.accuracy import scene_study

        rows = scene_study.study(what, _tell)
        draw, sections = scene_study.write_plot, scene_study.sections
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(sections(rows))
    if plot is not None:
        draw(rows, plot, overwrite=overwrite)  # last: whatever becomes of the picture, the table is there


def _tell(line: str) -> None:
    click.echo(line, err=True)
