"""Figures that every rig shares."""
