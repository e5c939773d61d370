"""Elastic law of a foam block under an even load: soft start, plateau, densification (two terms of
Hill's hyperfoam, nu = 0).

With the strain ``e = x/h``, the stretch ``l = 1 - e``, the area S of the block and ``a = E_0/p_0``

``F/S = p_0 (1/l - l**(a-1)) + p_d (l**(-r-1) - 1/l)``, energy ``S h [p_0 (-ln l - (1 - l**a)/a) +
p_d ((l**-r - 1)/r + ln l)]``.

The first term rises with the modulus E_0 and bends to the plateau p_0, the second is the
densification: it grows as l**(-r-1), and no force closes the block. Slope at first contact ``S (E_0
+ r p_d)/h``. Below a stretch of 1e-3 the law goes on along its tangent. Source: Hill 1978;
Storakers 1986: U = sum of 2 mu_i/a_i^2 (sum of l^a_i - 3 - a_i ln J) for nu = 0, as seat foams are
fitted.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.laws.parameters import FoamElastic

GREATEST_STRAIN = 0.999
NEWTON_STEPS = 200
SERIES_BELOW = 1.0e-2  # the first term left out is then below 1e-16


@kernel
def _excess(power, logarithm):
    """``(exp(p L) - 1 - p L)/p`` without cancellation."""
    t = power * logarithm
    if abs(t) > SERIES_BELOW:
        return (math.expm1(t) - t) / power
    series = 1.0 + t / 3.0 * (1.0 + t / 4.0 * (1.0 + t / 5.0 * (1.0 + t / 6.0 * (1.0 + t / 7.0))))
    return 0.5 * t * logarithm * series


@kernel
def foam_stress(foam: FoamElastic, strain: float) -> float:
    """Compressive stress in [Pa], positive, at ``strain`` 0 to 0.999."""
    logarithm = numpy.log1p(-strain)
    first = numpy.expm1(-logarithm) - numpy.expm1((foam.modulus / foam.plateau - 1.0) * logarithm)
    second = numpy.expm1(-(foam.densification_exponent + 1.0) * logarithm) - numpy.expm1(-logarithm)
    return foam.plateau * first + foam.densification * second


@kernel
def foam_tangent_modulus(foam: FoamElastic, strain: float) -> float:
    """d(stress)/d(strain) in [Pa] at ``strain`` 0 to 0.999."""
    a, r, stretch = foam.modulus / foam.plateau, foam.densification_exponent, 1.0 - strain
    first = stretch**-2.0 + (a - 1.0) * stretch ** (a - 2.0)
    second = (r + 1.0) * stretch ** (-r - 2.0) - stretch**-2.0
    return foam.plateau * first + foam.densification * second


@kernel
def foam_energy_density(foam: FoamElastic, strain: float) -> float:
    """Energy per volume in [J/m^3] at ``strain`` 0 to 0.999."""
    logarithm = math.log1p(-strain)
    first = _excess(foam.modulus / foam.plateau, logarithm)
    return foam.plateau * first - foam.densification * _excess(-foam.densification_exponent, logarithm)


@kernel
def _strain_and_beyond(foam, approach):
    """Strain up to its greatest, and the strain beyond it."""
    strain = approach / foam.thickness
    return min(strain, GREATEST_STRAIN), max(strain - GREATEST_STRAIN, 0.0)


@kernel
def foam_force(foam: FoamElastic, approach: float) -> float:
    """Force in [N] at ``approach`` in [m]; 0 for ``approach <= 0``."""
    if approach <= 0.0:
        return 0.0
    strain, beyond = _strain_and_beyond(foam, approach)
    stress = foam_stress(foam, strain)
    if beyond > 0.0:
        stress += beyond * foam_tangent_modulus(foam, strain)
    return foam.area * stress


@kernel
def foam_order(foam: FoamElastic) -> float:
    """Power [1] of the approach with which the force begins: 1."""
    return 1.0


@kernel
def foam_stiffness(foam: FoamElastic, approach: float) -> float:
    """Slope dF/dx in [N/m] at ``approach`` in [m]; 0 for ``approach <= 0``."""
    if approach <= 0.0:
        return 0.0
    strain, _beyond = _strain_and_beyond(foam, approach)
    return foam.area / foam.thickness * foam_tangent_modulus(foam, strain)


@kernel
def foam_energy(foam: FoamElastic, approach: float) -> float:
    """Energy stored at ``approach`` in [J]; 0 for ``approach <= 0``."""
    if approach <= 0.0:
        return 0.0
    strain, beyond = _strain_and_beyond(foam, approach)
    density = foam_energy_density(foam, strain)
    if beyond > 0.0:
        density += beyond * (foam_stress(foam, strain) + 0.5 * beyond * foam_tangent_modulus(foam, strain))
    return foam.area * foam.thickness * density


@kernel
def foam_approach_of_force(foam: FoamElastic, force: float) -> float:
    """Approach in [m] at which the law gives ``force`` in [N], by Newton within a bracket; 0 for
    ``force <= 0``.
    """
    if force <= 0.0:
        return 0.0
    # Bracket.
    low, high = 0.0, foam.thickness
    while foam_force(foam, high) < force:
        low = high
        high *= 2.0
    # Newton's method, bisection where it leaves the bracket.
    x = 0.5 * (low + high)
    for _ in range(NEWTON_STEPS):
        difference = foam_force(foam, x) - force
        if difference > 0.0:
            high = x
        else:
            low = x
        step = difference / foam_stiffness(foam, x)
        following = x - step
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - x) <= 1.0e-16 * foam.thickness:
            return following
        x = following
    return x
