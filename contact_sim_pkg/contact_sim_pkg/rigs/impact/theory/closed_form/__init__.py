"""Closed forms of the impact: scalings, flight, stress, surface wave."""
