"""Inertia and contact impulses from the motion of a rigid body. numpy and scipy only."""
