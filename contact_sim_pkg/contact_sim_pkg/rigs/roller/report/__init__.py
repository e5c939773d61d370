"""Report of a roller on its shaft."""

from contact_sim_pkg.records.report import ContactReport, SeriesReader

__all__ = ["ROLLER_REPORT"]

_KINDS = ("Contact", "Track", "Volumes", "Stability")

ROLLER_REPORT = ContactReport(
    contact="roller",
    series=(
        SeriesReader(
            name="roller",
            types=tuple(f"contact_msgs_defs/msg/Roller{kind}" for kind in _KINDS),
            reader=f"{__name__}.series:RollerReader",
            open_fields=("check_error", "critical_load", "critical_damping"),
        ),
    ),
    sections=f"{__name__}.section:roller_sections",
    warnings=f"{__name__}.warnings:roller_warnings",
    metrics=f"{__name__}.metrics:roller_metrics",
    lead=("roller-pressure",),
    parts=f"{__name__}.drawing:roller_parts",
    answer=("p₀ up to {pressure}", "dangerous volume {volume}, {volume:remark}", "{cycles} cycles", "waves of {range}"),
    curves=f"{__name__}.comparison:roller_curves",
    comparison=f"{__name__}.comparison:roller_comparison",
)
