"""Rigs of one mass for studies of a single law: stick-slip, works of an impact; runs of them."""
