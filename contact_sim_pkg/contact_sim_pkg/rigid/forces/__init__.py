"""Rates of a body under contact forces, for the integrator."""
