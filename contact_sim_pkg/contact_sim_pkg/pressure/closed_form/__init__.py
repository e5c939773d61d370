"""Contacts whose pressure has a formula: Hertz, Lamé domains, axisymmetric profiles; stress below
the surface.
"""

__all__ = ["FIT_EXPONENTS"]

FIT_EXPONENTS = (0.3, 20.0)
"""Range of the exponent n that a Lamé curve is fitted with."""
