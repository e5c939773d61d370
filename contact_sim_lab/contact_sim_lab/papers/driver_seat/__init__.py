"""*Driver and Seat*: its record, figures, equations and errata."""
