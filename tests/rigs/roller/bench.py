"""The bench of Rolling Contact, with the values that the paper leaves open chosen."""

import math

from contact_sim_pkg.rigs.roller.theory.parameters import Bending, Curvatures, Roller

MODULUS = 210e9 / (1.0 - 0.3**2) / 2.0  # [Pa] E* of steel on steel
CURVATURES = Curvatures(100.0, 50.0, 200.0, 0.0)  # radii 10, 20 and 5 mm
ROLLER = Roller(0.02, 2e-5, 2e-5, 0.0, 3.5e-5, 100.0 * math.pi, 60.0, 50.0, 0.0, 0.0, 0.01)
SECOND_MOMENT = 0.25 * math.pi * 0.005**4
BENDING = Bending(225.0, 0.060, 0.158, 0.005, SECOND_MOMENT, 0.1)
