"""The Magic Formula of a tire: its equations, and the coefficients of a property file."""
