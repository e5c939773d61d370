"""*Identifiability*: its record, figures, equations and errata."""
