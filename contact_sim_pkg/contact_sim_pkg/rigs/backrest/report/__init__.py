"""Report of a back against a seat back."""

from contact_sim_pkg.records.report import ContactReport

__all__ = ["BACKREST_REPORT"]

BACKREST_REPORT = ContactReport(
    contact="backrest",
    sections=f"{__name__}.section:backrest_sections",
    warnings=f"{__name__}.numbers:backrest_warnings",
    drive_period=f"{__name__}.numbers:drive_period",
    comparison=f"{__name__}.figures_comparison:comparison_pictures",
    metrics=f"{__name__}.metrics:backrest_metrics",
    lead=("backrest-loops",),
    parts=f"{__name__}.drawing:backrest_parts",
    answer=(
        "{slaps} slaps",
        "off the seat back {lift_off} of the time",
        "restitution {restitution}",
        "load on the seat back {load}",
        "{peak_pressure} {peak_pressure:remark}",
    ),
)
