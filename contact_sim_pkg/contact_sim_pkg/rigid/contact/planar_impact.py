"""One impact of one planar contact, in closed form, by the rules of Newton, Poisson and Stronge
(energetic).

Velocities of the contact point: u_n along the normal (negative: approaching), u_t along the
tangent; impulses c_n, c_t; ``u+ = u + A c``. Source: Identifiability eqs 12-18 and 32-38,
corrected; Stronge 1990.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigid.parameters import NEWTON, POISSON, PlanarContact, PlanarImpulse
from contact_sim_pkg.rigid.results import REVERSE, SEPARATE, SLIDE, STICK

__all__ = ["contact_modes", "energetic_impulse", "impact_impulse", "planar_impact"]

STICKING = 0.0  # in place of the sign of the friction impulse


@kernel
def _sign(value):
    return 1.0 if value > 0.0 else (-1.0 if value < 0.0 else 0.0)


@kernel
def _slide_impulse(contact, q_n, q_t, sign, floor):
    """Impulse that slides with friction ``sign mu c_n``, and by how much it breaks its conditions
    (0: valid).
    """
    denominator = contact.normal + sign * contact.friction * contact.coupling
    if denominator <= 0.0:  # Painleve: no sliding this way
        return 0.0, 0.0, math.inf
    c_n = -q_n / denominator
    c_t = sign * contact.friction * c_n
    slip = sign * (q_t + contact.coupling * c_n + contact.tangential * c_t)
    return c_n, c_t, max(0.0, slip, contact.normal * (floor - c_n))


@kernel
def _slide_modes(contact, q_n, q_t, floor):
    """The valid one of the two ways to slide; where rounding leaves none, the one that breaks its
    conditions least.
    """
    first = -1.0 if q_t > 0.0 else 1.0
    c_n, c_t, broken = _slide_impulse(contact, q_n, q_t, first, floor)
    if broken == 0.0:
        return c_n, c_t, broken, SLIDE
    other_n, other_t, other_broken = _slide_impulse(contact, q_n, q_t, -first, floor)
    if other_broken < broken:
        return other_n, other_t, other_broken, REVERSE
    return c_n, c_t, broken, SLIDE


@kernel
def contact_modes(contact: PlanarContact, q_n: float, q_t: float, floor: float) -> PlanarImpulse:
    """Solve ``0 <= c_n - floor  _|_  q_n + A_nn c_n + A_nt c_t >= 0`` with Coulomb friction on the
    velocity ``q_t + ...``.

    A complete solver of one planar contact: separation, stick, slide, reversed slide are tried in
    this order. ``q_n``, ``q_t`` [m/s] are the velocities without the impulse (``q_n`` with the
    required bounce), ``floor`` [N s] the least normal impulse (0, or Poisson's). While the
    contact approaches the answer is unique for every friction.
    """
    # at the floor: it separates, or friction of the floor alone
    limit = contact.friction * floor
    c_t = min(max(-(q_t + contact.coupling * floor) / contact.tangential, -limit), limit)
    if q_n + contact.normal * floor + contact.coupling * c_t >= 0.0:
        if floor == 0.0:
            return PlanarImpulse(0.0, 0.0, SEPARATE)
        u_t = q_t + contact.coupling * floor
        return PlanarImpulse(floor, c_t, STICK if abs(c_t) < limit else (SLIDE if u_t * q_t >= 0.0 else REVERSE))
    # stick: both velocities are brought to 0
    determinant = contact.normal * contact.tangential - contact.coupling**2
    c_n = -(contact.tangential * q_n - contact.coupling * q_t) / determinant
    c_t = -(contact.normal * q_t - contact.coupling * q_n) / determinant
    broken = max(abs(c_t) - contact.friction * c_n, floor - c_n) * contact.tangential
    if broken <= 0.0:
        return PlanarImpulse(c_n, c_t, STICK)
    # slip, one way or the other; where rounding denies all three, the nearest
    slide_n, slide_t, slide_broken, mode = _slide_modes(contact, q_n, q_t, floor)
    if slide_broken <= broken:
        return PlanarImpulse(slide_n, slide_t, mode)
    return PlanarImpulse(c_n, c_t, STICK)


@kernel
def _poisson_impulse(contact, u_n, u_t):
    """Compression by the step without bounce, then at least ``e`` times its normal impulse; the two
    are one sum here.
    """
    first = contact_modes(contact, u_n, u_t, 0.0)
    if first.mode == SEPARATE:
        return first
    after_n = u_n + contact.normal * first.normal + contact.coupling * first.tangential
    after_t = u_t + contact.coupling * first.normal + contact.tangential * first.tangential
    if first.mode == STICK:
        after_t = 0.0
    second = contact_modes(contact, min(after_n, 0.0), after_t, contact.restitution * first.normal)
    mode = first.mode if first.mode == REVERSE or second.mode == SEPARATE else second.mode
    return PlanarImpulse(first.normal + second.normal, first.tangential + second.tangential, mode)


@kernel
def _slopes(contact, slip):
    """(du_n/dp, du_t/dp, dc_t/dp) along the normal impulse p for friction sign ``slip``, 0:
    stick.
    """
    if slip == STICKING:
        follow = -contact.coupling / contact.tangential
        return contact.normal + contact.coupling * follow, 0.0, follow
    friction = slip * contact.friction
    return contact.normal + friction * contact.coupling, contact.coupling + friction * contact.tangential, friction


@kernel
def _after_stop(contact):
    """Friction sign once slip has stopped: sticking where friction suffices, else slip starts
    again, pushed by the normal.
    """
    if abs(contact.coupling) <= contact.friction * contact.tangential:
        return STICKING
    return -_sign(contact.coupling)


@kernel
def _stop_distance(u_t, slope):
    """Normal impulse until slip stops; endless where it does not."""
    if u_t * slope >= 0.0:
        return math.inf
    return -u_t / slope


@kernel
def energetic_impulse(contact: PlanarContact, u_n: float, u_t: float) -> PlanarImpulse:
    """Impact from ``u_n``, ``u_t`` [m/s] along its normal impulse p [N s] until the normal force
    has given back ``e^2`` of the work it took.

    u_n(p), u_t(p) are straight pieces with at most one change, where slip stops: each ends by a
    linear formula (slip stops, compression ends) or a quadratic one (work reached). Exact to
    rounding; the kinetic energy never grows.
    """
    if u_n >= 0.0:
        return PlanarImpulse(0.0, 0.0, SEPARATE)
    slip = -_sign(u_t) if u_t != 0.0 else _after_stop(contact)
    mode = SLIDE if slip != STICKING else STICK
    slope_n, slope_t, slope_c = _slopes(contact, slip)
    c_n, c_t, work = 0.0, 0.0, 0.0
    stop = _stop_distance(u_t, slope_t)
    if slope_n <= 0.0 or stop < -u_n / slope_n:  # slip stops during compression
        c_n, c_t, work = stop, slope_c * stop, (u_n + 0.5 * slope_n * stop) * stop
        u_n, u_t, stop = u_n + slope_n * stop, 0.0, math.inf
        slip = _after_stop(contact)
        mode = STICK if slip == STICKING else REVERSE
        slope_n, slope_t, slope_c = _slopes(contact, slip)
    length = -u_n / slope_n
    c_n, c_t, work = c_n + length, c_t + slope_c * length, work + 0.5 * u_n * length
    u_t, stop = u_t + slope_t * length, stop - length
    wanted = -(contact.restitution**2) * work
    length = math.sqrt(2.0 * wanted / slope_n)
    if length <= stop:
        return PlanarImpulse(c_n + length, c_t + slope_c * length, mode)
    u_n = slope_n * stop  # slip stops during restitution
    c_n, c_t, wanted = c_n + stop, c_t + slope_c * stop, wanted - 0.5 * u_n * stop
    slip = _after_stop(contact)
    slope_n, slope_t, slope_c = _slopes(contact, slip)
    length = 2.0 * wanted / (u_n + math.sqrt(u_n * u_n + 2.0 * slope_n * wanted))
    return PlanarImpulse(c_n + length, c_t + slope_c * length, STICK if slip == STICKING else REVERSE)


@kernel
def impact_impulse(contact: PlanarContact, rule: int, u_n: float, u_t: float) -> PlanarImpulse:
    """Impulse of one planar impact by ``rule`` (parameters.NEWTON, POISSON, ENERGETIC) from
    ``u_n``, ``u_t`` in [m/s].
    """
    if u_n >= 0.0:
        return PlanarImpulse(0.0, 0.0, SEPARATE)
    if rule == NEWTON:
        return contact_modes(contact, (1.0 + contact.restitution) * u_n, u_t, 0.0)
    if rule == POISSON:
        return _poisson_impulse(contact, u_n, u_t)
    return energetic_impulse(contact, u_n, u_t)


@entry
def planar_impact(contact: PlanarContact, rule: int, u_n: float, u_t: float) -> PlanarImpulse:
    """`impact_impulse` for callers from Python; ``u_n``, ``u_t`` in [m/s]."""
    return impact_impulse(contact, rule, u_n, u_t)
