"""Systems of *Identifiability*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import Parameter, System

__all__ = ["SYSTEMS"]

CONTACT = "effects.block.rigid_contact"

SYSTEMS = (
    System("rigid body with frictional contact, one complementarity problem an instant",
           (("9", "block/force: normal, tangential"),),
           f"bench run block_fall --set {CONTACT}.rule=newton"),
    System("fall of a block on its corner, instants of contact located", (("figure 1", "first impact"),),
           "bench paper identifiability --figure 1"),
    System(
        "single formulas: complementarity, sliding and sticking in closed form, gap of a corner, two-point formulas",
        (("2", "2"), ("9", "9"), ("12-18, 32-34", "17"), ("23", "23"), ("40-42", "40"), ("43", "43"), ("44, 45", "44")),
        "bench paper identifiability --equation N",
    ),
    System("inertia and impulses from a motion, what is identifiable", (("39", "identified, value, standard deviation"),),
           "bench identify BAG --box 0.1 0.1 0.1"),
    System(
        "ten inertial parameters of one free body by a regressor, batch and recursive least squares",
        (("form of 1", "batch, recursive"),),
        "bench paper identifiability --system inertia examples/papers/inertia.csv", name="inertia",
        run="contact_sim_lab.papers.identifiability.system_inertia:inertia",
        input="a bag with Imu and WrenchStamped, AccelStamped where there is one, all in body axes at the sensor; or a CSV file of "
              "the same, as examples/papers/inertia.csv",
    ),
    System(
        "principal moments of a body whose principal axes are known: three unknowns", (("19-31", "I_over_m_m2, deviation_m2"),),
        "bench paper identifiability --system axes BAG --set box=0.2,0.12,0.08", name="axes",
        run="contact_sim_lab.papers.identifiability.system_axes:axes",
        input="a bag with the motion of a box, as bench identify takes it",
        parameters=(
            Parameter("box", "m", (0.1, 0.1, 0.1), above=0.0, most=1e3, help="lengths of the box, along its axes"),
            Parameter("axes", "rad", (0.0, 0.0, 0.0), least=-10.0, most=10.0,
                      help="rotation vector from the axes of the box to the principal axes"),
            Parameter("gravity", "m/s²", 9.81, least=0.0, most=1e3),
        ),
    ),
)  # fmt: skip
