"""Report of a cushion under its load."""

from contact_sim_pkg.records.report import ContactReport

__all__ = ["SEAT_REPORT"]

SEAT_REPORT = ContactReport(
    contact="seat",
    closing_sections=f"{__name__}.section:ride_sections",
    numbers=f"{__name__}.occupant:summary_numbers",
    tiles=f"{__name__}.ride:ride_tiles",
    warnings=f"{__name__}.ride:seat_warnings",
)
