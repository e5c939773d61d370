"""The roller bench of Rolling Contact, with the values that it leaves open chosen."""

from __future__ import annotations

import math

from contact_sim_pkg.rigs.roller.theory.parameters import Curvatures, Roller

__all__ = ["BENDING_COMPLIANCE", "CURVATURES", "LIMITS", "LOAD", "MASS", "MODULUS", "POISSON", "ROLLER", "SHAFT_RADIUS"]

POISSON = 0.3
MODULUS = 210e9 / (1.0 - POISSON**2) / 2.0  # [Pa] E* of steel on steel
CURVATURES = Curvatures(100.0, 50.0, 200.0, 0.0)  # [1/m], radii 10, 20 and 5 mm
SHAFT_RADIUS = 0.005  # [m]
LOAD = 100.0  # [N]
MASS = 0.175  # [kg]
BENDING_COMPLIANCE = 0.060**3 / (3.0 * 210e9 * 0.25 * math.pi * SHAFT_RADIUS**4)  # k_b [m/N]
LIMITS = (2.6e8, 1.5e8)  # [Pa] normal and shear, of the shaft
ROLLER = Roller(0.02, 2e-5, 2e-5, 0.0, 3.5e-5, 100.0 * math.pi, 60.0, 50.0, 0.0, 0.0, 0.01)
