"""Closed forms of the impact: force, scalings, flight, severity."""
