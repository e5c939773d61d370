"""Foam under an even load, many columns at once: by the formula of ``laws/foam_elastic.py``, or by a measured curve.

A measured curve is the monotone cubic (PCHIP) through the origin and its points (e_i, s_i): stress and slope are
continuous, the stress at a point is that of the measurement, the energy the integral of the stress to the last digit.
Beyond its last point the slope stays. Where its first or last slope would fall below a tenth of the secant there, it
is that: a foam without stiffness carries nothing. Below 0 strain every foam bulges with its slope at first contact.

Source: Fritsch and Carlson 1980; the slopes are those of Fritsch and Butland 1984 (PCHIP).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, cast

import numpy
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator

from contact_sim_pkg.compiled.guards import require, require_positive, require_values
from contact_sim_pkg.laws.elastic_law import check_elastic
from contact_sim_pkg.laws.foam_elastic import foam_energy_density, foam_stress, foam_tangent_modulus
from contact_sim_pkg.laws.parameters import FoamCurve, FoamElastic, LayerFoam

__all__ = ["Columns", "columns_of"]

Field = NDArray[numpy.float64]
FEWEST_POINTS = 2
LEAST_SLOPE = 0.1  # of the first and the last secant


class Columns(NamedTuple):
    """The law of many columns; strains of any shape, below 0.999."""

    first_modulus: float  # [Pa] slope at first contact
    compressed_stress: Callable[[Field], Any]  # [Pa] at strains >= 0
    compressed_modulus: Callable[[Field], Any]  # [Pa]
    compressed_energy: Callable[[Field], Any]  # [J/m^3]

    def stress(self, strain: Field) -> Field:
        """Stress [Pa], negative where the strain is."""
        compressed = numpy.asarray(self.compressed_stress(numpy.maximum(strain, 0.0)))
        return numpy.where(strain > 0.0, compressed, self.first_modulus * strain)

    def modulus(self, strain: Field) -> Field:
        """d(stress)/d(strain) [Pa]."""
        return numpy.asarray(self.compressed_modulus(numpy.maximum(strain, 0.0)))

    def energy(self, strain: Field) -> Field:
        """Energy per volume [J/m^3]."""
        compressed = numpy.asarray(self.compressed_energy(numpy.maximum(strain, 0.0)))
        return numpy.where(strain > 0.0, compressed, 0.5 * self.first_modulus * strain**2)


def columns_of(foam: LayerFoam) -> Columns:
    """The columns of a foam. Raises ValueError where a parameter is outside its range: of a curve two points at least
    are needed, strains that rise from above 0 to below 1, stresses that rise from above 0.
    """
    return _of_curve(foam) if isinstance(foam, FoamCurve) else _of_formula(foam)


def _of_formula(foam: FoamElastic) -> Columns:
    """The laws written for numbers, as Python."""
    check_elastic(foam)
    stress, modulus, energy = (
        cast("Callable[..., Any]", getattr(law, "py_func", law))
        for law in (foam_stress, foam_tangent_modulus, foam_energy_density)
    )
    energies = numpy.vectorize(energy, excluded=(0,), otypes=[float])
    return Columns(
        foam.modulus + foam.densification_exponent * foam.densification,
        lambda strain: stress(foam, strain),
        lambda strain: modulus(foam, strain),
        lambda strain: energies(foam, strain),
    )


def _of_curve(foam: FoamCurve) -> Columns:
    require_positive("foam thickness", foam.thickness)
    points = len(foam.strain)
    x = require_values("strain of a foam's curve", numpy.array([0.0, *foam.strain]), "1", shape=(None,))
    y = require_values("stress of a foam's curve", numpy.array([0.0, *foam.stress]), "Pa", shape=(points + 1,))
    require("last strain of a foam's curve", float(x[-1]), most=0.999)
    if points < FEWEST_POINTS or (numpy.diff(x) <= 0.0).any() or (numpy.diff(y) <= 0.0).any():
        raise ValueError("curve of a foam: two points or more are needed whose strain and stress rise from above 0")
    # Slopes of PCHIP, those of the ends not below their least.
    slope = numpy.asarray(PchipInterpolator(x, y).derivative()(x))
    secant = numpy.diff(y) / numpy.diff(x)
    slope[0], slope[-1] = max(slope[0], LEAST_SLOPE * secant[0]), max(slope[-1], LEAST_SLOPE * secant[-1])
    curve = CubicHermiteSpline(x, y, slope)
    moduli, energies = curve.derivative(), curve.antiderivative()
    end, last, last_slope = x[-1], y[-1], slope[-1]

    def energy(strain: Field) -> Field:
        beyond = numpy.maximum(strain - end, 0.0)
        within = numpy.asarray(energies(numpy.minimum(strain, end)))
        return within + beyond * (last + 0.5 * beyond * last_slope)

    return Columns(
        float(slope[0]),
        lambda strain: curve(numpy.minimum(strain, end)) + last_slope * numpy.maximum(strain - end, 0.0),
        lambda strain: moduli(numpy.minimum(strain, end)),
        energy,
    )
