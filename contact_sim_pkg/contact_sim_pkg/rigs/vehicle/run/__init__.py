"""A run: from one solution of the pressure fields to the next, how far, and what it misses."""
