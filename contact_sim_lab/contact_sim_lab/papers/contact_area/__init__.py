"""*Contact Area*: its record, figures, equations and errata."""
