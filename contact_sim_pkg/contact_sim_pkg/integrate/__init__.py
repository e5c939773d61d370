"""Adaptive time integration of a rig with located events."""
