"""Rules that tie keys of the impact rig together."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from contact_sim_pkg.rigs.impact.schema import ImpactSection
from contact_sim_pkg.rigs.impact.schema_effects import Shift
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show, show_below
from contact_sim_pkg.scene.schema.scene import Scene


def impact_breaches(scene: Scene) -> Iterator[Breach]:
    """Releases without a period, a pendulum that is too short, a shift table that is no
    material.
    """
    impact, shift = scene.section(ImpactSection), scene.effect("impact", Shift)
    releases = len(impact.speeds) * len(impact.temperatures) * impact.repeats
    if releases > 1 and impact.period is None:
        yield Breach(
            "impact.period", f"is missing; {releases} releases need the time from one to the next", ("impact",)
        )
    # A pendulum has the most speed from the horizontal: V^2 = 2 g L.
    if impact.machine == "pendulum":
        most = math.sqrt(2.0 * impact.gravity * impact.arm)
        for index, speed in enumerate(impact.speeds):
            if speed > most:
                sentence = (
                    f"{show(speed)} m/s is more than a pendulum of {show(impact.arm)} m reaches from the horizontal, "
                    f"{show_below(most, 4)} m/s; take a longer arm"
                )
                yield Breach(f"impact.speeds.{index}", sentence, ("impact.arm",))
    if shift is not None:
        yield from _table(shift.table)


def _table(rows: list[list[float]]) -> Iterator[Breach]:
    where = "effects.impact.shift.table"
    for index, (before, after) in enumerate(pairwise(rows), start=1):
        if not after[0] > before[0]:
            sentence = f"{show(after[0])} K does not come after {show(before[0])} K; temperatures must rise"
            yield Breach(f"{where}.{index}.0", sentence)
    for index, (temperature, modulus, tangent) in enumerate(rows):
        for place, value, low, high, unit in (
            (0, temperature, 1.0, 2000.0, " K"), (1, modulus, 1.0, 1e13, " Pa"), (2, tangent, 0.0, 100.0, ""),
        ):  # fmt: skip
            if not low <= value <= high:
                yield Breach(f"{where}.{index}.{place}", f"{show(value)}{unit} is outside {low:g} to {high:g}{unit}")
