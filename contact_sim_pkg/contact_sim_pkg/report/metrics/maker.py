"""How a rig makes the metrics of its list."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from contact_sim_pkg.excitation.kinds import RoadKind, kind_known
from contact_sim_pkg.records.metric import CLOSED_FORM, SELF_CHECK, STATIONARY, Band, Metric, judged
from contact_sim_pkg.report.energy import relative_residual
from contact_sim_pkg.report.metrics.bands import Conditions, band_of
from contact_sim_pkg.report.series import LedgerSeries

ENERGY = "energy"
"""Prefix of the keys of what the frame adds to the metrics of every rig."""
REALTIME_RESIDUAL = 0.01
"""of a run whose accuracy is what real time leaves"""
__all__ = ["ENERGY", "Maker", "at_most", "conditions_of", "energy_residual", "near"]


class Maker(NamedTuple):
    """Makes metrics of one topic over one window of a run."""

    prefix: str
    """of the keys: the contact"""
    topic: str
    window: tuple[float, float]
    """[s]"""
    conditions: Conditions = MappingProxyType({})
    """what the run is, for the bands"""
    basis: str = STATIONARY
    """of metrics that name none"""

    def make(
        self,
        key: str,
        name: str,
        value: float,
        unit: str = "",
        *,
        quantity: str = "",
        band: Band | None = None,
        remark: str = "",
        broken: tuple[str, ...] = (),
        spread: float = math.nan,
        count: int = 0,
        topic: str = "",
        basis: str = "",
        error: float = math.nan,
    ) -> Metric:
        """A metric: its band is ``band``, or that of a ``quantity`` of the data file in this run. Beside a closed form
        it is a self-check.
        """
        words, reason = "", "" if band is not None else "no band"
        if band is None and quantity:
            found = band_of(quantity, self.conditions)
            band, reason, words = found.band, found.reason, found.word(value)
        said = "; ".join(filter(None, (words, reason if reason != "no band" else "", remark)))
        return Metric(
            f"{self.prefix}.{key}", name, float(value), unit, judged(value, band), band, remark=said, broken=broken,
            spread=float(spread), size=count, topic=topic or self.topic, window=self.window, error=float(error),
            basis=SELF_CHECK if band is not None and band.kind == CLOSED_FORM else basis or self.basis,
        )  # fmt: skip


ROUNDING = 1e-9
"""of the scale of its terms, by which a closed form may be missed"""


def near(value: float, share: float, source: str, scale: float = 0.0) -> Band:
    """Band of a closed form: ``value`` and a ``share`` of it on either side; what is left of the difference of
    terms as large as ``scale`` is rounding.
    """
    reach = abs(value) * share + ROUNDING * scale
    return Band(value - reach, value + reach, CLOSED_FORM, source)


def at_most(value: float, source: str, kind: str = CLOSED_FORM) -> Band:
    """Band that bounds from above: by a closed form, or by a limit."""
    return Band(-math.inf, value, kind, source)


def energy_residual(ledger: LedgerSeries, duration: float, scene: Mapping[str, object]) -> Metric:
    """Largest residual of the energy over its throughput.

    What a step errs by is bounded by the requested accuracy; more is an energy that the ledger does not have.
    """
    accuracy = scene.get("accuracy")
    bound = float(accuracy) if isinstance(accuracy, (int, float)) else REALTIME_RESIDUAL
    return Maker(ENERGY, "bench/energy", (0.0, duration)).make(
        "residual", "energy residual", relative_residual(ledger), "", band=at_most(bound, "requested accuracy"),
        count=ledger.time.size, remark="share of the largest entry that the entries leave open",
    )  # fmt: skip


def conditions_of(scene: Mapping[str, object]) -> dict[str, float | str]:
    """Road and excitation of a scene by the names of the data file: `flat`, `class C`, `cleat`."""
    road = scene.get("road")
    if not isinstance(road, Mapping):
        return {}
    known: RoadKind | None = kind_known("road", road)
    return {"road": str(road.get("kind")) if known is None else known.condition}
