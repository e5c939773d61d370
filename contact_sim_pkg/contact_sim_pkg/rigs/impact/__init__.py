"""Sphere that strikes a viscoelastic sample: drop tower and pendulum."""
