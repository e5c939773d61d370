"""The metrics of a run: one list a rig, with bands, and the ways it is printed."""
