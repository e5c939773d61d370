"""The keys of a tire property file that are read, with their dimensions and ranges, the words of its
formats, and the units that such a file may name.

Names and meanings: Pacejka, Tire and Vehicle Dynamics (2012), ch. 4 and appendix 3.
"""

from __future__ import annotations

import math
from typing import NamedTuple

__all__ = ["ALIASES", "IP_FIRST", "KEYS", "NOMINAL", "NOT_USED", "OPERATING", "STRUCTURAL", "UNITS", "Key"]

Powers = tuple[tuple[str, int], ...]
"""Units of the file and their powers in a dimension."""

POUND, STANDARD_GRAVITY, INCH = 0.45359237, 9.80665, 0.0254  # exact by definition
POUND_FORCE = POUND * STANDARD_GRAVITY

UNITS: dict[str, dict[str, float]] = {
    "LENGTH": {
        "meter": 1.0, "metre": 1.0, "m": 1.0, "millimeter": 1e-3, "millimetre": 1e-3, "mm": 1e-3, "centimeter": 1e-2,
        "cm": 1e-2, "kilometer": 1e3, "km": 1e3, "inch": INCH, "in": INCH, "foot": 12.0 * INCH, "ft": 12.0 * INCH,
        "mile": 63360.0 * INCH,
    },
    "FORCE": {
        "newton": 1.0, "n": 1.0, "knewton": 1e3, "kilonewton": 1e3, "kn": 1e3, "kilogram_force": STANDARD_GRAVITY,
        "kgf": STANDARD_GRAVITY, "pound_force": POUND_FORCE, "lbf": POUND_FORCE, "kpound_force": 1e3 * POUND_FORCE,
    },
    "MASS": {
        "kg": 1.0, "kilogram": 1.0, "gram": 1e-3, "g": 1e-3, "tonne": 1e3, "pound_mass": POUND, "lbm": POUND,
        "slug": POUND_FORCE / (12.0 * INCH),
    },
    "TIME": {"second": 1.0, "seconds": 1.0, "sec": 1.0, "s": 1.0, "millisecond": 1e-3, "milli": 1e-3, "ms": 1e-3, "minute": 60.0,
             "min": 60.0, "hour": 3600.0},
    "ANGLE": {
        "radian": 1.0, "radians": 1.0, "rad": 1.0, "degree": math.pi / 180.0, "degrees": math.pi / 180.0,
        "deg": math.pi / 180.0,
    },
    "PRESSURE": {
        "pascal": 1.0, "pa": 1.0, "kilopascal": 1e3, "kpascal": 1e3, "kpa": 1e3, "megapascal": 1e6, "mpa": 1e6,
        "bar": 1e5, "psi": POUND_FORCE / INCH**2, "n/m^2": 1.0, "n/mm^2": 1e6,
    },
}  # fmt: skip
"""Quantity of [UNITS] -> unit in small letters -> factor to SI."""

DIMENSIONS: dict[str, Powers] = {
    "1": (), "m": (("LENGTH", 1),), "N": (("FORCE", 1),), "kg": (("MASS", 1),), "Hz": (("TIME", -1),),
    "N/m": (("FORCE", 1), ("LENGTH", -1)), "kg m^2": (("MASS", 1), ("LENGTH", 2)), "Pa": (("PRESSURE", 1),),
    "N m/rad": (("FORCE", 1), ("LENGTH", 1), ("ANGLE", -1)),
}  # fmt: skip
"""SI unit -> powers of the file's units. A file without PRESSURE has force per length squared."""

NOT_USED = "read, nothing uses it yet"


class Key(NamedTuple):
    """What a key stands for."""

    unit: str  # in SI, of `DIMENSIONS`
    low: float  # least value in SI
    high: float  # largest
    becomes: str

    @property
    def zero_is_none(self) -> bool:
        """Whether 0, which converters write where nothing was measured, is as good as no value."""
        return self.low > 0.0


