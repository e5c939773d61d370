"""First-order relaxation of the slips: sigma du/ds + u = the slip of the wheel (Pacejka, 7.1 and 8.5).

sigma_kappa = K_x / C_x,  sigma_alpha = |K_y| / C_y                           carcass stiffness C, MF-Swift
sigma_kappa = F_z (p_Tx1 + p_Tx2 df) exp(p_Tx3 df) R_0 / F_z0
sigma_alpha = p_Ty1 sin(2 atan(F_z / (p_Ty2 F_z0))) R_0                       of MF 5.2 and PAC2002
"""

from __future__ import annotations

import math

from contact_sim_pkg.rigs.vehicle.tire.magic_formula.coefficients import MagicFormula
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.formulas import AtLoad

__all__ = ["relaxation_lengths"]

LEAST = 0.1
"""Of the carcass stiffness under the nominal load at the nominal inflation: the parabola of PCFX and PCFY may fall below 0
far from there.
"""


def relaxation_lengths(tire: MagicFormula, at: AtLoad, inflation: float) -> tuple[float, float]:
    """Along and across [m] under the load of ``at`` at an ``inflation`` [Pa]; 0 where the file gives none."""
    keys, df = tire.keys, (at.load - at.nominal) / at.nominal
    if tire.stiffness is None:
        along = at.load * (keys["PTX1"] + keys["PTX2"] * df) * math.exp(keys["PTX3"] * df) * at.radius / at.nominal
        across = 0.0
        if keys["PTY1"] and keys["PTY2"]:
            across = keys["PTY1"] * math.sin(2.0 * math.atan(at.load / (keys["PTY2"] * at.nominal))) * at.radius
        return max(along, 0.0) * keys["LSGKP"], max(across, 0.0) * keys["LSGAL"]
    dp = (inflation - keys["NOMPRES"]) / keys["NOMPRES"]
    stiff_x, stiff_y = (
        stiffness
        * max((1.0 + keys[f"PCF{axis}1"] * df + keys[f"PCF{axis}2"] * df**2) * (1.0 + keys[f"PCF{axis}3"] * dp), LEAST)
        for stiffness, axis in zip(tire.stiffness, "XY", strict=True)
    )
    return abs(at.k_x) / stiff_x, abs(at.k_y) / stiff_y
