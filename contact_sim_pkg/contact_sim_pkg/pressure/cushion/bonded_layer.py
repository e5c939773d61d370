"""Influence function of an elastic layer that is bonded to a rigid base.

Displacement over pressure of one harmonic of wave number q on the top of a layer of thickness h,
with ``t = q h``, ``kappa = 3 - 4 nu``, ``G = E/(2 (1 + nu))``:

* top without shear stress: ``K = (1 - nu)/(G q) (kappa sinh 2t - 2t) / (kappa cosh 2t + 2 t^2 + 5 -
  12 nu + 8 nu^2)``
* top that cannot move sideways (an inextensible cover): ``K = (kappa^2 sinh^2 t - t^2) / (4 G (1 -
  nu) q (kappa sinh t cosh t + t))``

Long waves (``q h -> 0``): ``h/M``, independent columns of the modulus ``M = 2 G (1 - nu)/(1 - 2
nu)``. Short waves: the half-space, ``(1 - nu)/(G q)``, with a cover times ``kappa/(4 (1 - nu)^2)``.
Sources: Johnson, Contact Mechanics, 5.8 (layers); Bentall and Johnson 1968; Kalker, Three-
Dimensional Elastic Bodies in Rolling Contact, 1990.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require, require_positive, require_values

__all__ = ["layer_influence"]

Field = NDArray[numpy.float64]
DECAYED = 1e3  # of t: exp(-2 t) is 0 there
SERIES_BELOW = 1e-4  # of t: what the limit leaves out is of the order t^2


def layer_influence(
    wave_number: Field, thickness: float, modulus: float, poisson: float = 0.0, *, inextensible: bool = False
) -> Field:
    """Displacement over pressure K in [m/Pa] at each ``wave_number`` q [1/m], >= 0, of any shape.

    thickness: [m]; modulus: Young's modulus [Pa]; poisson: above -1, below 1/2; inextensible: the
    top cannot move sideways. Finite at every q: the hyperbolic functions are scaled by exp(-2 t).
    Raises ValueError outside the range.
    """
    require_positive("thickness", thickness, "m")
    require_positive("modulus", modulus, "Pa")
    require("Poisson ratio", poisson, above=-1.0, below=0.5)
    q = require_values("wave number", wave_number, "1/m", shape=(None,) * numpy.ndim(wave_number), least=0.0)
    shear = 0.5 * modulus / (1.0 + poisson)
    kappa = 3.0 - 4.0 * poisson
    t = numpy.maximum(q * thickness, SERIES_BELOW)
    near = numpy.minimum(t, DECAYED)  # a factor of exp(-2t) alone
    # exp(-2t) times sinh 2t, cosh 2t and 1
    decay = numpy.exp(-2.0 * t)
    sinh, cosh = 0.5 * (1.0 - decay**2), 0.5 * (1.0 + decay**2)
    if inextensible:
        sinh_squared = 0.25 * (1.0 - decay) ** 2
        numerator = thickness / t * (kappa**2 * sinh_squared - near**2 * decay)
        found = numerator / (4.0 * shear * (1.0 - poisson) * (0.5 * kappa * sinh + near * decay))
    else:
        numerator = (1.0 - poisson) / shear * thickness / t * (kappa * sinh - 2.0 * near * decay)
        found = numerator / (kappa * cosh + (2.0 * near**2 + 5.0 - 12.0 * poisson + 8.0 * poisson**2) * decay)
    columns = thickness * (1.0 - 2.0 * poisson) / (2.0 * shear * (1.0 - poisson))
    return numpy.asarray(numpy.where(q * thickness < SERIES_BELOW, columns, found))
