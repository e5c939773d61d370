"""Report of a back against a seat back."""

from contact_sim_pkg.records.report import ContactReport

__all__ = ["BACKREST_REPORT"]

BACKREST_REPORT = ContactReport(
    contact="backrest",
    sections=f"{__name__}.section:backrest_sections",
    contact_numbers=f"{__name__}.numbers:back_numbers",
    tiles=f"{__name__}.numbers:back_tiles",
    warnings=f"{__name__}.numbers:backrest_warnings",
    drive_period=f"{__name__}.numbers:drive_period",
    comparison=f"{__name__}.figures_comparison:comparison_pictures",
)
