"""Pressure fields of tire and cushion as the heights that the bodies stand on."""
