"""Output of the command: tables, progress, outcome."""
