"""Pressure of one contact force on a mat: what a bed of independent springs under a curved body
would carry.

Under a paraboloid of radii R1, R2 a bed of pressure ``k d**(n-1)``, d the local depth, carries ``2
pi k sqrt(R1 R2) d0**n / n`` at the approach d0: the power law ``A d0**n`` itself, with ``k = A n /
(2 pi sqrt(R1 R2))``. n = 3/2 has the form of Hertz' pressure, n = 1 is even. On the cells of a mat
the form is kept and the sum is made the force. One-sided: no cell pulls.

Over foam every cell is a column of the block under its local depth, and has the stress of the
foam's law there.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.laws.foam_elastic import foam_force
from contact_sim_pkg.laws.parameters import ElasticLaw, FoamElastic, NormalElastic, TabulatedElastic

Field = NDArray[numpy.float64]


def spread_force(force: float, approach: float, elastic: ElasticLaw, gap: Field, cell_area: float) -> Field:
    """Pressure in [Pa] of every cell, [rows, cols], whose sum times ``cell_area`` [m^2] is
    ``force`` [N].

    ``approach`` [m] of the body, ``gap`` [m] over each cell, [rows, cols], ``elastic``: the force
    law. A contact smaller than a cell loads the cell of the least gap. Zeros for ``force <= 0``.
    """
    # Also without force, so that a run that begins apart has compiled it
    form = _form_of(elastic, approach - gap)
    if force <= 0.0:
        return numpy.zeros_like(gap)
    if not form.any():
        form = (gap == gap.min()).astype(numpy.float64)
    return numpy.asarray(force * form / (form.sum() * cell_area))


def _form_of(elastic: ElasticLaw, depth: Field) -> Field:
    """Pressure of the bed at each depth in [m], up to a factor."""
    if isinstance(elastic, NormalElastic):
        return numpy.where(depth > 0.0, numpy.maximum(depth, 0.0) ** (elastic.exponent - 1.0), 0.0)
    if isinstance(elastic, TabulatedElastic):
        raise ValueError("the law by a table is that of a cushion, which has maps of its own")
    form = numpy.empty_like(depth)
    _foam_columns(elastic, depth, form)
    return form


@entry
def _foam_columns(foam: FoamElastic, depth: Field, out: Field) -> None:
    """Force in [N] of the whole block at each depth in [m], [rows, cols]."""
    for i in range(depth.shape[0]):
        for j in range(depth.shape[1]):
            out[i, j] = foam_force(foam, depth[i, j])


def paraboloid_gap(x: Field, y: Field, radius_x: float, radius_y: float) -> Field:
    """Gap in [m] of a body with these radii [m] over a flat one, [len(x), len(y)], at x and y in
    [m] from its crown.
    """
    return numpy.asarray(0.5 * x[:, None] ** 2 / radius_x + 0.5 * y[None, :] ** 2 / radius_y)
