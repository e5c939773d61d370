"""What the papers say beyond the rigs."""
