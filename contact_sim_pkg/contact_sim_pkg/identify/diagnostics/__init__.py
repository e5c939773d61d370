"""Consistency of the numbers: rank, noise, balances, warnings."""
