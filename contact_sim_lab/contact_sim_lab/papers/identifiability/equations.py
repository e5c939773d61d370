"""Equations of *Identifiability*, each with the shipped function that evaluates it."""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records.paper import Equation, PaperError, Parameter
from contact_sim_lab.twins.rigid_impact import energetic_by_path, newton_by_enumeration, poisson_by_enumeration
from contact_sim_pkg.identify.motion.geometry import box
from contact_sim_pkg.identify.table import ImpactTable, estimate_from_impacts, problem_of_impacts
from contact_sim_pkg.rigid.bodies import body as rigid_body
from contact_sim_pkg.rigid.contact.lemke import complementarity_residual, lemke, make_lemke_workspace
from contact_sim_pkg.rigid.contact.planar_impact import contact_modes, planar_impact
from contact_sim_pkg.rigid.parameters import RULE_NAMES, PlanarContact
from contact_sim_pkg.rigid.rotation import gyroscopic_rate, gyroscopic_step

__all__ = ["EQUATIONS"]

Array = NDArray[numpy.float64]

SIDE, MASS = Parameter("side", "m", 0.1, above=0.0), Parameter("mass", "kg", 1.0, above=0.0)
ANGLE = Parameter("angle", "rad", 0.2, least=0.0, most=1.5707963267948966, help="θ")
FRICTION = Parameter("friction", "", 0.3, least=0.0, help="μ")
RESTITUTION = Parameter("restitution", "", 0.3, least=0.0, most=1.0, help="ε")
VELOCITY = (Parameter("v_x", "m/s", 0.5), Parameter("v_y", "m/s", -2.0), Parameter("spin", "rad/s", 0.0))
CONTACT = (
    Parameter("a_nn", "1/kg", 2.0, above=0.0), Parameter("a_nt", "1/kg", -0.4), Parameter("a_tt", "1/kg", 3.5, above=0.0), FRICTION,
    RESTITUTION, Parameter("u_n", "m/s", -2.0), Parameter("u_t", "m/s", 0.5),
)  # fmt: skip
IMPULSE = (("c_n", "N s"), ("c_t", "N s"), ("mode", ""))
INERTIA = (
    Parameter("inertia", "kg m²", (1.0e-3, 2.0e-3, 2.5e-3), above=0.0),
    Parameter("body_spin", "rad/s", (5.0, 1.0, 3.0)),
)


def _lowest(side: float, mass: float, angle: float, height: float) -> tuple[float, Array]:
    """Gap [m] and rows J_n, J_t [2, 3] of the lowest corner of the block, its centre at a height [m]."""
    block = rigid_body.regular_block(side, mass, 0.0, 0.0)
    ground = rigid_body.fitted_ground(block, rigid_body.slope(2))
    gap, rows = numpy.zeros(4), numpy.zeros((8, 3))
    motion = rigid_body.placed(block, numpy.array([0.0, height]), numpy.zeros(3), angle)
    rigid_body.contact_kinematics(block, ground, motion, gap, rows)
    low = int(numpy.argmin(gap))
    return float(gap[low]), rows[2 * low : 2 * low + 2]


def _jacobians(side: float, angle: float, height: float) -> tuple[float, Array, Array]:
    gap, rows = _lowest(side, 1.0, angle, height)
    return gap, rows[0], rows[1]


def _block(
    side: float,
    mass: float,
    angle: float,
    friction: float,
    restitution: float,
    rule: str,
    v_x: float,
    v_y: float,
    spin: float,
) -> tuple[float, float, int, Array]:
    _, rows = _lowest(side, mass, angle, 0.0)
    inverse, velocity = numpy.diag([1.0, 1.0, 6.0 / side**2]) / mass, numpy.array([v_x, v_y, spin])
    delassus, slip = rows @ inverse @ rows.T, rows @ velocity
    contact = PlanarContact(float(delassus[0, 0]), float(delassus[0, 1]), float(delassus[1, 1]), friction, restitution)
    found = planar_impact(contact, RULE_NAMES[rule], float(slip[0]), float(slip[1]))
    return found.normal, found.tangential, found.mode, velocity + inverse @ rows.T @ numpy.array(found[:2])


def _contact(a_nn: float, a_nt: float, a_tt: float, friction: float, restitution: float) -> PlanarContact:
    if not a_nt**2 < a_nn * a_tt:
        raise PaperError(
            f"a_nt {a_nt:g} 1/kg: below {math.sqrt(a_nn * a_tt):.6g} = √(a_nn a_tt) in magnitude is needed"
        )
    return PlanarContact(a_nn, a_nt, a_tt, friction, restitution)


def _one_step(
    a_nn: float, a_nt: float, a_tt: float, friction: float, restitution: float, u_n: float, u_t: float
) -> tuple[float, float, int]:
    contact = _contact(a_nn, a_nt, a_tt, friction, restitution)
    return contact_modes(contact, u_n + restitution * min(0.0, u_n), u_t, 0.0)


