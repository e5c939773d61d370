"""`bench import`: a recording of a data logger becomes a bag."""

from __future__ import annotations

from pathlib import Path

import click

from contact_sim_pkg.cli.output.say import say

AXES = ("x", "y", "z")


@click.command("import")
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--out", required=True, type=click.Path(path_type=Path), metavar="BAG", help="Folder of the new bag.")
@click.option("--rate", type=click.FloatRange(0.001, 1e6), metavar="HZ", help="Of a file without times.")
@click.option("--time", metavar="COLUMN", help="Column of times; DATE+TIME joins two. Else by its usual names.")
@click.option(
    "--time-unit", type=click.Choice(["s", "ms", "us", "ns"]), help="Of times whose unit the file does not state."
)
@click.option("--header-line", type=click.IntRange(1), metavar="N", help="Line that names the columns.")
@click.option(
    "--axes", metavar="x=COLUMN,z=-COLUMN", default="", help="Columns of the acceleration: forward, left, up."
)
@click.option(
    "--unit",
    type=click.Choice(["m/s^2", "g", "mg", "Pa", "kPa", "mmHg", "psi", "N/cm^2"]),
    help="Of accelerations, or of a mat's pressures, whose unit the file does not state.",
)
@click.option("--scale", type=float, metavar="M/S2", help="Acceleration at full scale of a .wav.")
@click.option(
    "--pitch",
    type=click.FloatRange(0.1, 1000.0),
    metavar="MM",
    help="From cell to cell of a mat whose file does not state it.",
)
@click.option(
    "--front",
    type=click.Choice(["bottom", "left", "top", "right"]),
    help="Side of a mat's map that points forward (up on a seat back).  [default: bottom; top on a seat back]",
)
@click.option(
    "--contact", type=click.Choice(["seat", "backrest"]), default="seat", show_default=True, help="What a mat lies on."
)
@click.option("--frame", default="sensor", metavar="NAME", help="Frame of the sensor.")
def command(
    file: Path, out: Path, rate: float | None, time: str | None, time_unit: str | None, header_line: int | None, axes: str,
    unit: str | None, scale: float | None, frame: str, pitch: float | None, front: str | None, contact: str,
) -> None:  # fmt: skip
    """Write the recording in FILE (text, .mat, .wav; with the extra `daq` .mf4, .tdms, .uff) into a bag.

    Accelerations become sensor_msgs/Imu on /acceleration, all other columns contact_msgs_defs/Series on /series.
    The text export of a pressure mat (Tekscan, XSENSOR) becomes contact_msgs_defs/ContactPatch on /seat/patch.
    """
    from contact_sim_pkg.standard.imported import ImportChoice, import_recording

    choice = ImportChoice(rate, time, time_unit, header_line, _columns(axes), unit, scale, frame,
                          None if pitch is None else 1e-3 * pitch, front, contact)  # fmt: skip
    summary, notes = import_recording(file, out, choice)
    for note in notes:
        say(note, err=True)
    say(f"{summary.path}: {summary.messages} messages{f'; {summary.sentence}' if summary.sentence else ''}")


def _columns(axes: str) -> dict[str, str]:
    """Axis -> column; a usage error for anything but `x=NAME,z=-NAME`."""
    found = {}
    for part in filter(None, axes.split(",")):
        axis, equals, column = part.partition("=")
        if axis.strip() not in AXES or not equals or not column.strip():
            raise click.UsageError(f"--axes {part!r:.60}: write AXIS=COLUMN with x, y or z, such as z=a_z")
        found[axis.strip()] = column.strip()
    return found
