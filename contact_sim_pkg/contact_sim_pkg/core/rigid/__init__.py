"""Rigid bodies with frictional contact: impact laws, complementarity solvers, time stepping in the plane and in space."""
