"""Scenes as data: YAML to a validated scene, accuracy to explicit grids and tolerances."""
