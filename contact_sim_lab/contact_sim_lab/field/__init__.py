"""Cases of the pressure field."""
