"""The rigs that a scene can name, found through the packages that export them.

Every part of the bench goes over this registry; none asks which rig it is.
"""

from __future__ import annotations

from functools import cache

from contact_sim_pkg.records.report import ContactReport
from contact_sim_pkg.records.rig import Rig, load

__all__ = ["contact_reports", "contacts", "refused_sections", "rig_names", "rigs"]

_PACKAGES = "contact_sim_pkg.rigs:PACKAGES"


@cache
def rigs() -> dict[str, Rig]:
    """Every rig by its name, in the order of the packages.

    Raises:
        ValueError: two packages export a rig of the same name.
    """
    found: dict[str, Rig] = {}
    for package in load(_PACKAGES):
        for rig in load(f"{package}:RIGS"):
            if rig.name in found:
                raise ValueError(f"two rigs are named {rig.name}: one of {package}; rename one of them")
            found[rig.name] = rig
    return found


def rig_names() -> tuple[str, ...]:
    """Names of all rigs."""
    return tuple(rigs())


@cache
def contacts() -> tuple[str, ...]:
    """Contacts of all rigs, each once."""
    return tuple(dict.fromkeys(name for rig in rigs().values() for name in rig.contacts))


@cache
def contact_reports() -> dict[str, ContactReport]:
    """Reports of the contacts of all rigs, by contact; where rigs share a contact, that of the first rig counts."""
    found: dict[str, ContactReport] = {}
    for name in dict.fromkeys(name for rig in rigs().values() for name in rig.report):
        report: ContactReport = load(name)
        found.setdefault(report.contact, report)
    return found


def refused_sections(rig: str) -> tuple[str, ...]:
    """Sections of a scene that have no meaning for a rig."""
    own = {*rigs()[rig].needs, *rigs()[rig].takes}
    others = dict.fromkeys(name for each in rigs().values() for name in (*each.needs, *each.takes))
    return tuple(name for name in others if name not in own)
