"""`bench material`: E', E'' and tan(beta) from measured impacts."""

from __future__ import annotations

from pathlib import Path

import click

from .tables import json_option, print_json, show_rows

FILE = click.Path(path_type=Path)


@click.command("material")
@click.argument("impacts", type=FILE, metavar="IMPACTS.csv")
@click.option(
    "--form", default="exact", show_default=True, help="exact, corrected or printed (the paper's eqs 104, 105)."
)
@click.option("--end", default="force", show_default=True, help="End of contact: force or gap.")
@click.option("--shape", default="small", show_default=True, help="Shape factor of the contact: small or iterate.")
@click.option("--confidence", default=0.95, show_default=True, help="Of the intervals.")
@click.option("--temperature-span", default=2.0, show_default=True, metavar="K", help="Impacts so close are repeats.")
@click.option("--speed-ratio", default=1.3, show_default=True, help="Impacts so close in speed are repeats.")
@click.option("--shift", metavar="LAW", help="Master curve by wlf or arrhenius.")
@click.option("--glass-temperature", type=float, metavar="K", help="Of wlf; found from the impacts without it.")
@click.option(
    "--activation-energy", type=float, metavar="J/MOL", help="Of arrhenius; found from the impacts without it."
)
@click.option("--reference", type=float, metavar="K", help="Temperature of the master curve.")
@click.option("--csv", "table", type=FILE, metavar="FILE", help="Impacts into FILE, groups into FILE_groups.")
@click.option("--plot", type=FILE, metavar="FILE", help="E' and tan beta as a picture.")
@json_option
def command(
    impacts: Path, form: str, end: str, shape: str, confidence: float, temperature_span: float, speed_ratio: float,
    shift: str | None, glass_temperature: float | None, activation_energy: float | None, reference: float | None,
    table: Path | None, plot: Path | None, as_json: bool,
) -> None:  # fmt: skip
    """The material that measured impacts of a sphere tell, with intervals from repeated impacts.

    A line an impact, columns m, R, V0, tau, k and T (kg, m, m/s, s, 1, K; other units in brackets behind the name).
    """
    from contact_sim_pkg.analysis.material import figure
    from contact_sim_pkg.analysis.material.options import Options
    from contact_sim_pkg.analysis.material.report import group_rows, master_row, material_report, write_csv

    for name, given, law in (
        ("--glass-temperature", glass_temperature, "wlf"),
        ("--activation-energy", activation_energy, "arrhenius"),
    ):
        if given is not None and shift != law:
            raise click.UsageError(f"{name} belongs to --shift {law}")
    options = Options(end, form, shape, confidence, temperature_span, speed_ratio)
    parameter = glass_temperature if shift == "wlf" else activation_energy
    report = material_report(impacts, options, shift, parameter, reference)
    for note in report.impacts.notes:
        click.echo(note, err=True)
    if table is not None:
        write_csv(report, table)
    if plot is not None:
        figure.write_figure(report, plot)
    if as_json:
        print_json({"impacts": report.rows, "groups": group_rows(report), "master_curve": master_row(report)})
        return
    show_rows(group_rows(report), as_json=False)
    if report.master is not None:
        click.echo()
        show_rows([master_row(report) or {}], as_json=False)
