"""Pressure fields of a contact: half-space, bonded layers, closed forms, map of a mat."""
