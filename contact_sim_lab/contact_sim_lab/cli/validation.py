"""`bench validation`: published curves and figures beside those of the bench."""

from __future__ import annotations

import math
from pathlib import Path

import click

from contact_sim_pkg.cli.output.say import announce
from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json, show_sections


@click.command("validation")
@click.option(
    "--page",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="The page docs/validation.md, too; its pictures in a folder of its name beside it.",
)
@overwrite_option
@json_option
def command(page: Path | None, overwrite: bool, as_json: bool) -> int:
    """Published curves and figures of seats, occupants and tires beside those of the bench. Exit code 1 where a curve has
    less than 70 % of its points inside, or a figure lies outside its band, with or without a remark that says why, 3 where
    the bench has no value.
    """
    from contact_sim_lab.validation import curves, validation
    from contact_sim_pkg.files import check_output, new_file
    from contact_sim_pkg.records.metric import exit_status

    if page is not None:
        check_output(page, [], overwrite=overwrite)
    found, rows = curves.study(announce), validation.study(announce)
    if page is not None:
        folder = page.with_suffix("")
        folder.mkdir(exist_ok=True)
        for name, content in curves.pictures(found).items():
            with new_file(folder / name, overwrite=overwrite) as file:
                file.write(content)
        with new_file(page, overwrite=overwrite) as file:
            file.write(validation.page(rows, found, folder.name).encode())
    if as_json:
        print_json({"rows": rows, "curves": curves.as_rows(found)})
    else:
        show_sections([*validation.sections(rows), *curves.sections(found)])
    valued = [row for row in rows if math.isfinite(row["ours"])]
    return exit_status(
        missed=any(each.holds is False for each in found) or not all(row["inside"] for row in valued),
        unjudged=any(None in each.inside for each in found) or len(valued) < len(rows),
    )
