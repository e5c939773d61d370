"""Systems of *Identifiability*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import System

__all__ = ["SYSTEMS"]

SYSTEMS = (
    System("rigid body with frictional contact in time, by complementarity", "2-9", "bench run block_fall"),
    System("block with four corners: gap functions, sliding and sticking in closed form", "10-18, 32-34, 40-45",
           "bench paper identifiability --figure 1"),
    System("inertia and impulses from a motion, what is identifiable", "19-31, 35-39", "bench identify BAG --box 0.1 0.1 0.1"),
)  # fmt: skip
