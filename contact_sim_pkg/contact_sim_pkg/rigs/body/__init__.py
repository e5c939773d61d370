"""Rigid body on the ground with friction: rig block."""