def _coefficients(names: str, becomes: str = NOT_USED) -> dict[str, Key]:
    return {name: Key("1", -1e4, 1e4, becomes) for name in names.split()}


OPERATING = ("INFLPRES", "IP", "INFLATION_PRESSURE", "TIRE_PRESSURE", "TYRE_PRESSURE", "INFLATION", "PRESSURE")
NOMINAL = ("NOMPRES", "IP_NOM", "NOMINAL_INFLATION_PRESSURE", "NOMINAL_PRESSURE")
"""Words for the inflation of a run, and for that at which the coefficients hold; the first that a
file has counts.
"""

IP_FIRST = ("PAC", "FIALA", "UA", "52")
"""Beginnings of the formats whose own words are IP and IP_NOM: PAC2002, PAC_MC, PAC-TIME, PAC89,
PAC94, FIALA, UATIRE, 5.2.1. Those of MF-Tyre and MF-Swift are INFLPRES and NOMPRES.
"""

STRUCTURAL = {"FTIRE": "FTire", "CDTIRE": "CDTire", "RMODK": "RMOD-K"}
"""Letters in the name of a format or a section -> program of a structural tire model."""

ALIASES = {"QFZ1": "Q_FZ1", "QFZ2": "Q_FZ2", "QPFZ1": "PFZ1"}
"""Spellings of PAC2002."""

KEYS: dict[str, Key] = {
    "UNLOADED_RADIUS": Key("m", 0.05, 3.0, "inflation.radius, unless it is that of the size"),
    "WIDTH": Key("m", 0.05, 1.0, "inflation.size"),
    "ASPECT_RATIO": Key("1", 0.1, 1.2, "inflation.size"),
    "RIM_RADIUS": Key("m", 0.05, 2.0, "inflation.size"),
    **{name: Key("Pa", 1e4, 2e6, "inflation.pressure") for name in OPERATING},
    **{name: Key("Pa", 1e4, 2e6, "pressure of the stiffnesses") for name in NOMINAL},
    "LIP": Key("1", 0.01, 100.0, "factor of the inflation"),
    "FNOMIN": Key("N", 100.0, 2e5, "load of the fit"),
    "VERTICAL_STIFFNESS": Key("N/m", 1e3, 1e8, "fit"),
    "LCZ": Key("1", 0.01, 100.0, "factor of VERTICAL_STIFFNESS"),
    **_coefficients("Q_FZ1 Q_FZ2 PFZ1 Q_RA1 Q_RA2 Q_RB1 Q_RB2", "fit"),
    "BELT_MASS": Key("kg", 0.1, 1000.0, "rigid_ring.belt_mass, inflation.ring_stiffness"),
    "FREQ_LONG": Key("Hz", 1.0, 1e3, "inflation.ring_stiffness"),
    "DAMP_LONG": Key("1", 1e-6, 2.0, "rigid_ring.damping"),
    "BELT_IYY": Key("kg m^2", 1e-4, 1e3, "sidewall_compliance.belt_inertia"),
    "FREQ_WINDUP": Key("Hz", 1.0, 1e3, "sidewall_compliance.rotational, with BELT_IYY"),
    "DAMP_WINDUP": Key("1", 1e-6, 2.0, "sidewall_compliance.damping_ratio"),
    "LONGITUDINAL_STIFFNESS": Key("N/m", 1e2, 1e9, NOT_USED),
    "LATERAL_STIFFNESS": Key("N/m", 1e2, 1e9, "sidewall_compliance.lateral, less the bristles in series"),
    "YAW_STIFFNESS": Key("N m/rad", 1.0, 1e9, "sidewall_compliance.yaw"),
    **_coefficients("PKX1 PKX2 PKX3 PKY1 PKY2 PKY4 QDZ1 QDZ2", "brush.stiffness_x and _y, sidewall_compliance: fit"),
    **_coefficients("PDX1 PDX2 PDY1 PDY2", "brush: friction and its fall with the load"),
    **_coefficients("QSY1 QSY2 QSY3 QSY4 QSY5 QSY6 QSY7 QSY8"),
}
