"""Seat cushion under an occupant: its shape and its pressure map."""
