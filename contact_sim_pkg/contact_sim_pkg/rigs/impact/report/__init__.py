"""Report of the impacts of a sphere."""

from contact_sim_pkg.records.report import ContactReport, SeriesReader

__all__ = ["IMPACT_REPORT"]

_KINDS = ("Events", "Course", "Stress", "Wave", "Front", "Position", "History")

IMPACT_REPORT = ContactReport(
    contact="impact",
    series=(
        SeriesReader(
            name="impacts",
            types=tuple(f"contact_msgs_defs/msg/Impact{kind}" for kind in _KINDS),
            reader=f"{__name__}.series:ImpactReader",
            reduces=True,
        ),
    ),
    sections=f"{__name__}.section:impact_sections",
    warnings=f"{__name__}.series:impact_warnings",
    metrics=f"{__name__}.metrics:impact_metrics",
    lead=("impact-indentation",),
    parts=f"{__name__}.drawing:impact_parts",
    answer=("restitution {restitution}", "contact of {duration}", "peak force {force}", "peak stress {stress}"),
)
