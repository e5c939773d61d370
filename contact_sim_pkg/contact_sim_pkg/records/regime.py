"""What a scene is there to show, as a number of its run with a band: jams, lifts off, grows.

A rig registers its regimes in `Rig.regimes`; a scene names one of them under `expect`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

__all__ = ["LIFTS_OFF", "STAYS", "Figure", "Regime"]


class Figure(NamedTuple):
    """What a run shows of a regime."""

    value: float
    """in the regime's unit; nan where the run does not show it at all"""
    remark: str = ""
    """where and when; why there is no value"""


@dataclass(frozen=True, kw_only=True)
class Regime:
    """One regime. A scene meets it where its figure lies in the band, ends included.

    Attributes:
        name: the word behind `expect.regime`.
        help: what the figure is, in a phrase.
        unit: of the figure; empty: a number.
        measure: ``module:function`` of a `report.series.Recording` -> `Figure`.
        at_least, at_most: ends of the band, where the scene gives none.
    """

    name: str
    help: str
    unit: str = ""
    measure: str
    at_least: float = -math.inf
    at_most: float = math.inf


_CONTACT = "contact_sim_pkg.report.metrics.regimes"

STAYS = Regime(
    name="stays",
    help="longest time without load of any contact",
    unit="s",
    measure=f"{_CONTACT}:longest_flight",
    at_most=0.0,
)
LIFTS_OFF = Regime(
    name="lifts_off",
    help="longest time without load between two loads of any contact",
    unit="s",
    measure=f"{_CONTACT}:longest_flight_between",
    at_least=1e-3,
)
"""Regimes that any rig with a contact may have."""
