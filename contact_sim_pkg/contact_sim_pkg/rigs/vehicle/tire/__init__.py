"""Tire on a road: pressure field, belt, tread, brush, asperities."""
