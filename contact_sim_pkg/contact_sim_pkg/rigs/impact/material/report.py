"""All of `bench material`: from the file to rows of impacts, of groups and of the master curve."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.files import as_cell, new_file
from contact_sim_pkg.rigs.impact.material.bag_impacts import impacts_of_bag, is_bag
from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.estimate import (
    EstimatedValue,
    MaterialEstimate,
    each_impact,
    repeated_impacts,
)
from contact_sim_pkg.rigs.impact.material.groups import groups
from contact_sim_pkg.rigs.impact.material.master_curve import LAWS, MasterCurve, master_curve
from contact_sim_pkg.rigs.impact.material.options import Options
from contact_sim_pkg.rigs.impact.material.pooled import Pooled, pooled_speeds
from contact_sim_pkg.rigs.impact.material.reading import Impacts, read_impacts
from contact_sim_pkg.rigs.impact.theory.closed_form.force import ENDS
from contact_sim_pkg.rigs.impact.theory.inverse import FORMS, HEAVIEST
from contact_sim_pkg.rigs.impact.theory.motion import SHAPE_RULES
from contact_sim_pkg.rigs.impact.theory.shift import Wlf

__all__ = [
    "MaterialReport",
    "csv_files",
    "group_rows",
    "master_row",
    "material_report",
    "pooled_rows",
    "report_of",
    "write_csv",
]


class MaterialReport(NamedTuple):
    """Report on a file of impacts."""

    impacts: Impacts
    options: Options
    rows: list[dict[str, Any]]  # an impact a row
    estimates: list[MaterialEstimate]  # a group of repeats a row
    master: MasterCurve | None
    pooled: list[Pooled]  # a temperature with several speeds a row


def material_report(
    path: Path,
    options: Options,
    law: str | None = None,
    parameter: float | None = None,
    reference: float | None = None,
    gravity: float | None = None,
) -> MaterialReport:
    """Report on a file of impacts, or on the impact events of a bag.

    parameter: of the shift law, Tg [K] or activation energy [J/mol]; reference: temperature [K];
    gravity: [m/s^2]. Raises MaterialError or BagError with one sentence.
    """
    _check(options, law)
    impacts = impacts_of_bag(path) if is_bag(path) else read_impacts(path)
    if gravity is not None:
        impacts = impacts._replace(gravity=numpy.full(len(impacts.speed), gravity))
    return report_of(impacts, options, law, parameter, reference)


def report_of(
    impacts: Impacts,
    options: Options,
    law: str | None = None,
    parameter: float | None = None,
    reference: float | None = None,
) -> MaterialReport:
    """The report on impacts, wherever they come from; ``law`` `wlf` or `arrhenius` adds the master
    curve.

    ``parameter``: Tg [K] or activation energy [J/mol], found where None; ``reference`` [K]. Raises
    MaterialError.
    """
    _check(options, law)
    impacts = _struck(impacts)
    rows = each_impact(impacts, options)
    estimates = [repeated_impacts(impacts, chosen, options) for chosen in groups(impacts, options)]
    master = None if law is None else master_curve(estimates, law, parameter, reference)
    return MaterialReport(impacts, options, rows, estimates, master, pooled_speeds(estimates, options))


def _struck(impacts: Impacts) -> Impacts:
    """Without the impacts in which the weight does more than the blow. Raises MaterialError where
    none is left.
    """
    if impacts.gravity is None:
        return impacts
    kept = impacts.gravity * impacts.duration / impacts.speed <= HEAVIEST
    if kept.all():
        return impacts
    count = int((~kept).sum())
    note = f"{count} of {len(kept)} impacts left out: pressed by the weight rather than struck, g tau/V0 above {HEAVIEST:g}"
    if not kept.any():
        raise MaterialError(f"{impacts.file}: {note}; nothing is left")
    columns: dict[str, Any] = {
        name: value[kept] for name, value in impacts._asdict().items() if isinstance(value, numpy.ndarray)
    }
    return impacts._replace(**columns, notes=(*impacts.notes, note))


def group_rows(report: MaterialReport) -> list[dict[str, Any]]:
    """One flat row a group: state, values, standard errors, intervals, and its place on the master
    curve.
    """
    rows = []
    for i, estimate in enumerate(report.estimates):
        row: dict[str, Any] = {
            "impacts": estimate.impacts, "T": estimate.temperature, "V0": estimate.speed, "k": estimate.restitution,
            **_flat("E'", estimate.storage_modulus), **_flat("E''", estimate.loss_modulus),
            **_flat("tan_beta", estimate.loss_tangent),
        }  # fmt: skip
        if report.master is not None:
            row |= {"lg_aT": report.master.log_shift[i], "reduced_speed": report.master.reduced_speed[i]}
        rows.append({**row, "note": estimate.note})
    return rows


def pooled_rows(report: MaterialReport) -> list[dict[str, Any]]:
    """One flat row a temperature at which there are several speeds: all its impacts as one
    material.
    """
    return [
        {
            "T": each.temperature, "impacts": each.impacts, "groups": each.groups, "V0_low": each.slowest,
            "V0_high": each.fastest, **_flat("E'", each.storage_modulus), **_flat("E''", each.loss_modulus),
            **_flat("tan_beta", each.loss_tangent), "agreement": each.agreement, "note": each.note,
        }
        for each in report.pooled
    ]  # fmt: skip


def master_row(report: MaterialReport) -> dict[str, Any] | None:
    """The law of the master curve, or None."""
    if report.master is None:
        return None
    law = report.master.law
    name = "Tg" if isinstance(law, Wlf) else "activation_energy"
    value = law.glass_temperature if isinstance(law, Wlf) else law.activation_energy
    return {
        "law": "wlf" if isinstance(law, Wlf) else "arrhenius", name: value, "found": report.master.found is not None,
        "standard_error": report.master.found_error, "reference_temperature": report.master.reference_temperature,
        "scatter": report.master.scatter,
    }  # fmt: skip


def csv_files(path: Path) -> tuple[Path, Path]:
    """The files that `write_csv` makes: impacts, and beside it, with `_groups` in its name,
    groups.
    """
    return path, path.with_stem(f"{path.stem}_groups")


def write_csv(report: MaterialReport, path: Path, *, overwrite: bool = False) -> None:
    """Write the rows of impacts and of groups into new `csv_files`. Raises FileRefusedError, see
    `files.new_file`.
    """
    for rows, target in zip((report.rows, group_rows(report)), csv_files(path), strict=True):
        text = io.StringIO()
        writer = csv.DictWriter(text, list(rows[0]))
        writer.writeheader()
        writer.writerows({name: as_cell(value) for name, value in row.items()} for row in rows)
        with new_file(target, overwrite=overwrite) as file:
            file.write(text.getvalue().encode())


def _flat(name: str, value: EstimatedValue) -> dict[str, float | None]:
    return {name: value.value, f"{name}_error": value.error, f"{name}_low": value.low, f"{name}_high": value.high}


def _check(options: Options, law: str | None) -> None:
    choices = (
        ("end rule", options.end, ENDS),
        ("form", options.form, FORMS),
        ("shape factor", options.shape, SHAPE_RULES),
    )
    for name, value, allowed in choices:
        if value not in allowed:
            raise MaterialError(f"{name} '{value}': {', '.join(allowed)} are known")
    if law is not None and law not in LAWS:
        raise MaterialError(f"shift '{law}': {', '.join(LAWS)} are known")
    if not 0.0 < options.confidence < 1.0:
        raise MaterialError(f"confidence {options.confidence:g}: a number between 0 and 1 is needed, such as 0.95")
    if not options.temperature_span >= 0.0:
        raise MaterialError(f"temperature span {options.temperature_span:g} K: 0 or above is needed")
    if not options.speed_ratio >= 1.0:
        raise MaterialError(f"speed ratio {options.speed_ratio:g}: 1 or above is needed")
