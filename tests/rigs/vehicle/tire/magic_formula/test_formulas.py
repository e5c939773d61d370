"""The Magic Formula beside a second writing of the book's equations with 30 digits, and beside a public package."""

import math
import random

import mpmath
import pytest
from tests.rigs.vehicle.tire.magic_formula.whole_set import COEFFICIENTS, SCALES, SET, tir_text

from contact_sim_pkg.rigs.vehicle.tire.magic_formula.coefficients import magic_formula
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.formulas import at_load, forces_at
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.relaxation import relaxation_lengths
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file


def formula_of(folder, **changed):
    (folder / "tire.tir").write_text(tir_text(**changed))
    return magic_formula(read_property_file(folder / "tire.tir"))


class Book:
    """Pacejka, Tire and Vehicle Dynamics (2012), 4.E1 to 4.E78, without camber and turn slip, forward rolling."""

    def __init__(self, keys):
        self.k = {name: mpmath.mpf(repr(value)) for name, value in keys.items()}

    def forces(self, kappa, alpha, load, pressure, speed):
        k, f = self.k, mpmath
        kappa, alpha, load, pressure, speed = (f.mpf(repr(each)) for each in (kappa, alpha, load, pressure, speed))
        force_0, radius = k["FNOMIN"] * k["LFZO"], k["UNLOADED_RADIUS"]
        df, dp = load / force_0 - 1, pressure / k["NOMPRES"] - 1
        star = f.tan(alpha)

        def quadratic(name, of=df):
            return sum(k.get(f"{name}{n + 1}", 0) * of**n for n in range(3))

        def shape(b, c, e, x):
            y = b * x
            return c * f.atan((1 - e) * y + e * f.atan(y))

        slow = {axis: 10 * k[f"LMU{axis}"] / (1 + 9 * k[f"LMU{axis}"]) for axis in "XY"}
        # F_x0
        stiff_x = (
            load
            * (k["PKX1"] + k["PKX2"] * df)
            * f.exp(k["PKX3"] * df)
            * (1 + k["PPX1"] * dp + k["PPX2"] * dp**2)
            * k["LKX"]
        )
        peak_x = load * (k["PDX1"] + k["PDX2"] * df) * (1 + k["PPX3"] * dp + k["PPX4"] * dp**2) * k["LMUX"]
        c_x, x = k["PCX1"] * k["LCX"], kappa + (k["PHX1"] + k["PHX2"] * df) * k["LHX"]
        e_x = (k["PEX1"] + k["PEX2"] * df + k["PEX3"] * df**2) * (1 - k["PEX4"] * f.sign(x)) * k["LEX"]
        pure_x = peak_x * f.sin(shape(stiff_x / (c_x * peak_x), c_x, min(e_x, 1), x))
        pure_x += load * (k["PVX1"] + k["PVX2"] * df) * k["LVX"] * slow["X"] * speed / (f.mpf("0.1") + speed)
        # F_y0
        stiff_y = k["PKY1"] * force_0 * (1 + k["PPY1"] * dp) * k["LKY"]
        stiff_y *= f.sin(k["PKY4"] * f.atan(load / (force_0 * k["PKY2"] * (1 + k["PPY2"] * dp))))
        peak_y = load * (k["PDY1"] + k["PDY2"] * df) * (1 + k["PPY3"] * dp + k["PPY4"] * dp**2) * k["LMUY"]
        shift_h, shift_v = (
            (k["PHY1"] + k["PHY2"] * df) * k["LHY"],
            load * (k["PVY1"] + k["PVY2"] * df) * k["LVY"] * slow["Y"],
        )
        c_y, y = k["PCY1"] * k["LCY"], star + shift_h
        b_y = stiff_y / (c_y * peak_y)
        e_y = (k["PEY1"] + k["PEY2"] * df) * (1 - k["PEY3"] * f.sign(y)) * k["LEY"]
        pure_y = peak_y * f.sin(shape(b_y, c_y, min(e_y, 1), y)) + shift_v
        # weights
        b, e = k["RBX1"] / f.sqrt(1 + (k["RBX2"] * kappa) ** 2) * k["LXAL"], min(k["REX1"] + k["REX2"] * df, 1)
        force_x = pure_x * f.cos(shape(b, k["RCX1"], e, star + k["RHX1"])) / f.cos(shape(b, k["RCX1"], e, k["RHX1"]))
        b = k["RBY1"] / f.sqrt(1 + (k["RBY2"] * (star - k["RBY3"])) ** 2) * k["LYKA"]
        e, shift = min(k["REY1"] + k["REY2"] * df, 1), k["RHY1"] + k["RHY2"] * df
        weighted = pure_y * f.cos(shape(b, k["RCY1"], e, kappa + shift)) / f.cos(shape(b, k["RCY1"], e, shift))
        ply = peak_y * (k["RVY1"] + k["RVY2"] * df) / f.sqrt(1 + (k["RVY4"] * star) ** 2) * k["LVYKA"]
        force_y = weighted + ply * f.sin(k["RVY5"] * f.atan(k["RVY6"] * kappa))
        # moments
        steer = k["LKY"] / k["LMUY"]
        at = star + k["QHZ1"] + k["QHZ2"] * df
        b_t = quadratic("QBZ") * steer
        e_t = min(quadratic("QEZ") * (1 + k["QEZ4"] * 2 / f.pi * f.atan(b_t * k["QCZ1"] * at)), 1)
        d_t = load * radius / force_0 * (k["QDZ1"] + k["QDZ2"] * df) * (1 - k["PPZ1"] * dp) * k["LTR"]
        ar = star + shift_h + shift_v / stiff_y
        d_r = load * radius * (k["QDZ6"] + k["QDZ7"] * df) * k["LRES"] * k["LMUY"] * f.cos(alpha)

        def equivalent(own):
            return f.sign(own) * f.hypot(own, stiff_x / stiff_y * kappa)

        trail = d_t * f.cos(shape(b_t, k["QCZ1"], e_t, equivalent(at))) * f.cos(alpha)
        b_r = k["QBZ9"] * steer + k["QBZ10"] * b_y * c_y
        lever = radius * (k["SSZ1"] + k["SSZ2"] * force_y / force_0) * k["LS"]
        moment_z = -trail * weighted + d_r / f.sqrt(1 + (b_r * equivalent(ar)) ** 2) + lever * force_x
        turn = f.cos(k["QSX5"] * f.atan((k["QSX6"] * load / force_0) ** 2)) * f.sin(
            k["QSX8"] * f.atan(k["QSX9"] * force_y / force_0)
        )
        moment_x = load * radius * k["LMX"] * (k["QSX1"] * k["LVMX"] + k["QSX3"] * force_y / force_0 + k["QSX4"] * turn)
        moment_x += radius * force_y * k["LMX"] * k["QSX13"]
        own, rolls = k["FNOMIN"], speed / k["LONGVL"]
        moment_y = k["QSY1"] + k["QSY2"] * force_x / own + k["QSY3"] * rolls + k["QSY4"] * rolls**4
        moment_y *= -radius * own * k["LMY"] * (load / own) ** k["QSY7"] * (pressure / k["NOMPRES"]) ** k["QSY8"]
        return [float(each) for each in (force_x, force_y, moment_x, moment_y, moment_z)]


