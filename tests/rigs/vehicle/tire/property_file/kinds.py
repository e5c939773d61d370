"""Property files of the kinds that are in use, each in its own words: formats, units, vehicles. The tires are nobody's."""

from typing import NamedTuple

SI = {"LENGTH": "meter", "FORCE": "newton", "ANGLE": "radians", "MASS": "kg", "TIME": "second"}
MILLIMETRES = {**SI, "LENGTH": "mm", "ANGLE": "degrees"}
INCHES = {"LENGTH": "inch", "FORCE": "pound_force", "ANGLE": "degrees", "MASS": "pound_mass", "TIME": "second"}
CURVE = """\
[DEFLECTION_LOAD_CURVE]
{pen fz}
0.000 0.0
0.005 950.0
0.010 2000.0
0.015 3120.0
0.020 4280.0
0.030 6650.0
0.040 9100.0
"""
HEAVY = """\
[DEFLECTION_LOAD_CURVE]
{pen fz}
0.00 0.0
0.02 6900.0
0.04 14000.0
0.05 17600.0
0.06 21600.0
0.08 30200.0
"""


class Kind(NamedTuple):
    """A file, and what it says of the standing tire by its own formulas, worked out by hand."""

    text: str
    size: str
    pressure: float  # [Pa]
    load: float  # [N]
    stiffness: float  # [N/m]
    deflection: float  # [m]


def kind(size, pressure, load, stiffness, *, form, units=SI, deflection=None, after="", comment="", **keys):
    """A file of a ``size`` (mm, per cent, inch of rim), its keys in the units of the file but for those here, in SI."""
    width, aspect, rim = size
    scale = {"meter": 1.0, "mm": 1e-3, "inch": 0.0254}[units["LENGTH"]]
    force = {"newton": 1.0, "pound_force": 4.4482216152605}[units["FORCE"]]
    radius = 0.0127 * rim + 1e-5 * width * aspect
    given = {
        "UNLOADED_RADIUS": radius / scale, "WIDTH": 1e-3 * width / scale, "ASPECT_RATIO": 1e-2 * aspect,
        "RIM_RADIUS": 0.0127 * rim / scale, "FNOMIN": load / force, "VERTICAL_STIFFNESS": stiffness * scale / force,
    }  # fmt: skip
    given = {**given, **keys}
    head = [
        "[MDI_HEADER]",
        "FILE_TYPE = 'tir'",
        "FILE_VERSION = 3.0",
        "FILE_FORMAT = 'ASCII'",
        *comment.splitlines(),
        "[UNITS]",
    ]
    lines = [*head, *(f"{name} = '{unit}'" for name, unit in units.items()), "[MODEL]", *form, "[DIMENSION]"]
    lines += [f"{name:<24}= {value!r}" for name, value in given.items() if value is not None]
    made = "\n".join([*lines, after])
    return Kind(made, f"{width}/{aspect} R{rim:g}", pressure, load, stiffness, deflection or load / stiffness)


def swift(load, stiffness, square, radius):
    """Deflection [m] under the nominal load: q_1 x + q_2 x^2 = 1, c = (F / R) sqrt(q_1^2 + 4 q_2)."""
    root = stiffness * radius / load
    linear = (root**2 - 4.0 * square) ** 0.5
    return radius * 2.0 / (linear + root)


