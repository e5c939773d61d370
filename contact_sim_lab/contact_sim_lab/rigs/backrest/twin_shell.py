"""Shallow shell and plate by other ways: finite differences of the equations, Levy's single
series.
"""

from __future__ import annotations

from collections.abc import Mapping

import mpmath
import numpy
import scipy.sparse
import scipy.sparse.linalg
from numpy.typing import NDArray

__all__ = ["plate_centre_deflection", "shell_frequencies"]


def plate_centre_deflection(side_1: float, side_2: float, rigidity: float, load: float) -> float:
    """Deflection [m] under a load in the middle of a simply supported plate (Timoshenko, Plates and
    Shells, eq 146).

    `P a^2 / (2 pi^3 D) sum over odd m of (tanh(u) - u / cosh(u)^2) / m^3, u = m pi b / (2 a)`, 30
    digits.
    """
    with mpmath.workdps(30):

        def term(k: mpmath.mpf) -> mpmath.mpf:
            order = 2 * k + 1
            u = order * mpmath.pi * side_2 / (2 * side_1)
            return (mpmath.tanh(u) - u / mpmath.cosh(u) ** 2) / order**3

        return float(load * side_1**2 / (2 * mpmath.pi**3 * rigidity) * mpmath.nsum(term, [0, mpmath.inf]))


def shell_frequencies(shell: Mapping[str, float], count: int, cells: int = 40) -> NDArray[numpy.float64]:
    """The lowest angular frequencies [rad/s] of Donnell's equations, one for each of ``count``
    modes.

    By finite differences, extrapolated from two grids: `D Lap^2 w + Lap_k F = omega^2 rho h w`,
    `Lap^2 F = E h Lap_k w`, `Lap_k = d_xx / R2 + d_yy / R1`, with w, Lap w, F and Lap F zero on the
    edges. shell: the fields of `ShallowShell` by name.
    """
    coarse, fine = (_differences(shell, count, n) for n in (cells, 2 * cells))
    return (4.0 * fine - coarse) / 3.0


def _differences(shell: Mapping[str, float], count: int, cells: int) -> NDArray[numpy.float64]:
    """One grid of `cells` by `cells`; the pair (w, F / (E h)) as a generalised problem, inverted
    around zero.
    """

    def second(length: float) -> scipy.sparse.dia_matrix:
        ones = numpy.ones(cells - 1)
        return scipy.sparse.diags([ones[1:], -2.0 * ones, ones[1:]], [-1, 0, 1]) * (cells / length) ** 2

    # Second derivatives on the inner nodes; the biharmonic operator is the square of the Laplacian.
    unit = scipy.sparse.identity(cells - 1)
    along_x = scipy.sparse.kron(second(shell["length_1"]), unit)
    along_y = scipy.sparse.kron(unit, second(shell["length_2"]))
    biharmonic = (along_x + along_y) @ (along_x + along_y)
    curved = along_x / shell["radius_2"] + along_y / shell["radius_1"]
    bending = shell["thickness"] ** 2 / (12.0 * (1.0 - shell["poisson"] ** 2))
    stiffness = scipy.sparse.bmat([[bending * biharmonic, curved], [curved, -biharmonic]], format="csc")
    # Only w has inertia: the mass matrix is singular, so the problem is inverted around zero.
    nothing = scipy.sparse.csc_matrix(biharmonic.shape)
    mass = scipy.sparse.bmat([[scipy.sparse.identity(biharmonic.shape[0]), None], [None, nothing]], format="csc")
    values = scipy.sparse.linalg.eigsh(stiffness, count, mass, sigma=0.0, return_eigenvectors=False)
    return numpy.sqrt(numpy.sort(values) * shell["young"] / shell["density"])
