"""Dissipation of the general normal law ``F = A x**n + B x**p sgn(x') |x'|**q`` for an approach x >
0, else 0 (Driver and Seat eq 8).

Special cases: p = 0, q = 1, n = 1 the linear spring and damper (Kelvin and Voigt; the force jumps
by B v0 at first contact); p = n, q = 1 Hunt and Crossley; n = 3/2, p = 1/2, q = 1 the viscoelastic
sphere of Kuwabara and Kono, which Goloshchapov's impact shares; B = 0 the elastic law.

End of contact: where p < n the dissipation outweighs the spring before x is back at 0. With
``lowest_force = 0`` contact is lost where F reaches 0 (end rule ``force``: no adhesion); with
``-inf`` it lasts, pulling, until x = 0 (end rule ``gap``).

q < 1 has an infinite slope at x' = 0. ``|x'|**(q-1)`` is then evaluated at ``sqrt(x'^2 + s^2)``, s
the smoothing speed, 1e-6 of the reference speed: the force is wrong by less than 1e-6 of itself
wherever |x'| is above 1e-3 of that speed.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.laws.elastic_law import elastic_force, elastic_order, elastic_stiffness
from contact_sim_pkg.laws.parameters import ElasticLaw, GeneralDissipative

SMOOTHING = 1.0e-6  # smoothing speed over reference speed where q < 1
SMALLEST_APPROACH = 1.0e-60  # [m], below it the tension margin stands for its limit at first contact


@kernel
def rate_power(general: GeneralDissipative, approach_rate: float) -> float:
    """``sgn(x') |x'|**q`` in [(m/s)^q] of the approach rate x' [m/s], smooth at ``x' = 0`` where q
    < 1."""
    size = approach_rate * approach_rate + general.smoothing_speed * general.smoothing_speed
    if size == 0.0:
        return 0.0
    return approach_rate * size ** (0.5 * (general.rate_exponent - 1.0))


@kernel
def rate_power_slope(general: GeneralDissipative, approach_rate: float) -> float:
    """Derivative of ``rate_power`` by the approach rate x' [m/s], in [(m/s)^(q-1)]."""
    squared = approach_rate * approach_rate
    size = squared + general.smoothing_speed * general.smoothing_speed
    if size == 0.0:
        return 1.0 if general.rate_exponent == 1.0 else 0.0
    q = general.rate_exponent
    return size ** (0.5 * (q - 1.0)) * (1.0 + (q - 1.0) * squared / size)


@kernel
def general_force(
    elastic: ElasticLaw, general: GeneralDissipative, approach: float, approach_rate: float, hysteresis_factor: float
) -> float:
    """Contact force in [N] at ``approach`` [m] and ``approach_rate`` [m/s]; the elastic part is
    multiplied by ``hysteresis_factor``.
    """
    if approach <= 0.0:
        return 0.0
    dissipation = general.coefficient * approach**general.approach_exponent * rate_power(general, approach_rate)
    return max(general.lowest_force, hysteresis_factor * elastic_force(elastic, approach) + dissipation)


@kernel
def general_tension_event(
    elastic: ElasticLaw, general: GeneralDissipative, approach: float, approach_rate: float, hysteresis_factor: float
) -> float:
    """Contact force over ``x**min(n, p)``, before it is limited: its sign change is the event "the
    force reaches zero".

    Infinite where the contact may pull (end rule ``gap``): there is no such event.
    approach: [m]; approach_rate: [m/s]; the result: [N/m^min(n, p)].
    """
    if general.lowest_force < 0.0:
        return -general.lowest_force
    x = max(approach, SMALLEST_APPROACH)
    order = min(elastic_order(elastic), general.approach_exponent)
    dissipation = general.coefficient * rate_power(general, approach_rate) * x ** (general.approach_exponent - order)
    return hysteresis_factor * elastic_force(elastic, x) / x**order + dissipation


@kernel
def general_force_rate(
    elastic: ElasticLaw,
    general: GeneralDissipative,
    approach: float,
    approach_rate: float,
    approach_acceleration: float,
    hysteresis_factor: float,
) -> float:
    """dF/dt in [N/s], ``hysteresis_factor`` held; 0 without contact."""
    if approach <= 0.0:
        return 0.0
    p = general.approach_exponent
    thickness = general.coefficient * approach**p
    power = rate_power(general, approach_rate)
    if hysteresis_factor * elastic_force(elastic, approach) + thickness * power <= general.lowest_force:
        return 0.0
    slope = hysteresis_factor * elastic_stiffness(elastic, approach) + p * thickness / approach * power
    return slope * approach_rate + thickness * rate_power_slope(general, approach_rate) * approach_acceleration
