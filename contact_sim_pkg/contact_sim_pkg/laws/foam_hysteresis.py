"""Rate-independent dissipation of foam: one internal variable between -1 and 1 that follows the
loading (Bouc 1967, Wen 1976, Dahl 1968).

``F = F_el(x) (1 + s z)``, ``z' = (u' - |u'| z)/u_0``, u the energy stored in the elastic law, u' =
F_el x'. On a long loading z tends to 1 and the force to 1 + s times the elastic one, on unloading
to 1 - s; a reversal is passed over in the energy u_0. Driven by the energy in place of the
displacement, the dissipation is a part of the load, the force never pulls (s < 1), and the balance
closes: ``(F - F_el) x' = d/dt (1/2 s u_0 z^2) + s |u'| z^2``: stored beside u is ``1/2 s u_0 z^2``,
what is lost is never negative.

Loaded from z = 0 to U and back: taken up ``U + s (U - u_0 (1 - E))``, given back ``U - s (U - (1 +
z_1) u_0 (1 - E))`` with ``E = exp(-U/u_0)``, ``z_1 = 1 - E``. For U >> u_0 the share lost of what
was taken up is 2 s/(1 + s). Out of contact z stays.

Where many points have a hysteresis, ``place`` is the number of the point: their variables lie
from ``offset`` on.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.laws.parameters import FoamHysteresis

REST = 1e-9  # [m/s]


@kernel
def hysteresis_factor(hysteresis: FoamHysteresis | None, state: Vector, place: int = 0) -> float:
    """Ratio [1] of the force without rate to the elastic one, ``1 + s z``; 1 without hysteresis.

    state: [states] of the rig; place: number of the point.
    """
    if hysteresis is None:
        return 1.0
    return 1.0 + hysteresis.share * state[hysteresis.offset + place]


@kernel
def hysteresis_rate(
    hysteresis: FoamHysteresis | None, elastic_power: float, state: Vector, out: Vector, place: int = 0
) -> None:
    """Write z' for ``elastic_power`` u' [W] into ``out`` [states]; state: [states] of the rig;
    place: number of the point."""
    if hysteresis is not None:
        z = state[hysteresis.offset + place]
        out[hysteresis.offset + place] = (elastic_power - abs(elastic_power) * z) / hysteresis.energy


@kernel
def hysteresis_factor_rate(hysteresis: FoamHysteresis | None, derivative: Vector, place: int = 0) -> float:
    """Rate [1/s] of ``hysteresis_factor``, from the derivative [states] of the state; 0 without
    hysteresis."""
    if hysteresis is None:
        return 0.0
    return hysteresis.share * derivative[hysteresis.offset + place]


@kernel
def hysteresis_energy(hysteresis: FoamHysteresis | None, state: Vector, place: int = 0) -> float:
    """Energy [J] stored beside the elastic law, in the state [states] of the rig; 0 without
    hysteresis."""
    if hysteresis is None:
        return 0.0
    return 0.5 * hysteresis.share * hysteresis.energy * state[hysteresis.offset + place] ** 2


@kernel
def reversal_event(hysteresis: FoamHysteresis | None, approach: float, approach_rate: float) -> float:
    """Event function of the reversals, where z' has a corner; constant without hysteresis and out
    of contact. It changes its sign at a rate of -1e-9 m/s, where the corner is as good as at 0: a
    body at rest, whose rate is rounding, does not reverse.

    approach: [m]; approach_rate: [m/s], closing positive.
    """
    if hysteresis is None:
        return 1.0
    return approach_rate + REST if approach > 0.0 else 1.0
