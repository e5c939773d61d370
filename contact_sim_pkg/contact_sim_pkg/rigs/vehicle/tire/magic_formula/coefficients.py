"""Coefficients of the Magic Formula as a property file gives them: which are needed, what stands for one that is left
out, and which keys of the file nothing uses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal, NamedTuple

from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.keys import IP_FIRST, KEYS, NOMINAL, OPERATING, UNITS
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile

__all__ = [
    "COEFFICIENTS", "EARLIER", "KNOWN", "LATER", "NEEDED", "MagicFormula", "Version", "formula_of", "has_formula",
    "magic_formula", "stated_coefficients",
]  # fmt: skip

Version = Literal["6.1 and later", "5.2 and PAC2002"]
LATER: Version = "6.1 and later"
EARLIER: Version = "5.2 and PAC2002"

NEEDED = ("FNOMIN", "UNLOADED_RADIUS", "PCX1", "PDX1", "PKX1", "PCY1", "PDY1", "PKY1", "PKY2")
SCALING = "LFZO LCX LMUX LEX LKX LHX LVX LCY LMUY LEY LKY LHY LVY LTR LRES LXAL LYKA LVYKA LS LKYC LKZC LVMX LMX LMY LSGKP LSGAL"
OPTIONAL = (
    "PDX2 PDX3 PEX1 PEX2 PEX3 PEX4 PKX2 PKX3 PHX1 PHX2 PVX1 PVX2 PPX1 PPX2 PPX3 PPX4 RBX1 RBX2 RBX3 RCX1 REX1 REX2 RHX1 "
    "PDY2 PDY3 PEY1 PEY2 PEY3 PEY4 PEY5 PKY3 PKY5 PKY6 PKY7 PHY1 PHY2 PHY3 PVY1 PVY2 PVY3 PVY4 PPY1 PPY2 PPY3 PPY4 PPY5 "
    "RBY1 RBY2 RBY3 RBY4 RCY1 REY1 REY2 RHY1 RHY2 RVY1 RVY2 RVY3 RVY4 RVY5 RVY6 "
    "QBZ1 QBZ2 QBZ3 QBZ4 QBZ5 QBZ6 QBZ9 QBZ10 QCZ1 QDZ1 QDZ2 QDZ3 QDZ4 QDZ6 QDZ7 QDZ8 QDZ9 QDZ10 QDZ11 QEZ1 QEZ2 QEZ3 QEZ4 "
    "QEZ5 QHZ1 QHZ2 QHZ3 QHZ4 PPZ1 PPZ2 SSZ1 SSZ2 SSZ3 SSZ4 "
    "QSX1 QSX2 QSX3 QSX4 QSX5 QSX6 QSX7 QSX8 QSX9 QSX10 QSX11 QSX12 QSX13 QSX14 PPMX1 QSY1 QSY2 QSY3 QSY4 QSY5 QSY6 QSY8 "
    "PTX1 PTX2 PTX3 PTY1 PTY2 PCFX1 PCFX2 PCFX3 PCFY1 PCFY2 PCFY3"
)
OTHERWISE = {"PKY4": 2.0, "QSY7": 1.0, "LONGVL": 16.67}
"""What stands for a key that a file leaves out, where that is not 0."""

COEFFICIENTS: dict[str, float] = {
    **dict.fromkeys(NEEDED, math.nan), **dict.fromkeys(SCALING.split(), 1.0), **dict.fromkeys(OPTIONAL.split(), 0.0), **OTHERWISE,
}  # fmt: skip
"""Every coefficient, and its value where the file has none; nan: it must be there."""

STANDING = ("WIDTH", "VERTICAL_STIFFNESS", "LCZ", "Q_FZ1", "Q_FZ2", "PFZ1", "Q_RA1", "Q_RA2", "Q_RB1", "Q_RB2")
"""Of the vertical law and the contact, `property_file/magic_formula.py`."""
FIRST_WITH_INFLATION = 60  # FITTYP
CARCASS = ("LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS")
"""[N/m] of the carcass along and across, for the relaxation."""
RANGES = {
    "FZMIN": "FORCE", "FZMAX": "FORCE", "KPUMIN": "", "KPUMAX": "", "ALPMIN": "ANGLE", "ALPMAX": "ANGLE",
    "PRESMIN": "PRESSURE", "PRESMAX": "PRESSURE",
}  # fmt: skip
"""Ends of what was measured, and the quantity of their unit: load, slip, slip angle, inflation."""
KNOWN = frozenset((*COEFFICIENTS, "INFLPRES", "NOMPRES", *CARCASS, *RANGES))
"""Names that the coefficients of a scene may have."""
LEAST_PASCAL = 1e4  # a pressure without a unit from there on is in Pa
NOT_MODELLED = {"LMUV": 0.0, "LGAX": 1.0, "LGAY": 1.0, "LGAZ": 1.0}
"""Scalings of what is not here (camber of 5.2, friction over slip speed), with the value that has no effect."""


class MagicFormula(NamedTuple):
    """The formula of one file."""

    file: str
    keys: dict[str, float]  # `COEFFICIENTS` and those below, in SI
    version: Version
    used: tuple[str, ...]  # keys of the file
    ignored: tuple[str, ...]  # its other keys, named
    inflation: float  # [Pa] of the file
    stiffness: tuple[float, float] | None  # [N/m] along and across of the carcass, for the relaxation; None: PTX, PTY
    notes: tuple[str, ...]
    ranges: dict[str, float]  # `RANGES` that the file states, in SI


def has_formula(tire: PropertyFile) -> bool:
    """Whether a file gives the coefficients that are needed."""
    return all(_number(tire, key) is not None for key in NEEDED)


def magic_formula(tire: PropertyFile) -> MagicFormula:
    """The coefficients of a file.

    Raises PropertyFileError where a needed one is missing, or a nominal value is not positive.
    """
    stated = stated_coefficients(tire)
    formula = formula_of(stated, LATER if _is_later(tire) else EARLIER, tire.file)
    words = (*OPERATING, *NOMINAL, "FITTYP")
    used = [key for key in (*tire.values, *tire.further) if key in stated or key in words]
    ignored = [key for key in (*tire.values, *tire.unread) if key not in used and not _without_effect(tire, key)]
    return formula._replace(used=tuple(used), ignored=tuple(ignored))


def stated_coefficients(tire: PropertyFile) -> dict[str, float]:
    """What a file states of `KNOWN`, in SI, inflations under the names of MF-Tyre."""
    stated = {key: value for key in COEFFICIENTS if (value := _number(tire, key)) is not None}
    pressures = {
        "INFLPRES": _pressure(tire, OPERATING, "IP"), "NOMPRES": _pressure(tire, NOMINAL, "IP_NOM"),
    }  # fmt: skip
    stated |= {key: value for key, value in pressures.items() if value is not None}
    carcass = {key: value for key in CARCASS if (value := tire.get(key))}
    if len(carcass) == len(CARCASS) and not stated.get("PTY1"):
        stated |= carcass
    return stated | {key: value for key in RANGES if (value := _end(tire, key)) is not None}


def formula_of(stated: Mapping[str, float], version: Version, file: str) -> MagicFormula:
    """The formula of coefficients ``stated`` in SI under names of `KNOWN`; ``file`` is named where they are none.

    Raises PropertyFileError where a needed one is missing, or a nominal value is not positive.
    """
    missing = [key for key in NEEDED if key not in stated]
    if missing:
        raise PropertyFileError(f"{file}: the Magic Formula needs {', '.join(missing)}, which the file does not give")
    keys = {key: stated.get(key, usual) for key, usual in COEFFICIENTS.items()}
    if not (keys["FNOMIN"] > 0.0 and keys["UNLOADED_RADIUS"] > 0.0 and keys["LONGVL"] > 0.0 and keys["PKY2"] != 0.0):
        raise PropertyFileError(
            f"{file}: FNOMIN, UNLOADED_RADIUS and LONGVL above 0 and a PKY2 other than 0 are allowed"
        )
    notes = []
    inflation = stated.get("INFLPRES") or stated.get("NOMPRES") or 0.0
    if not inflation:
        notes.append("no inflation in the file: the coefficients count at every inflation")
    keys["NOMPRES"] = stated.get("NOMPRES") or inflation or 1.0
    if keys["PKY1"] > 0.0:
        notes.append("PKY1 is above 0: a file of the adapted SAE axes, turned over to the bench's")
    later = 1.0 if version == LATER else 0.0
    keys |= {"BY_TANGENT": later, "CAMBER_FORCE": later}
    along, across = (stated.get(key) for key in CARCASS)
    stiffness = (along, across) if along and across and not keys["PTY1"] else None
    ranges = {key: stated[key] for key in RANGES if key in stated}
    return MagicFormula(file, keys, version, (), (), inflation, stiffness, tuple(notes), ranges)


def _is_later(tire: PropertyFile) -> bool:
    """Whether a file is of MF-Tyre 6.0 or later: FITTYP, else the coefficients that came with it."""
    found = tire.further.get("FITTYP")
    if found is not None:
        return FIRST_WITH_INFLATION <= found.value < 100
    return not tire.format.startswith(IP_FIRST) and "PKY4" in (*tire.values, *tire.further)


def _number(tire: PropertyFile, key: str) -> float | None:
    """A number of the file; of a key without a unit as it is written."""
    if key in KEYS:
        return tire.get(key)
    found = tire.further.get(key)
    if found is None:
        return None
    factor = UNITS["LENGTH"][tire.units["LENGTH"]] / UNITS["TIME"][tire.units["TIME"]] if key == "LONGVL" else 1.0
    return factor * found.value


def _end(tire: PropertyFile, key: str) -> float | None:
    """An end of a range in SI; None where the file has none, or one in a unit that nobody names."""
    found, quantity = tire.further.get(key), RANGES[key]
    if found is None:
        return None
    if quantity == "PRESSURE" and quantity not in tire.units:
        return found.value if found.value >= LEAST_PASCAL else None
    return found.value * (UNITS[quantity][tire.units[quantity]] if quantity else 1.0)


def _pressure(tire: PropertyFile, words: tuple[str, ...], own: str) -> float | None:
    """The first inflation [Pa] of the words, the ``own`` one of its format first."""
    order = (own, *words) if tire.format.startswith(IP_FIRST) else words
    return next((value for word in order if (value := tire.get(word))), None)


def _without_effect(tire: PropertyFile, key: str) -> bool:
    """Whether a scaling of what is not modelled is at the value that has no effect."""
    found = tire.further.get(key)
    return found is not None and NOT_MODELLED.get(key) == found.value