def test_a_whole_set_at_200_points_is_as_the_book_says_to_1e_10(tmp_path):
    keys, drawn = formula_of(tmp_path).keys, random.Random(28)
    with mpmath.workdps(30):
        book = Book(SET)
        for _ in range(200):
            kappa, alpha = drawn.uniform(-1.0, 0.4), drawn.uniform(-0.3, 0.3)
            load, pressure, speed = drawn.uniform(900.0, 8000.0), drawn.uniform(1.6e5, 3e5), drawn.uniform(1.0, 50.0)
            found = forces_at(at_load(keys, load, pressure, speed), kappa, alpha)
            scale = load, load, SET["UNLOADED_RADIUS"] * load, 0.01 * load, 0.05 * load
            for own, expected, size in zip(found, book.forces(kappa, alpha, load, pressure, speed), scale, strict=True):
                assert own == pytest.approx(expected, abs=1e-10 * size)


COMMONROAD = [  # kappa, alpha, F_x, F_y of commonroad-vehicle-models 3.0.2, its functions of combined slip, at FNOMIN
    (-0.3096, 0.0177, -4003.7972447380357, -335.5605552401022), (-0.204, 0.0416, -4135.462634715512, -1198.947154288955),
    (0.0006, -0.1738, 41.80150887935232, 3880.0114870388957), (-0.4895, 0.135, -3397.901905377163, -1093.0819019591536),
    (-0.2925, -0.1063, -3648.0600216572684, 1521.9039071714687), (0.2965, -0.0119, 4048.1014779442603, 196.89040311423685),
    (0.1692, -0.0095, 4395.096939494024, 257.41811133373517), (0.0113, -0.1398, 386.51424624816593, 3878.898878474161),
    (0.0079, 0.1472, 243.56059695312538, -3909.7967582299148), (-0.0815, 0.0965, -2532.1914998607663, -3250.4502094247173),
    (0.0371, -0.1744, 813.7665784894671, 3677.309538683686), (0.1066, 0.0364, 4060.5465282914506, -1692.6356578025523),
]  # fmt: skip


