"""Ranges that a run has left: the strain of a cushion's foam, the elastic range of a contact."""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.pressure.cushion import REACH, VALID_STRAIN, valid_strain
from contact_sim_pkg.report.series import FloatArray, Recording

__all__ = ["FIRST_YIELD", "cushion_warnings", "yield_warnings"]

FIRST_YIELD = 1.60
"""Largest Hertz pressure over the yield strength at which a circular contact without traction
begins to yield, 0.48 a below its middle (nu = 0.3; Johnson, Contact Mechanics, 6.1). Under an
ellipse it is more, up to 1.67 (Tresca) or 1.79 (von Mises) under a line; under traction less.
"""


def cushion_warnings(contact: str, recording: Recording) -> list[str]:
    """Sentences on a ``contact`` whose cushion was compressed beyond the range of its foam, or of
    its table; none where tissue takes a part of the approach.
    """
    keys = ((recording.scene.get("effects") or {}).get(contact) or {}).get("cushion")
    series = recording.contacts.get(contact)
    if not keys or "tissue" in keys or series is None or series.approach.size == 0:
        return []
    strain = series.approach / float(keys["thickness"])
    curve = keys.get("curve")
    valid = valid_strain(None if curve is None else curve["points"])
    if strain.max() <= valid:
        return []
    found = f"The cushion of the {contact} was compressed to {strain.max():.2f} of its thickness"
    beyond = int((strain > REACH).sum())
    if beyond and curve is None:
        return [
            f"{found}; beyond {REACH:g} ({beyond} of {strain.size} samples) its force goes on along a straight line."
        ]
    if curve is not None:
        outside = int((strain > valid).sum())
        return [
            f"{found}; its measured curve ends at {valid:.4g}, beyond it ({outside} of {strain.size} samples) the slope stays."
        ]
    return [f"{found}; the law of its foam holds to {VALID_STRAIN:g}."]


def yield_warnings(key: str, strength: float | None, time: FloatArray, pressure: FloatArray) -> list[str]:
    """A sentence where the largest ``pressure`` [Pa] of a contact, at each ``time`` [s], passes
    FIRST_YIELD times the ``strength`` [Pa] that the scene key ``key`` states; none where it states
    none.
    """
    if strength is None or pressure.size == 0:
        return []
    limit = FIRST_YIELD * float(strength)
    beyond = np.flatnonzero(pressure > limit)
    if beyond.size == 0:
        return []
    sentence = (
        f"The contact leaves the elastic range: its pressure passes {limit * 1e-6:.4g} MPa, {FIRST_YIELD:g} times {key}, first "
        f"at {float(time[beyond[0]]):.4g} s, and reaches {float(pressure.max()) * 1e-6:.4g} MPa; from there on the material "
        "yields below the surface, which the run does not model. A lower load, or a larger radius, stays elastic."
    )
    return [sentence]
