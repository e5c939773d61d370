"""Rigid bodies in contact by this project and by general engines, on the same problems, in one run: `make compare-dynamics`."""
