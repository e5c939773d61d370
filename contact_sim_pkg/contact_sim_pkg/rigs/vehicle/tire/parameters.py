"""Parameter tuples of the effects of the tread, in SI units."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Vector


class Brush(NamedTuple):
    """Bristles of a rolling tread, one a cell of its pressure field, with a Coulomb limit of their
    own.
    """

    stiffness_x: float  # [N/m^3] shear stress per deflection, along the travel, > 0
    stiffness_y: float  # [N/m^3] sideways, > 0
    coefficient_static: float  # ratio of shear stress to pressure at which sticking ends, > 0
    coefficient_kinetic: float  # ratio while sliding, > 0, <= coefficient_static


class TreadViscoelasticity(NamedTuple):
    """Relaxation of the tread's modulus: ``E(t) / E_long = 1 + retardation_time dirac(t) + sum
    ratio exp(-t / time)``.
    """

    retardation_time: float  # [s], >= 0; Kelvin-Voigt
    ratios: Vector  # [branches] Maxwell modulus over the long-time modulus, >= 0
    times: Vector  # [branches] [s] relaxation times, > 0
