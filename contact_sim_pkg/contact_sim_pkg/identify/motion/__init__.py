"""Segments of a recorded motion: flight, rotation, spin, slides."""
