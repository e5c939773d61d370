"""`bench export`: topics of a bag as tables."""

from __future__ import annotations

from pathlib import Path

import click

from contact_sim_pkg.cli.output.tables import overwrite_option


@click.command("export")
@click.argument("bag", type=click.Path(path_type=Path))
@click.option("--csv", "form", flag_value="csv", help="Comma-separated text, any spreadsheet.")
@click.option("--parquet", "form", flag_value="parquet", help="Apache Parquet; needs pyarrow.")
@click.option("--topic", "topics", multiple=True, metavar="NAME", help="Only this one; may be given several times.")
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR", help="Folder; by default export/ in the bag.")
@click.option("--skip-bad", is_flag=True, help="Continue after damaged chunks.")
@overwrite_option
def command(
    bag: Path, form: str | None, topics: tuple[str, ...], out: Path | None, skip_bad: bool, overwrite: bool
) -> None:
    """Write each topic of BAG as a table, one row a sample with its time and units.

    Pressure maps become the CSV of a pressure mat, frame by frame.
    """
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.report.export.write import export

    if form is None:
        raise click.UsageError("Missing --csv or --parquet.")
    source = open_bag(bag, skip_bad=skip_bad)
    for file in export(source, form, topics, out or source.path.parent / "export", overwrite=overwrite):
        click.echo(str(file))
    for note in source.notes:
        click.echo(note, err=True)
