"""Pressure fields of a contact: half-space, bonded layers, closed forms, map of a mat."""

from contact_sim_pkg.public import on_use

__getattr__ = on_use(
    __name__,
    {
        "HertzContact": f"{__name__}.closed_form.hertz:HertzContact",
        "hertz_contact": f"{__name__}.closed_form.hertz:hertz_contact",
        "hertz_contact_at_approach": f"{__name__}.closed_form.hertz:hertz_contact_at_approach",
        "make_half_space": f"{__name__}.field.halfspace:make_half_space",
        "make_workspace": f"{__name__}.field.solver:make_workspace",
        "solve_at_approach": f"{__name__}.field.solver:solve_at_approach",
        "solve_at_load": f"{__name__}.field.solver:solve_at_load",
    },
)