CAR = (205, 55, 16)
SWIFT = {"Q_FZ2": 14.0, "PFZ1": 0.7, "Q_RA1": 0.67, "Q_RA2": 0.73, "Q_RB1": 1.06, "Q_RB2": -1.19}
KINDS = {
    "MF-Tyre 5.2, car": kind((195, 65, 15), 220e3, 4100.0, 196e3, form=["PROPERTY_FILE_FORMAT = 'MF_05'", "FITTYP = 52"]),
    "MF-Tyre 5.0, light truck, inflation in bar": kind(
        (225, 75, 16), 350e3, 7000.0, 330e3, form=["PROPERTY_FILE_FORMAT = 'MF-TYRE'", "FITTYP = 5"], INFLATION_PRESSURE=3.5,
        comment="! TIRE_VERSION: MF-TYRE 5.0 (W-axis system)",
    ),
    "MF 6.1, car": kind(
        (225, 50, 17), 230e3, 4850.0, 238e3, form=["FITTYP = 61", "LONGVL = 16.7"], INFLPRES=230000, NOMPRES=230000,
    ),
    "MF-Swift 6.2, car": kind(
        CAR, 240e3, 4300.0, 222e3, form=["FITTYP = 62"], INFLPRES=240000, NOMPRES=240000,
        deflection=swift(4300.0, 222e3, 14.0, 0.31595), **SWIFT,
    ),
    "MF-Swift 6.2, SUV": kind(
        (255, 55, 20), 250e3, 6000.0, 268e3, form=["FITTYP = 62"], INFLPRES=250000, NOMPRES=250000,
        deflection=swift(6000.0, 268e3, 16.0, 0.39425), **{**SWIFT, "Q_FZ2": 16.0},
    ),
    "PAC2002, car": kind(
        (245, 40, 18), 250e3, 4850.0, 268e3, form=["PROPERTY_FILE_FORMAT = 'PAC2002'", "FITTYP = 6"], IP=250000, IP_NOM=250000,
    ),
    "PAC2002, table of loads": kind(
        CAR, 220e3, 4000.0, 232e3, form=["PROPERTY_FILE_FORMAT = 'PAC2002'"], after=CURVE, VERTICAL_STIFFNESS=230000.0,
        deflection=0.015 + 0.005 * 880.0 / 1160.0,
    ),
    "PAC2002, millimetres": kind(
        (185, 65, 15), 210e3, 3700.0, 186e3, form=["PROPERTY_FILE_FORMAT = 'PAC2002'"], units=MILLIMETRES, IP=0.21,
    ),
    "PAC_MC, motorcycle front": kind(
        (120, 70, 17), 250e3, 1500.0, 146e3, form=["PROPERTY_FILE_FORMAT = 'PAC_MC'"], IP=250000, IP_NOM=250000,
    ),
    "MF-MCTyre, motorcycle rear": kind(
        (180, 55, 17), 290e3, 1800.0, 182e3, form=["FITTYP = 61", "PROPERTY_FILE_FORMAT = 'MF_MC'"], NOMPRES=290000,
    ),
    "PAC89, off-road": kind(
        (265, 70, 16), 220e3, 6500.0, 244e3, form=["PROPERTY_FILE_FORMAT = 'PAC89'"], IP=220000, FNOMIN=6500.0,
    ),
    "PAC94, van": kind(
        (215, 75, 16), 375e3, 8000.0, 345e3, form=["PROPERTY_FILE_FORMAT = 'PAC94'"], IP=375000,
    ),
    "FIALA, pounds and inches": kind(
        (195, 60, 14), 207e3, 3600.0, 192e3, form=["PROPERTY_FILE_FORMAT = 'FIALA'"], units=INCHES, TIRE_PRESSURE=30.0,
        deflection=3600.0 / 192e3,
    ),
    "UATIRE, car": kind(
        (175, 70, 13), 200e3, 3000.0, 168e3, form=["PROPERTY_FILE_FORMAT = 'UATIRE'"], INFLATION_PRESSURE=200000,
    ),
    "5.2.1, car without inflation": kind(
        (185, 70, 14), 220e3, 3500.0, 183e3, form=["PROPERTY_FILE_FORMAT = '5.2.1'"],
    ),
    "racing, inflation in a comment": kind(
        (190, 40, 10), 115e3, 1100.0, 104e3, form=["FITTYP = 61"], comment="! COMMENT : Infl. Pressure (PSI) : 16.7",
    ),
    "truck at 8 bar": kind(
        (315, 80, 22.5), 800e3, 35000.0, 1.05e6, form=["PROPERTY_FILE_FORMAT = 'PAC2002'"], IP=800000, IP_NOM=800000,
    ),
    "truck at 6.5 bar, inflation in bar": kind(
        (335, 65, 22.5), 650e3, 30000.0, 0.85e6, form=["PROPERTY_FILE_FORMAT = 'MF-TYRE'"], INFLATION_PRESSURE=6.5,
    ),
    "bus without inflation": kind(
        (315, 80, 22.5), 220e3, 35000.0, 1.0e6, form=["PROPERTY_FILE_FORMAT = 'PAC2002'"],
    ),
    "racing at 0.83 bar": kind(
        (190, 50, 10), 83e3, 700.0, 90e3, form=["FITTYP = 61"], INFLPRES=83000, NOMPRES=83000,
    ),
    "PAC2002, soft off-road": kind(
        (260, 80, 14), 220e3, 3600.0, 79e3, form=["PROPERTY_FILE_FORMAT = 'PAC2002'"],
    ),
    "MF-Tyre 5.0, heavy, 2.7 bar, table of loads": kind(
        (335, 65, 22.5), 270e3, 16500.0, 360e3, form=["PROPERTY_FILE_FORMAT = 'MF_05'"], INFLATION_PRESSURE=2.7, after=HEAVY,
        deflection=0.04 + 0.01 * 2500.0 / 3600.0, VERTICAL_STIFFNESS=350e3,
    ),
}  # fmt: skip
