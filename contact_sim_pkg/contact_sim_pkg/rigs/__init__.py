"""The rigs of the bench, a folder each: physics, scene keys, outputs, report."""

from contact_sim_pkg.public import on_use

PACKAGES = tuple(f"{__name__}.{name}" for name in ("vehicle", "backrest", "occupant", "impact", "body", "roller"))
"""Packages that export `RIGS`, in the order of the documentation."""

__getattr__ = on_use(
    __name__,
    {
        "Contact": "contact_sim_pkg.records.contact:Contact",
        "Effect": "contact_sim_pkg.records.effect:Effect",
        "Rig": "contact_sim_pkg.records.rig:Rig",
        "make_simulation": "contact_sim_pkg.run.rigs:make_simulation",
        "rigs": "contact_sim_pkg.records.registry:rigs",
    },
)
