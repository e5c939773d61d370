"""*Tire/Road Contact*: its record, figures, equations and errata."""
