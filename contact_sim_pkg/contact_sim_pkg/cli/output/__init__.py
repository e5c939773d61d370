"""What the command prints: tables, progress, outcome."""
