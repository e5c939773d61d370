"""Cnoidal waves and theta functions (driver-seat paper, eqs 12 to 16)."""