def test_where_the_terms_coincide_it_is_the_public_package(tmp_path):
    """It has no load terms, no scaling, no shifts across without camber, and K_y of PKY1 alone."""
    absent = dict.fromkeys(("PEX4", "PEY3", "PHY1", "PHY2", "PVX1", "PVX2", "PVY1", "PVY2"), 0.0)
    keys = formula_of(tmp_path, **dict.fromkeys(SCALES, 1.0), **absent, PKY4=2.0, PKY2=1.0).keys
    at = at_load(keys, SET["FNOMIN"], SET["NOMPRES"], 20.0)
    for kappa, alpha, along, across in COMMONROAD:
        found = forces_at(at, kappa, alpha)
        assert (found.longitudinal, found.lateral) == pytest.approx((along, across), abs=1e-9 * SET["FNOMIN"])


def test_small_slips_have_the_stiffnesses_and_trail_of_the_coefficients(tmp_path):
    none = dict.fromkeys(
        ("PHX1", "PHX2", "PVX1", "PVX2", "PHY1", "PHY2", "PVY1", "PVY2", "QHZ1", "QHZ2", "QDZ6", "QDZ7", "SSZ1"), 0.0
    )
    formula = formula_of(tmp_path, **dict.fromkeys(SCALES, 1.0), **none)
    at = at_load(formula.keys, SET["FNOMIN"], SET["NOMPRES"], 16.0)
    assert forces_at(at, 1e-6, 0.0).longitudinal / 1e-6 == pytest.approx(SET["PKX1"] * SET["FNOMIN"], rel=1e-4)
    steered = forces_at(at, 0.0, 1e-6)
    stiffness = SET["PKY1"] * SET["FNOMIN"] * math.sin(SET["PKY4"] * math.atan(1.0 / SET["PKY2"]))
    assert steered.lateral / 1e-6 == pytest.approx(stiffness, rel=1e-4)
    assert -steered.aligning / steered.lateral == pytest.approx(SET["UNLOADED_RADIUS"] * SET["QDZ1"], rel=1e-4)
    along, across = relaxation_lengths(formula, at, SET["NOMPRES"])
    assert along == pytest.approx(SET["PKX1"] * SET["FNOMIN"] / SET["LONGITUDINAL_STIFFNESS"])
    assert across == pytest.approx(-stiffness / SET["LATERAL_STIFFNESS"])


