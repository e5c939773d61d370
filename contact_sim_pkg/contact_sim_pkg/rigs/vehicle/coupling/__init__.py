"""From one solution of the pressure fields to the next: how far, and what it misses."""
