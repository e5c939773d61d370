"""`bench material`: E', E'' and tan(beta) from measured impacts."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json, show_rows

if TYPE_CHECKING:
    from contact_sim_pkg.rigs.impact.material.force_record import ForceRecord
    from contact_sim_pkg.rigs.impact.material.report import MaterialReport

FILE = click.Path(path_type=Path)


@click.command("material")
@click.argument("impacts", type=FILE, metavar="IMPACTS.csv|BAG|FORCE")
@click.option(
    "--mass", type=click.FloatRange(1e-12, 1e6), metavar="KG", help="Of a force over time: mass that strikes."
)
@click.option(
    "--speed", type=click.FloatRange(1e-9, 1e4), metavar="M/S", help="Of a force over time: speed at the touch."
)
@click.option(
    "--radius", type=click.FloatRange(1e-9, 1e3), metavar="M", help="Of a force over time: radius of the nose."
)
@click.option("--force", metavar="COLUMN", help="Of a force over time: its column; else by its usual names.")
@click.option(
    "--time-unit", type=click.Choice(["s", "ms", "us", "ns"]), help="Of times whose unit the file does not state."
)
@click.option(
    "--form", default="exact", show_default=True, help="exact, corrected or printed (eqs 104, 105 of Contact Area)."
)
@click.option("--end", help="End of contact: force or gap; in a bag that of its scene, else force.")
@click.option("--shape", help="Shape factor of the contact: small or iterate; in a bag that of its scene, else small.")
@click.option(
    "--gravity",
    type=click.FloatRange(0.0, 1e4),
    metavar="M/S2",
    help="Weight along the blow: 9.81 of a drop tower, 0 of a pendulum; of a bag, or of a column g, its own; else 0.",
)
@click.option("--confidence", default=0.95, show_default=True, help="Confidence of the intervals.")
@click.option(
    "--temperature-span", default=2.0, show_default=True, metavar="K", help="Largest difference between repeats."
)
@click.option("--speed-ratio", default=1.3, show_default=True, help="Largest ratio of speeds between repeats.")
@click.option("--shift", metavar="LAW", help="Master curve by wlf or arrhenius.")
@click.option("--glass-temperature", type=float, metavar="K", help="Glass temperature of wlf; identified without it.")
@click.option(
    "--activation-energy", type=float, metavar="J/MOL", help="Activation energy of arrhenius; identified without it."
)
@click.option("--reference", type=float, metavar="K", help="Temperature of the master curve.")
@click.option("--csv", "table", type=FILE, metavar="FILE", help="Impacts into FILE, groups into FILE_groups.")
@click.option("--plot", type=FILE, metavar="FILE", help="E' and tan beta as a picture.")
@overwrite_option
@json_option
def command(
    impacts: Path, mass: float | None, speed: float | None, radius: float | None, force: str | None,
    time_unit: str | None, form: str, end: str | None, shape: str | None, gravity: float | None, confidence: float,
    temperature_span: float, speed_ratio: float, shift: str | None, glass_temperature: float | None,
    activation_energy: float | None, reference: float | None, table: Path | None, plot: Path | None, overwrite: bool,
    as_json: bool,
) -> None:  # fmt: skip
    """The material from measured impacts of a sphere, with intervals from repeated impacts.

    From a bag of the rig impact, or from a file with one line for each impact: columns m, R, V0,
    tau, k and T (kg, m, m/s, s, 1, K; other units in brackets behind the name), g (m/s^2) where the
    weight acts along the blow. From a force over time, with --mass and --speed: impulse, duration and
    restitution of its largest impact, and with --radius its material.
    """
    from contact_sim_pkg.files import check_output
    from contact_sim_pkg.report import drawing
    from contact_sim_pkg.rigs.impact.material import figure
    from contact_sim_pkg.rigs.impact.material.bag_impacts import is_bag, rules_of_bag
    from contact_sim_pkg.rigs.impact.material.options import Options
    from contact_sim_pkg.rigs.impact.material.report import csv_files, material_report, report_of, write_csv

    for name, given, law in (
        ("--glass-temperature", glass_temperature, "wlf"),
        ("--activation-energy", activation_energy, "arrhenius"),
    ):
        if given is not None and shift != law:
            raise click.UsageError(f"{name} belongs to --shift {law}")
    for each in () if table is None else csv_files(table):
        check_output(each, [impacts], overwrite=overwrite)
    if plot is not None:
        drawing.check_picture(plot, [impacts], overwrite=overwrite)
    of_material = {"--csv": table, "--plot": plot, "--shift": shift}
    measured = _measured(impacts, (mass, speed, radius), gravity, force, time_unit, of_material)
    if measured is not None and radius is None:
        _show_force(measured, as_json=as_json)
        return
    usual = rules_of_bag(impacts) if is_bag(impacts) else ("force", "small")
    options = Options(end or usual[0], form, shape or usual[1], confidence, temperature_span, speed_ratio)
    parameter = glass_temperature if shift == "wlf" else activation_energy
    if measured is None:
        report = material_report(impacts, options, shift, parameter, reference, gravity)
    else:
        struck = measured.impacts(float(mass or 0.0), float(radius or 0.0), float(speed or 0.0), gravity or 0.0)
        report = report_of(struck, options, shift, parameter, reference)
    for note in report.impacts.notes:
        say(note, err=True)
    if table is not None:
        write_csv(report, table, overwrite=overwrite)
    _show(report, measured, as_json=as_json)
    if plot is not None:
        figure.write_figure(
            report, plot, overwrite=overwrite
        )  # last: whatever becomes of the picture, the table is there


def _measured(
    path: Path, stated: tuple[float | None, float | None, float | None], gravity: float | None, column: str | None,
    time_unit: str | None, of_material: Mapping[str, object],
) -> ForceRecord | None:  # fmt: skip
    """The impact of a force over time with its mass, speed and radius as stated; None where none of them is.

    Its notes are printed. ``of_material``: options that need the radius, and their values.
    """
    from contact_sim_pkg.rigs.impact.material.force_record import read_force

    mass, speed, radius = stated
    if all(each is None for each in (*stated, column, time_unit)):
        return None
    if mass is None or speed is None:
        raise click.UsageError("a force over time needs --mass KG and --speed M/S; impacts line by line need neither")
    idle = [name for name, value in of_material.items() if value is not None]
    if radius is None and idle:
        raise click.UsageError(f"{idle[0]} is of the material, which needs --radius M of the nose")
    found = read_force(path, mass, speed, gravity=gravity or 0.0, column=column, time_unit=time_unit)
    for note in found.notes:
        say(note, err=True)
    if radius is None:
        say("--radius M of the nose gives E' and tan beta too", err=True)
    return found


def _show_force(measured: ForceRecord, *, as_json: bool) -> None:
    row = _force_row(measured)
    if as_json:
        print_json({"force": row})
    else:
        show_rows([row], as_json=False)


def _force_row(measured: ForceRecord) -> dict[str, float | int]:
    return {
        "impulse": measured.impulse, "tau": measured.duration, "k": measured.restitution, "peak_force": measured.peak,
        "samples": measured.samples,
    }  # fmt: skip


def _show(report: MaterialReport, measured: ForceRecord | None, *, as_json: bool) -> None:
    from contact_sim_pkg.rigs.impact.material.report import group_rows, master_row, pooled_rows

    if measured is not None and not as_json:
        _show_force(measured, as_json=False)
        say()
    if as_json:
        first = {} if measured is None else {"force": _force_row(measured)}
        parts = {**first, "impacts": report.rows, "groups": group_rows(report), "all_speeds": pooled_rows(report)}
        print_json({**parts, "master_curve": master_row(report)})
        return
    show_rows(group_rows(report), as_json=False)
    if report.pooled:
        say("\nall speeds of a temperature together")
        show_rows(pooled_rows(report), as_json=False)
    if report.master is not None:
        say()
        show_rows([master_row(report) or {}], as_json=False)
