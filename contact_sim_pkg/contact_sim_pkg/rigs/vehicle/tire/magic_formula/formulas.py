"""The Magic Formula 6.1 and 6.2 with inflation pressure; 5.2 and PAC2002 as what they leave out.

Numbers of equations: Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012), 4.3.2; inflation: Besselink, Schmeitz,
Pacejka, Vehicle System Dynamics 48 (2010). Two stages: `at_load` takes the coefficients to a load, an inflation, a
camber and a speed, `forces_at` is the rest in slip and slip angle, scalars alone, which numba compiles. Without turn
slip: every zeta is 1. Steady; relaxation in `relaxation.py`.

Axes: ISO-W as the bench, forces on the tire; at a positive slip angle, tan alpha = V_y / |V_x|, the side force is
negative and PKY1 too. A file of the adapted SAE axes (PKY1 > 0) is turned over.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

__all__ = ["AtLoad", "Forces", "at_load", "forces_at", "magic", "magic_cosine"]

TINY = 1e-6  # of a denominator, against 0
LEAST_SPEED = 0.1  # [m/s] eps_Vx of 4.E18
DIGRESSIVE = 10.0  # A_mu of 4.E8

Keys = Mapping[str, float]
"""Coefficients by the names of a property file, in SI; every name of `keys.COEFFICIENTS` is there."""


class Forces(NamedTuple):
    """On the tire, about the point of contact."""

    longitudinal: float  # F_x [N]
    lateral: float  # F_y [N]
    overturning: float  # M_x [N m]
    rolling: float  # M_y [N m], negative where it rolls forward
    aligning: float  # M_z [N m]


class AtLoad(NamedTuple):
    """What follows from load, inflation, camber and speed; symbols as in the book."""

    load: float  # F_z [N]
    nominal: float  # F'_z0 [N]
    radius: float  # R_0 [m]
    side: float  # -1.0: a file of the adapted SAE axes
    by_tangent: float  # 1.0: alpha* = tan alpha; 0.0: alpha
    b_x: float
    c_x: float
    d_x: float
    e_x: float
    e_x_sign: float  # p_Ex4
    sh_x: float
    sv_x: float
    k_x: float  # slip stiffness [N]
    b_y: float
    c_y: float
    d_y: float
    e_y: float
    e_y_sign: float
    sh_y: float
    sv_y: float
    k_y: float  # cornering stiffness [N/rad]
    b_xa: float
    b_xa_slip: float  # r_Bx2
    c_xa: float
    e_xa: float
    sh_xa: float
    b_yk: float
    b_yk_angle: float  # r_By2
    b_yk_shift: float  # r_By3
    c_yk: float
    e_yk: float
    sh_yk: float
    d_vyk: float  # without its fall over the angle
    v_angle: float  # r_Vy4
    v_shape: float  # r_Vy5
    v_slip: float  # r_Vy6
    b_t: float
    c_t: float
    d_t: float  # [m]
    e_t: float
    e_t_sign: float
    sh_t: float
    b_r: float
    d_r: float  # [N m]
    sh_f: float
    s_force: float  # lever of F_x: constant part [m]
    s_side: float  # and per side force over F'_z0 [m]
    m_x: float  # constant part of M_x [N m]
    m_x_side: float  # per side force [m]
    m_x_load: float  # q_sx4 with its load [N m]
    m_x_turn: float  # q_sx7 gamma
    m_x_shape: float  # q_sx8
    m_x_rate: float  # q_sx9
    m_y: float  # [N m] at F_x 0
    m_y_force: float  # per longitudinal force [m]


def at_load(keys: Keys, load: float, inflation: float, speed: float, camber: float = 0.0) -> AtLoad:
    """The formula of a tire under a ``load`` [N] > 0 at an ``inflation`` [Pa], a ``speed`` [m/s] of rolling >= 0 and a
    ``camber`` [rad]. Equations 4.E1 to 4.E47 and the parts of 4.E50 to 4.E76 that no slip is in.
    """
    nominal, radius, reference = keys["LFZO"] * keys["FNOMIN"], keys["UNLOADED_RADIUS"], keys["LONGVL"]
    df = (load - nominal) / nominal
    dp = (inflation - keys["NOMPRES"]) / keys["NOMPRES"]
    lean = math.sin(camber)
    tilt, lean_2, ratio = abs(lean), lean * lean, load / nominal
    mu_x, mu_y = keys["LMUX"], keys["LMUY"]
    fade_x, fade_y = (DIGRESSIVE * each / (1.0 + (DIGRESSIVE - 1.0) * each) for each in (mu_x, mu_y))
    # along: 4.E9 to 4.E18
    c_x = keys["PCX1"] * keys["LCX"]
    friction_x = (
        (keys["PDX1"] + keys["PDX2"] * df)
        * (1.0 + keys["PPX3"] * dp + keys["PPX4"] * dp**2)
        * (1.0 - keys["PDX3"] * lean_2)
        * mu_x
    )
    d_x = friction_x * load
    k_x = (
        load * (keys["PKX1"] + keys["PKX2"] * df) * math.exp(keys["PKX3"] * df)
        * (1.0 + keys["PPX1"] * dp + keys["PPX2"] * dp**2) * keys["LKX"]
    )  # fmt: skip
    rolls = abs(speed) / (LEAST_SPEED + abs(speed))
    sv_x = load * (keys["PVX1"] + keys["PVX2"] * df) * rolls * keys["LVX"] * fade_x
    # across: 4.E19 to 4.E30
    c_y = keys["PCY1"] * keys["LCY"]
    friction_y = (
        (keys["PDY1"] + keys["PDY2"] * df)
        * (1.0 + keys["PPY3"] * dp + keys["PPY4"] * dp**2)
        * (1.0 - keys["PDY3"] * lean_2)
        * mu_y
    )
    d_y = friction_y * load
    where = (keys["PKY2"] + keys["PKY5"] * lean_2) * (1.0 + keys["PPY2"] * dp)
    k_y = (
        keys["PKY1"] * nominal * (1.0 + keys["PPY1"] * dp) * (1.0 - keys["PKY3"] * tilt)
        * math.sin(keys["PKY4"] * math.atan(ratio / where)) * keys["LKY"]
    )  # fmt: skip
    b_y = k_y / _not_0(c_y * d_y)
    sv_camber = load * (keys["PVY3"] + keys["PVY4"] * df) * lean * keys["LKYC"] * fade_y
    sv_y = load * (keys["PVY1"] + keys["PVY2"] * df) * keys["LVY"] * fade_y + sv_camber
    by_camber = load * (keys["PKY6"] + keys["PKY7"] * df) * (1.0 + keys["PPY5"] * dp) * keys["LKYC"]
    sh_y = (keys["PHY1"] + keys["PHY2"] * df) * keys["LHY"] + keys["PHY3"] * lean
    sh_y += (by_camber * lean - sv_camber * keys["CAMBER_FORCE"]) / _not_0(k_y)
    # moment: 4.E31 to 4.E47
    steer = keys["LKY"] / mu_y
    b_t = (
        (keys["QBZ1"] + keys["QBZ2"] * df + keys["QBZ3"] * df**2)
        * (1.0 + keys["QBZ4"] * lean + keys["QBZ5"] * tilt + keys["QBZ6"] * lean_2) * steer
    )  # fmt: skip
    d_t = (
        ratio * radius * (keys["QDZ1"] + keys["QDZ2"] * df) * (1.0 - keys["PPZ1"] * dp)
        * (1.0 + keys["QDZ3"] * tilt + keys["QDZ4"] * lean_2) * keys["LTR"]
    )  # fmt: skip
    d_r = load * radius * mu_y * (
        (keys["QDZ6"] + keys["QDZ7"] * df) * keys["LRES"]
        + ((keys["QDZ8"] + keys["QDZ9"] * df) * (1.0 + keys["PPZ2"] * dp) + (keys["QDZ10"] + keys["QDZ11"] * df) * tilt)
        * lean * keys["LKZC"]
    )  # fmt: skip
    # overturning and rolling: 4.E69, 4.E70
    turned = load * radius * keys["LMX"]
    m_x = turned * (
        keys["QSX1"] * keys["LVMX"] - keys["QSX2"] * camber * (1.0 + keys["PPMX1"] * dp) - keys["QSX12"] * camber * abs(camber)
        + keys["QSX10"] * math.atan(keys["QSX11"] * ratio) * camber
    )  # fmt: skip
    m_x_load = turned * keys["QSX4"] * math.cos(keys["QSX5"] * math.atan((keys["QSX6"] * ratio) ** 2))
    own = load / keys["FNOMIN"]  # of rolling resistance: the nominal load without its scale
    resists = -radius * keys["FNOMIN"] * own ** keys["QSY7"] * (1.0 + dp) ** keys["QSY8"] * keys["LMY"]
    swift = abs(speed) / reference
    m_y = resists * (
        keys["QSY1"] + keys["QSY3"] * swift + keys["QSY4"] * swift**4 + (keys["QSY5"] + keys["QSY6"] * own) * camber**2
    )
    return AtLoad(
        load=load, nominal=nominal, radius=radius, side=-1.0 if keys["PKY1"] > 0.0 else 1.0, by_tangent=keys["BY_TANGENT"],
        b_x=k_x / _not_0(c_x * d_x), c_x=c_x, d_x=d_x, e_x=(keys["PEX1"] + keys["PEX2"] * df + keys["PEX3"] * df**2) * keys["LEX"],
        e_x_sign=keys["PEX4"], sh_x=(keys["PHX1"] + keys["PHX2"] * df) * keys["LHX"], sv_x=sv_x, k_x=k_x,
        b_y=b_y, c_y=c_y, d_y=d_y, e_y=(keys["PEY1"] + keys["PEY2"] * df) * keys["LEY"] * (1.0 + keys["PEY5"] * lean_2),
        e_y_sign=(keys["PEY3"] + keys["PEY4"] * lean) / _not_0(1.0 + keys["PEY5"] * lean_2), sh_y=sh_y, sv_y=sv_y, k_y=k_y,
        b_xa=(keys["RBX1"] + keys["RBX3"] * lean_2) * keys["LXAL"], b_xa_slip=keys["RBX2"], c_xa=keys["RCX1"],
        e_xa=min(keys["REX1"] + keys["REX2"] * df, 1.0), sh_xa=keys["RHX1"],
        b_yk=(keys["RBY1"] + keys["RBY4"] * lean_2) * keys["LYKA"], b_yk_angle=keys["RBY2"], b_yk_shift=keys["RBY3"],
        c_yk=keys["RCY1"], e_yk=min(keys["REY1"] + keys["REY2"] * df, 1.0), sh_yk=keys["RHY1"] + keys["RHY2"] * df,
        d_vyk=d_y * (keys["RVY1"] + keys["RVY2"] * df + keys["RVY3"] * lean) * keys["LVYKA"], v_angle=keys["RVY4"],
        v_shape=keys["RVY5"], v_slip=keys["RVY6"],
        b_t=b_t, c_t=keys["QCZ1"], d_t=d_t, e_t=keys["QEZ1"] + keys["QEZ2"] * df + keys["QEZ3"] * df**2,
        e_t_sign=keys["QEZ4"] + keys["QEZ5"] * lean,
        sh_t=keys["QHZ1"] + keys["QHZ2"] * df + (keys["QHZ3"] + keys["QHZ4"] * df) * lean,
        b_r=keys["QBZ9"] * steer + keys["QBZ10"] * b_y * c_y, d_r=d_r, sh_f=sh_y + sv_y / _not_0(k_y),
        s_force=radius * (keys["SSZ1"] + (keys["SSZ3"] + keys["SSZ4"] * df) * lean) * keys["LS"],
        s_side=radius * keys["SSZ2"] * keys["LS"],
        m_x=m_x, m_x_side=turned * keys["QSX3"] / nominal + radius * keys["LMX"] * (keys["QSX13"] + keys["QSX14"] * abs(camber)),
        m_x_load=m_x_load, m_x_turn=keys["QSX7"] * camber, m_x_shape=keys["QSX8"], m_x_rate=keys["QSX9"],
        m_y=m_y, m_y_force=resists * keys["QSY2"] / keys["FNOMIN"],
    )  # fmt: skip


def forces_at(at: AtLoad, slip: float, angle: float) -> Forces:
    """Forces at a ``slip`` kappa (-1: locked) and a slip ``angle`` [rad], 4.E9 to 4.E78."""
    steered = math.tan(angle) if at.by_tangent > 0.5 else angle
    # pure slip: 4.E9, 4.E14, 4.E19, 4.E24
    slip_x, angle_y = slip + at.sh_x, steered + at.sh_y
    e_x = min(at.e_x * (1.0 - at.e_x_sign * _sign(slip_x)), 1.0)
    e_y = min(at.e_y * (1.0 - at.e_y_sign * _sign(angle_y)), 1.0)
    pure_x = magic(at.b_x, at.c_x, at.d_x, e_x, slip_x) + at.sv_x
    pure_y = magic(at.b_y, at.c_y, at.d_y, e_y, angle_y) + at.sv_y
    # combined: 4.E50 to 4.E67
    b_xa = at.b_xa * math.cos(math.atan(at.b_xa_slip * slip))
    force_x = (
        pure_x
        * magic_cosine(b_xa, at.c_xa, at.e_xa, steered + at.sh_xa)
        / magic_cosine(b_xa, at.c_xa, at.e_xa, at.sh_xa)
    )
    b_yk = at.b_yk * math.cos(math.atan(at.b_yk_angle * (steered - at.b_yk_shift)))
    weighted = (
        pure_y * magic_cosine(b_yk, at.c_yk, at.e_yk, slip + at.sh_yk) / magic_cosine(b_yk, at.c_yk, at.e_yk, at.sh_yk)
    )
    by_slip = at.d_vyk * math.cos(math.atan(at.v_angle * steered)) * math.sin(at.v_shape * math.atan(at.v_slip * slip))
    force_y = weighted + by_slip
    # moment: 4.E71 to 4.E78
    angle_t, angle_r = steered + at.sh_t, steered + at.sh_f
    e_t = min(at.e_t * (1.0 + at.e_t_sign * (2.0 / math.pi) * math.atan(at.b_t * at.c_t * angle_t)), 1.0)
    beside = (at.k_x / _not_0(at.k_y) * slip) ** 2
    angle_t = math.sqrt(angle_t**2 + beside) * _sign(angle_t)
    angle_r = math.sqrt(angle_r**2 + beside) * _sign(angle_r)
    trail = at.d_t * magic_cosine(at.b_t, at.c_t, e_t, angle_t) * math.cos(angle)
    residual = at.d_r * math.cos(math.atan(at.b_r * angle_r)) * math.cos(angle)
    aligning = -trail * weighted + residual + (at.s_force + at.s_side * force_y / at.nominal) * force_x
    overturning = (
        at.m_x
        + at.m_x_side * force_y
        + at.m_x_load * math.sin(at.m_x_turn + at.m_x_shape * math.atan(at.m_x_rate * force_y / at.nominal))
    )
    rolling = at.m_y + at.m_y_force * force_x
    return Forces(force_x, at.side * force_y, overturning, rolling, at.side * aligning)


def magic(b: float, c: float, d: float, e: float, x: float) -> float:
    """``D sin(C atan(Bx - E (Bx - atan Bx)))``, 4.E9."""
    bx = b * x
    return d * math.sin(c * math.atan(bx - e * (bx - math.atan(bx))))


def magic_cosine(b: float, c: float, e: float, x: float) -> float:
    """The same with cosine and D 1, 4.E51."""
    bx = b * x
    return math.cos(c * math.atan(bx - e * (bx - math.atan(bx))))


def _sign(value: float) -> float:
    return -1.0 if value < 0.0 else 1.0


def _not_0(value: float) -> float:
    """A denominator, `TINY` away from 0."""
    return value if abs(value) >= TINY else math.copysign(TINY, value)
