"""Occupant on a cushion and against a seat back under one body."""
