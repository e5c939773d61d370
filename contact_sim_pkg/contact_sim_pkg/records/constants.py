"""Constants that several rigs share."""

GRAVITY = 9.81
"""[m/s^2], downward, where a scene does not give it."""
