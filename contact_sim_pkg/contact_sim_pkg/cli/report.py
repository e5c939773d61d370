"""`bench report`: one HTML page on a bag."""

from __future__ import annotations

from pathlib import Path

import click


@click.command("report")
@click.argument("bag", type=click.Path(path_type=Path))
@click.option(
    "--out", type=click.Path(path_type=Path), metavar="FILE", help="The page; report.html in the bag otherwise."
)
@click.option("--skip-bad", is_flag=True, help="Go on after damaged chunks.")
def command(bag: Path, out: Path | None, skip_bad: bool) -> None:
    """Write the page with the pictures that an engineer looks at, and print its path."""
    from contact_sim_pkg.analysis.report import write_report
    from contact_sim_pkg.bag.reader import open_bag

    recorded = open_bag(bag, skip_bad=skip_bad)
    for note in recorded.notes:
        click.echo(note, err=True)
    click.echo(f"report: {write_report(recorded, out)}")
