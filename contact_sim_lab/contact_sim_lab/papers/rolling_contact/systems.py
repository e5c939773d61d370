"""Systems of *Rolling Contact*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import System

__all__ = ["SYSTEMS"]

SYSTEMS = (
    System("split of the load into contact and bending", "1-7", "bench paper rolling-contact --equation 5"),
    System("tilt and yaw of the roller, their stability", "8, 11-18", "bench run roller_flutter"),
    System("contact ellipse of changing radii and load", "9, 10", "bench run roller_steady"),
    System("stress under the contact, dangerous volumes, damage", "21-24", "bench run roller_steady"),
    System("heave on a wavy track, waves that grow by wear: one interval of the procedure", "19, 20, figure 15",
           "bench run roller_corrugation"),
    System("fatigue test in load steps", "figure 2", "bench run roller_programme"),
)  # fmt: skip
