"""The height that a body moves on between two solutions of its pressure field."""

from __future__ import annotations

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry

CANCELLED = 2.0
"""Factor on the part of the smooth height's change that a correction cancels."""


@entry
def effective_between(
    smooth: Vector, rate: Vector, correction: tuple[float, float, float], duration: float, out: Vector, out_rate: Vector
) -> None:
    """Write the effective height [m] of the road from one field to the next, and its rate [m/s],
    [points].

    smooth: smooth height [points] [m], rate: its rate [m/s]; correction: effective-height
    corrections [m] at the ends, ``duration`` [s] apart, and four times the sagitta [m] by which
    they lie below a straight line in the middle: a parabola. What the smooth height has beside a
    straight line is right to first order in the roughness only: at an edge it falls in a curve
    where the tire, which stands on the edge, does not, and the correction cancels nearly all of
    it. So its factor is ``1 - CANCELLED r``, at least 0, with r the part of the change of the
    smooth height that the correction cancels; times the range of the smooth height over the change
    of the correction, where that is less than 1.
    """
    last = smooth.shape[0] - 1
    highest, lowest = smooth[0], smooth[0]
    for i in range(1, last + 1):
        highest, lowest = max(highest, smooth[i]), min(lowest, smooth[i])
    offset, offset_end, bend = correction
    span, change = highest - lowest, offset_end - offset
    cancelled = -change * (smooth[last] - smooth[0]) / (span * span) if span > 0.0 else 0.0
    kept = max(0.0, 1.0 - CANCELLED * max(0.0, cancelled))
    if abs(change) > span:
        kept *= span / abs(change)
    climb = smooth[last] - smooth[0]
    for i in range(last + 1):
        # The straight line stays, the rest is reduced.
        part = i / last
        straight = smooth[0] + climb * part
        out[i] = straight + kept * (smooth[i] - straight) + offset + part * (change - bend * (1.0 - part))
        steady = climb / duration
        out_rate[i] = steady + kept * (rate[i] - steady) + (change - bend * (1.0 - 2.0 * part)) / duration
