"""Systems of *Rolling Contact*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import System

__all__ = ["SYSTEMS"]

SYSTEMS = (
    System(
        "tilt and yaw of the roller with all moments, their stability",
        (("8, 18", "roller/contact: tilt, yaw"), ("16, 17", "roller/stability: tilt, growth_rate")),
        "bench run roller_flutter --set effects.roller.shaft_bending={}",
    ),
    System(
        "contact ellipse of changing radii and load, by the polynomial",
        (("9, 10", "roller/contact: along_x, along_y, peak_pressure, approach"),),
        "bench run roller_steady --set effects.roller.normal_elastic.ellipse=polynomial",
    ),
    System(
        "stress of the pressure under the contact, dangerous volumes, damage",
        (("21-24", "roller/volumes: volume, working_volume"),),
        "bench run roller_steady",
    ),
    System(
        "heave on a wavy track, waves that grow by wear",
        (("third line of 8 and 18", "roller/contact: heave, load"), ("22-24", "roller/track: height")),
        "bench run roller_corrugation",
    ),
    System(
        "fatigue test in load steps: tilt, yaw, heave, stress and wear together, moments that follow the load",
        (("18, 19", "roller/contact: tilt, yaw, heave"), ("figure 2", "roller/track: cycles, height")),
        "bench run roller_programme",
    ),
    System(
        "single formulas: split of the load, angle of the ellipse, linear heave, stress with traction",
        (("3", "3"), ("5", "5"), ("12", "12"), ("20", "20"), ("21", "21")),
        "bench paper rolling-contact --equation N",
    ),
)  # fmt: skip