def _by_rule(
    a_nn: float, a_nt: float, a_tt: float, friction: float, restitution: float, u_n: float, u_t: float, rule: str
) -> tuple[float, float, int, float, float]:
    found = planar_impact(_contact(a_nn, a_nt, a_tt, friction, restitution), RULE_NAMES[rule], u_n, u_t)
    twin = {"newton": newton_by_enumeration, "poisson": poisson_by_enumeration, "energetic": energetic_by_path}[rule]
    other = twin(numpy.array([[a_nn, a_nt], [a_nt, a_tt]]), friction, restitution, numpy.array([u_n, u_t]))
    return found.normal, found.tangential, found.mode, float(other[0]), float(other[1])


def _lcp(m11: float, m12: float, m21: float, m22: float, q1: float, q2: float) -> tuple[Array, int, float]:
    work = make_lemke_workspace(2)
    work.M[:2, :2], work.q[:2] = [[m11, m12], [m21, m22]], [q1, q2]
    status = lemke(work, 2)
    return work.z[:2].copy(), int(status), float(complementarity_residual(work, 2))  # type: ignore[no-untyped-call]


def _gyroscopic(inertia: Array, body_spin: Array, step: float) -> tuple[Array, Array]:
    values = [float(each) for each in (*inertia, *body_spin, step)]
    rate, after = gyroscopic_rate(inertia, *values[3:6]), gyroscopic_step(*values)  # type: ignore[no-untyped-call]
    return numpy.array(rate), numpy.array(after)


def _two_point(side: float, angle: float, before: Array, after: Array) -> tuple[float, float, float, float]:
    turned = numpy.array(
        [[[math.cos(angle), 0.0, -math.sin(angle)], [0.0, 1.0, 0.0], [math.sin(angle), 0.0, math.cos(angle)]]]
    )
    plane = [numpy.array([[each[0], 0.0, each[1]]]) for each in (before, after)]
    spins = [numpy.array([[0.0, -each[2], 0.0]]) for each in (before, after)]
    problem = problem_of_impacts(
        ImpactTable(turned, *plane, *spins), box([side] * 3), (1e-9, 1e-9), numpy.array([0.0, 1.0, 0.0])
    )
    ratio = float(estimate_from_impacts(problem).parameters[0])
    return 1.0 / ratio, ratio, float(after[0] - before[0]), float(after[1] - before[1])


LCP = tuple(
    Parameter(name, "", value)
    for name, value in (("m11", 2.0), ("m12", 1.0), ("m21", 1.0), ("m22", 2.0), ("q1", -5.0), ("q2", -6.0))
)
RULE = Parameter("rule", "", "newton", choices=("newton", "poisson", "energetic"))
BLOCK = (SIDE, MASS, ANGLE, FRICTION, RESTITUTION, RULE, *VELOCITY)
EQUATIONS: tuple[Equation, ...] = (
    Equation("2", "linear complementarity problem of two unknowns, by Lemke's pivots", "w = M z + q ≥ 0, z ≥ 0, wᵀz = 0",
             "contact_sim_pkg.rigid.contact.lemke:lemke",
             LCP,
             (("z", ""), ("status", ""), ("residual", "")), _lcp),
    Equation("9", "one planar contact by the rule of restitution, and by a twin", "0 ≤ c_n ⊥ J_nᵀv⁺ + ε min(0, J_nᵀv) ≥ 0",
             "contact_sim_pkg.rigid.contact.planar_impact:planar_impact", (*CONTACT, RULE), (*IMPULSE, ("c_n twin", "N s"),
             ("c_t twin", "N s")),
             _by_rule),
    Equation("17", "sliding and sticking of one contact in closed form (eqs 12-18, 32-34)",
             "c_n = −[(1+ε) J_nᵀv + …]/(A_nn + μ A_nd)",
             "contact_sim_pkg.rigid.contact.planar_impact:contact_modes", CONTACT, IMPULSE, _one_step),
    Equation("23", "gyroscopic change of the spin", "I0 dω/dt = −ω × I0 ω", "contact_sim_pkg.rigid.rotation:gyroscopic_rate",
             (*INERTIA, Parameter("step", "s", 1e-3, above=0.0, most=1.0)), (("rate", "rad/s²"), ("spin after the step",
             "rad/s")), _gyroscopic),
    Equation("40", "gap and Jacobians of the block's lowest corner (eqs 40-42)", "φ = y − r cos(π/4 − θ)",
             "contact_sim_pkg.rigid.bodies.body:contact_kinematics", (SIDE, ANGLE, Parameter("height", "m", 0.2)),
             (("φ", "m"), ("J_n", ""), ("J_t", "")), _jacobians),
    Equation("43", "impact of the block on its corner", "c_n, c_t and v⁺",
             "contact_sim_pkg.rigid.contact.planar_impact:planar_impact", BLOCK,
             (*IMPULSE, ("v⁺", "m/s, rad/s")), _block),
    Equation("44", "ratios found from one planar impact (eqs 44, 45)", "m/J = Δω/(r × π), c/m = Δv",
             "contact_sim_pkg.identify.table:estimate_from_impacts",
             (SIDE, ANGLE, Parameter("before", "m/s, rad/s", (0.5, -2.0, 0.0)),
              Parameter("after", "m/s, rad/s", (1.019516835753669, -0.2682772141544365, -22.2237080418872))),
             (("m/J", "1/m²"), ("J/m", "m²"), ("c_t/m", "m/s"), ("c_n/m", "m/s")), _two_point),
)  # fmt: skip