def test_every_coefficient_of_the_set_counts(tmp_path):
    """A coefficient that is changed changes a force: none is read and forgotten."""
    usual, conditions = formula_of(tmp_path), (3300.0, 2.5e5, 31.0)
    before = forces_at(at_load(usual.keys, *conditions), -0.07, 0.05)
    for key in (*COEFFICIENTS, *SCALES):
        if key in ("LKYC", "LKZC", "SSZ4"):  # of camber
            continue
        changed = {**usual.keys, key: 1.1 * usual.keys[key]}
        assert forces_at(at_load(changed, *conditions), -0.07, 0.05) != before, key
    assert {*COEFFICIENTS, *SCALES} <= {*usual.used}


def test_keys_that_nothing_uses_are_named(tmp_path):
    formula = formula_of(tmp_path, QDRP1=1.0, LMUV=0.0, ELLIPS_ORDER=1.8)
    assert {"QDRP1", "ELLIPS_ORDER", "RIM_WIDTH"} <= {*formula.ignored}
    assert "LMUV" not in formula.ignored
    assert "LMUV" in formula_of(tmp_path, LMUV=0.1).ignored


def test_a_file_without_a_needed_coefficient_is_refused_by_its_name(tmp_path):
    with pytest.raises(PropertyFileError, match="needs PCX1, PKY1, which the file does not give"):
        formula_of(tmp_path, PCX1=None, PKY1=None)


def test_5_2_takes_the_slip_angle_itself_its_own_words_and_relaxation(tmp_path):
    own = {
        "FITTYP": 6,
        "PROPERTY_FILE_FORMAT": "'PAC2002'",
        "INFLPRES": None,
        "NOMPRES": None,
        "IP": 2.4e5,
        "IP_NOM": 2.2e5,
    }
    formula = formula_of(tmp_path, **own, PTX1=1.9, PTX2=0.1, PTX3=-0.2, PTY1=1.7, PTY2=2.1, PKY4=None)
    assert (formula.version, formula.inflation, formula.keys["NOMPRES"]) == ("5.2 and PAC2002", 2.4e5, 2.2e5)
    assert formula.keys["PKY4"] == 2.0
    at = at_load(formula.keys, 4000.0, 2.2e5, 20.0)
    later = at_load({**formula.keys, "BY_TANGENT": 1.0}, 4000.0, 2.2e5, 20.0)
    assert forces_at(at, 0.0, math.tan(0.1)).lateral == pytest.approx(forces_at(later, 0.0, 0.1).lateral, rel=1e-12)
    nominal, radius = SET["FNOMIN"] * SET["LFZO"], SET["UNLOADED_RADIUS"]
    df = 4000.0 / nominal - 1.0
    along, across = relaxation_lengths(formula, at, 2.2e5)
    assert along == pytest.approx(4000.0 * (1.9 + 0.1 * df) * math.exp(-0.2 * df) * radius / nominal)
    assert across == pytest.approx(1.7 * math.sin(2.0 * math.atan(4000.0 / (2.1 * nominal))) * radius)


def test_a_file_of_the_other_axes_is_turned_over(tmp_path):
    """Adapted SAE: side force and aligning moment have the other sign at the same slip angle."""
    none = dict.fromkeys(
        ("RVY1", "RVY2", "PHY1", "PHY2", "PVY1", "PVY2", "QDZ6", "QDZ7", "SSZ1", "SSZ2", "QSX13", "QBZ10"), 0.0
    )
    own, other = (
        forces_at(at_load(formula_of(tmp_path, **none, PKY1=each).keys, 4000.0, 2e5, 20.0), 0.0, 0.06)
        for each in (SET["PKY1"], -SET["PKY1"])
    )
    assert own.lateral < 0.0 < own.aligning
    assert other.lateral == pytest.approx(own.lateral, rel=1e-9)
    assert other.aligning == pytest.approx(own.aligning, rel=1e-9)
