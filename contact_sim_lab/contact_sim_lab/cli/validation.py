"""`bench validation`: published figures beside those of the bench."""

from __future__ import annotations

import math
from pathlib import Path

import click

from contact_sim_pkg.cli.output.say import announce
from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json_rows, show_sections


@click.command("validation")
@click.option("--page", type=click.Path(path_type=Path), metavar="FILE", help="The page docs/validation.md, too.")
@overwrite_option
@json_option
def command(page: Path | None, overwrite: bool, as_json: bool) -> int:
    """Published figures of seats, occupants and tires beside those of the bench. Exit code 1 where one lies outside its
    band, with or without a remark that says why, 3 where the bench has no value.
    """
    from contact_sim_lab.validation import validation
    from contact_sim_pkg.files import check_output, new_file
    from contact_sim_pkg.records.metric import exit_status

    if page is not None:
        check_output(page, [], overwrite=overwrite)
    rows = validation.study(announce)
    if page is not None:
        with new_file(page, overwrite=overwrite) as file:
            file.write(validation.page(rows).encode())
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(validation.sections(rows))
    valued = [row for row in rows if math.isfinite(row["ours"])]
    return exit_status(missed=not all(row["inside"] for row in valued), unjudged=len(valued) < len(rows))
