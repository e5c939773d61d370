"""`bench table`: third-octave bands, rainflow cycles, impedance of the occupant."""

from __future__ import annotations

from pathlib import Path

import click

from contact_sim_pkg.cli.output.tables import json_option, print_json, show_sections


@click.command("table")
@click.argument("kind", metavar="third-octaves|rainflow|impedance")
@click.argument("bag", type=click.Path(path_type=Path))
@click.option(
    "--column",
    "columns",
    multiple=True,
    metavar="TOPIC.NAME",
    help="A column as `bench export` names it; may be repeated.  [default: floor and seat, or the contact forces]",
)
@click.option("--skip-bad", is_flag=True, help="Continue after damaged chunks.")
@json_option
def command(kind: str, bag: Path, columns: tuple[str, ...], skip_bad: bool, as_json: bool) -> int:
    """Print a table of BAG behind its metrics: root mean square by third octave, cycles by range, or apparent mass and
    impedance of the occupant.
    """
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.report.spectra import facts_of, tables_of

    found = tables_of(kind, open_bag(bag, skip_bad=skip_bad), columns)
    if as_json:
        print_json(facts_of(found))
    else:
        show_sections(found)
    return 0
