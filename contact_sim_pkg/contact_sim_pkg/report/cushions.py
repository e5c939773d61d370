"""Ranges of a cushion that a run has left."""

from __future__ import annotations

from contact_sim_pkg.pressure.cushion import REACH, VALID_STRAIN
from contact_sim_pkg.report.series import Recording

__all__ = ["cushion_warnings"]


def cushion_warnings(contact: str, recording: Recording) -> list[str]:
    """Sentences on a ``contact`` whose cushion was compressed beyond the range of its foam, or of
    its table.
    """
    keys = ((recording.scene.get("effects") or {}).get(contact) or {}).get("cushion")
    series = recording.contacts.get(contact)
    if not keys or series is None or series.approach.size == 0:
        return []
    strain = series.approach / float(keys["thickness"])
    if strain.max() <= VALID_STRAIN:
        return []
    found = f"The cushion of the {contact} was compressed to {strain.max():.2f} of its thickness"
    beyond = int((strain > REACH).sum())
    if beyond:
        return [
            f"{found}; beyond {REACH:g} ({beyond} of {strain.size} samples) its force goes on along a straight line."
        ]
    return [f"{found}; the law of its foam holds to {VALID_STRAIN:g}."]
