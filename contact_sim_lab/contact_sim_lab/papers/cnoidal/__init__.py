"""Cnoidal waves and theta functions (Driver and Seat, eqs 12 to 16)."""
