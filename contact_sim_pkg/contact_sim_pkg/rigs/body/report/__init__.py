"""Report of a rigid body on the ground."""

from contact_sim_pkg.records.report import ContactReport

__all__ = ["BLOCK_REPORT"]

BLOCK_REPORT = ContactReport(
    contact="block",
    sections=f"{__name__}.section:block_sections",
    numbers=f"{__name__}.numbers:block_numbers",
)
