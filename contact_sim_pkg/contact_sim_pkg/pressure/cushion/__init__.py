"""Pressure field of a foam cushion of finite thickness, and the force law that is its integral."""

__all__ = ["REACH", "VALID_STRAIN"]

VALID_STRAIN = 0.75
"""To which the law of a seat foam holds."""
REACH = 0.85
"""Of the thickness: the last approach of a table; beyond it the force goes on along its tangent."""
