"""*Rolling Contact*: its record, figures, equations and errata."""
