"""Accuracy study of the occupant."""
