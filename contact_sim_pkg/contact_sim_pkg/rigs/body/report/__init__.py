"""Report of a rigid body on the ground."""

from contact_sim_pkg.records.report import ContactReport

__all__ = ["BLOCK_REPORT"]

BLOCK_REPORT = ContactReport(
    contact="block",
    sections=f"{__name__}.section:block_sections",
    metrics=f"{__name__}.metrics:block_metrics",
    lead=("block-way",),
    parts=f"{__name__}.drawing:block_parts",
    answer=("at rest from {rest}", "contacts {contacts}", "largest impulse {impulse_largest}", "{loss} lost"),
)
