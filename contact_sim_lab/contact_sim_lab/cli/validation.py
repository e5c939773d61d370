"""`bench validation`: published figures beside those of the bench."""

from __future__ import annotations

from pathlib import Path

import click

from contact_sim_pkg.cli.output.say import tell
from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json_rows, show_sections


@click.command("validation")
@click.option("--page", type=click.Path(path_type=Path), metavar="FILE", help="The page docs/validation.md, too.")
@overwrite_option
@json_option
def command(page: Path | None, overwrite: bool, as_json: bool) -> None:
    """Published figures of seats, occupants and tires beside those of the bench."""
    from contact_sim_lab.validation import validation
    from contact_sim_pkg.files import check_output, new_file

    if page is not None:
        check_output(page, [], overwrite=overwrite)
    rows = validation.study(tell)
    if page is not None:
        with new_file(page, overwrite=overwrite) as file:
            file.write(validation.page(rows).encode())
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(validation.sections(rows))
