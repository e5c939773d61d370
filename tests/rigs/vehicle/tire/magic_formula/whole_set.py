"""A whole set of the Magic Formula 6.2 of a tire that nobody made: no coefficient without camber is 0."""

from tests.rigs.vehicle.tire.property_file.tir_file import SI

DIMENSIONS = {
    "UNLOADED_RADIUS": 0.321, "WIDTH": 0.209, "ASPECT_RATIO": 0.57, "RIM_RADIUS": 0.2019, "RIM_WIDTH": 0.17,
    "LONGVL": 16.1, "INFLPRES": 231000.0, "NOMPRES": 217000.0, "FNOMIN": 4100.0,
    "VERTICAL_STIFFNESS": 207000.0, "Q_FZ2": 14.1, "PFZ1": 0.71, "Q_RA1": 0.66, "Q_RA2": 0.75, "Q_RB1": 1.07, "Q_RB2": -1.19,
    "LONGITUDINAL_STIFFNESS": 361000.0, "LATERAL_STIFFNESS": 161000.0, "PCFX1": 0.12, "PCFX2": -0.07, "PCFX3": 0.19,
    "PCFY1": -0.21, "PCFY2": 0.06, "PCFY3": 0.63,
}  # fmt: skip
SCALES = {
    "LFZO": 1.02, "LCX": 0.99, "LMUX": 0.93, "LEX": 1.03, "LKX": 0.97, "LHX": 1.1, "LVX": 0.9, "LCY": 1.01, "LMUY": 0.95,
    "LEY": 0.98, "LKY": 1.04, "LHY": 0.92, "LVY": 1.07, "LTR": 1.05, "LRES": 0.94, "LXAL": 1.02, "LYKA": 0.97, "LVYKA": 1.06,
    "LS": 0.96, "LKYC": 1.0, "LKZC": 1.0, "LVMX": 1.03, "LMX": 0.98, "LMY": 1.05,
}  # fmt: skip
COEFFICIENTS = {
    "PCX1": 1.571, "PDX1": 1.083, "PDX2": -0.087, "PEX1": 0.213, "PEX2": 0.109, "PEX3": 0.041, "PEX4": 0.117, "PKX1": 21.3,
    "PKX2": 2.7, "PKX3": 0.193, "PHX1": 0.00121, "PHX2": -0.00083, "PVX1": 0.0171, "PVX2": 0.0093, "PPX1": -0.352,
    "PPX2": 0.413, "PPX3": -0.071, "PPX4": -0.213, "RBX1": 13.1, "RBX2": 9.7, "RCX1": 1.071, "REX1": -0.433, "REX2": -0.113,
    "RHX1": 0.0047,
    "PCY1": 1.337, "PDY1": 0.961, "PDY2": -0.127, "PEY1": -0.813, "PEY2": -0.343, "PEY3": 0.097, "PKY1": -18.7, "PKY2": 1.51,
    "PKY4": 1.83, "PHY1": 0.00213, "PHY2": 0.00071, "PVY1": 0.0193, "PVY2": -0.0061, "PPY1": 0.413, "PPY2": 0.957,
    "PPY3": -0.063, "PPY4": 0.119, "RBY1": 11.3, "RBY2": 8.1, "RBY3": -0.0131, "RCY1": 1.037, "REY1": 0.271, "REY2": 0.083,
    "RHY1": 0.0083, "RHY2": 0.0021, "RVY1": 0.0213, "RVY2": -0.0117, "RVY4": 11.7, "RVY5": 1.73, "RVY6": -13.1,
    "QBZ1": 9.73, "QBZ2": -1.17, "QBZ3": -0.43, "QBZ9": 17.9, "QBZ10": 0.123, "QCZ1": 1.193, "QDZ1": 0.103, "QDZ2": -0.0047,
    "QDZ6": 0.00171, "QDZ7": -0.0013, "QEZ1": -1.61, "QEZ2": 0.713, "QEZ3": -0.211, "QEZ4": 0.173, "QHZ1": 0.0043,
    "QHZ2": -0.0011, "PPZ1": -0.413, "SSZ1": 0.0171, "SSZ2": 0.0093, "SSZ4": 0.017,
    "QSX1": 0.0031, "QSX3": 0.0213, "QSX4": 4.9, "QSX5": 0.41, "QSX6": 0.83, "QSX8": 0.071, "QSX9": 0.93, "QSX13": 0.0017,
    "QSY1": 0.0073, "QSY2": 0.0021, "QSY3": 0.0011, "QSY4": 0.00013, "QSY7": 0.87, "QSY8": -0.41,
}  # fmt: skip
SET = {**DIMENSIONS, **SCALES, **COEFFICIENTS}


def tir_text(**changed):
    """The set as a file, with changed keys; None leaves one out."""
    keys = {"FITTYP": 62, **SET, **changed}
    lines = [
        "[MDI_HEADER]",
        "FILE_TYPE = 'tir'",
        "[UNITS]",
        *(f"{name} = {unit}" for name, unit in SI.items()),
        "[MODEL]",
    ]
    return "\n".join([*lines, *(f"{name} = {value!r}" for name, value in keys.items() if value is not None)]) + "\n"
