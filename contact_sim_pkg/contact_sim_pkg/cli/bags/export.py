"""`bench export`: topics of a bag as tables, as standard messages of ROS, or in wall time; a scene as an FMU."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import overwrite_option
from contact_sim_pkg.cli.output.working import doing

if TYPE_CHECKING:
    from contact_sim_pkg.bag.reader import Bag
    from contact_sim_pkg.bag.writer import BagSummary

STANDARD = "ros-std"
UNIT = "fmu"
FMI = ("2",)
HIGHEST_RATE = 1e5


@click.command("export")
@click.argument("bag", type=click.Path(path_type=Path), metavar="BAG|SCENE")
@click.option("--csv", "form", flag_value="csv", help="Comma-separated text, any spreadsheet.")
@click.option("--parquet", "form", flag_value="parquet", help="Apache Parquet; needs pyarrow.")
@click.option(
    "--ros-std", "form", flag_value=STANDARD, help="A bag of standard messages: Image, PointCloud2, Imu, TF ..."
)
@click.option("--fmu", "form", flag_value=UNIT, help="The named scene as a co-simulation unit; needs a compiler of C.")
@click.option("--fmi", type=click.Choice(FMI), help="Of --fmu: version of FMI, 2.")
@click.option(
    "--set", "assignments", multiple=True, metavar="A.B.C=VALUE", help="Of --fmu: change one value of the scene."
)
@click.option("--format", "other", metavar="NAME", help="A format that a plug-in brings.")
@click.option("--wall-time", is_flag=True, help="A bag whose log times are wall time; alone, or with --ros-std.")
@click.option(
    "--begin", default="", metavar="TIME", help="Wall time of simulated time 0; by default from the bag's file."
)
@click.option("--rate", type=click.FloatRange(0.001, HIGHEST_RATE), metavar="HZ",
              help="Of --ros-std: messages of a topic a second at most, 20.")  # fmt: skip
@click.option("--topic", "topics", multiple=True, metavar="NAME", help="Only this one; may be given several times.")
@click.option("--out", type=click.Path(path_type=Path), metavar="PATH",
              help="Folder, by default export/ in the bag; of a bag BAG_std or BAG_wall, of --fmu SCENE.fmu.")  # fmt: skip
@click.option("--skip-bad", is_flag=True, help="Continue after damaged chunks.")
@overwrite_option
@click.pass_context
def command(
    context: click.Context, bag: Path, form: str | None, fmi: str | None, assignments: tuple[str, ...], other: str | None,
    wall_time: bool, begin: str, rate: float | None, topics: tuple[str, ...], out: Path | None, skip_bad: bool,
    overwrite: bool,
) -> None:  # fmt: skip
    """Write each topic of BAG as a table, one row a sample with its time and units; or write a new bag.

    Pressure maps become the CSV of a pressure mat, frame by frame. With --fmu it is a SCENE that is written, as a unit
    that other tools step.
    """
    from contact_sim_pkg.bag.reader import open_bag

    if form and other:
        raise click.UsageError(f"--format and {_named(form)} exclude each other.")
    form = form or other
    _refuse_options_that_do_not_fit(form, wall_time, begin, rate, topics, overwrite)
    _refuse_options_of_units(form, fmi, assignments, skip_bad)
    if form == UNIT:
        _write_unit(bag, assignments, out, overwrite=overwrite)
        return
    source, status = open_bag(bag, skip_bad=skip_bad), 0
    if form in (None, STANDARD):
        doing(f"export: {source.count():,} messages of {source.path}")
        summary = _new_bag(source, form, out, wall_time, begin, rate)
        say(f"{summary.path}: {summary.messages} messages{f'; {summary.sentence}' if summary.sentence else ''}")
        status = 0 if summary.complete else 3
    else:
        from contact_sim_pkg.report.export.write import export

        folder = out or source.path.parent / "export"
        for file in export(source, form, topics, folder, overwrite=overwrite, on_file=doing):
            say(str(file))
    for note in [*source.notes, *source.left_out]:
        say(note, err=True)
    context.exit(3 if source.left_out else status)


def _refuse_options_that_do_not_fit(
    form: str | None, wall_time: bool, begin: str, rate: float | None, topics: tuple[str, ...], overwrite: bool
) -> None:
    """UsageError for an option that the rest gives no meaning."""
    if form is None and not wall_time:
        raise click.UsageError("Missing --csv, --parquet, --ros-std, --format, --wall-time or --fmu.")
    table = form not in (None, STANDARD)
    wrong = {
        "--wall-time": table and wall_time,
        "--begin": bool(begin) and not wall_time,
        "--rate": rate is not None and form != STANDARD,
        "--topic": bool(topics) and (not table or form == UNIT),
        "--overwrite": overwrite and not table,
    }
    for option in (option for option, is_wrong in wrong.items() if is_wrong):
        if option == "--overwrite":
            raise click.UsageError(
                f"--overwrite replaces tables; {_named(form)} writes a bag, which needs a new --out."
            )
        needs = {"--begin": "--wall-time", "--rate": "--ros-std"}.get(option, "")
        raise click.UsageError(
            f"{option} needs {needs}." if needs else f"{option} and {_named(form)} exclude each other."
        )


def _refuse_options_of_units(form: str | None, fmi: str | None, assignments: tuple[str, ...], skip_bad: bool) -> None:
    if form == UNIT and skip_bad:
        raise click.UsageError("--skip-bad and --fmu exclude each other.")
    for option in ["--fmi"] * (fmi is not None) + ["--set"] * bool(assignments):
        if form != UNIT:
            raise click.UsageError(f"{option} needs --fmu.")


def _write_unit(scene: Path, assignments: tuple[str, ...], out: Path | None, *, overwrite: bool) -> None:
    from contact_sim_pkg.scene.load import load_scene
    from contact_sim_pkg.scene.overrides import set_value
    from contact_sim_pkg.scene.resolve import resolve
    from contact_sim_pkg.steering.fmu.export import export_fmu

    resolved = resolve(load_scene(str(scene), [set_value(each) for each in assignments]))
    doing(f"export: {resolved.name} as an FMU")
    path = out or Path(f"{resolved.name}.fmu")
    outputs = export_fmu(resolved, path, overwrite=overwrite)
    say(f"{path}: FMI 2.0, {outputs} outputs, steps of {resolved.block_length:g} s")


def _new_bag(
    source: Bag, form: str | None, out: Path | None, wall_time: bool, begin: str, rate: float | None
) -> BagSummary:
    from contact_sim_pkg.bag.names import new_directory
    from contact_sim_pkg.bag.wall_time import began_at, export_wall_time, wall_time_texts

    ending = "_std" if form == STANDARD else "_wall"
    place = source.path.parent
    directory = new_directory(out or place.with_name(place.name + ending), "")
    if form is None:
        return export_wall_time(source, directory, began_at(source, begin))
    from contact_sim_pkg.standard.export import export_standard
    from contact_sim_pkg.standard.topics import RATE

    texts = wall_time_texts(began_at(source, begin)) if wall_time else {}
    return export_standard(source, directory, rate=rate or RATE, texts=texts)


def _named(form: str | None) -> str:
    return f"--{form}" if form else "--wall-time"
