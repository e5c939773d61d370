"""`bench accuracy RIG` and `--parts`: work and precision."""
