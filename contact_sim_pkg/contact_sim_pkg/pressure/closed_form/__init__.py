"""Contacts whose pressure has a formula: Hertz, Lamé domains, axisymmetric profiles; stress below
the surface.
"""
