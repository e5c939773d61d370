"""Rigid bodies in frictional contact: geometry, contact problem, impact law, motion."""
