"""How sure a mean is, and which assumptions of a vibration metric a signal breaks."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.report.signal.spectrum import AT_REST, HIGHEST_FREQUENCY, shortage_of_record

PART_TIME = 2.0
"""[s] of the parts of a record that count as independent"""
FEWEST_PARTS = 8
TWO_SIDED = 1.96
"""Standard errors in half the 95 % interval of an error that is known."""
CLIPPED_SHARE = 1e-3
"""Share of samples at full scale above which the metrics of a recording are doubtful: a sample or two change no rms."""
PLATEAU = 3
"""Equal extreme samples in succession that no vibration has but by clipping."""
LARGEST_CREST = 9.0


def half_interval(values: Sequence[float] | NDArray[np.float64]) -> float:
    """Half the 95 % interval of the mean of independent ``values`` [number], in their unit, by Student's t; nan for
    fewer than two.
    """
    from scipy.special import stdtrit

    count = len(values)
    if count < 2:
        return math.nan
    return float(stdtrit(count - 1, 0.975)) * float(np.std(values, ddof=1)) / math.sqrt(count)


def spread_of_mean(values: NDArray[np.float64], sample_rate: float) -> float:
    """Half the 95 % interval of the mean of ``values`` [samples], in their unit, by the scatter of parts of
    2 s; nan for fewer than 8 of them. sample_rate: [Hz]."""
    parts = _parts(values, sample_rate)
    return math.nan if parts is None else half_interval(parts)


def spread_of_rms(values: NDArray[np.float64], sample_rate: float) -> float:
    """As `spread_of_mean`, of the root mean square."""
    rms = math.sqrt(float(np.mean(np.square(values))))
    return spread_of_mean(np.square(values), sample_rate) / (2.0 * rms) if rms > 0.0 else math.nan


def spread_of_ratio(above: NDArray[np.float64], below: NDArray[np.float64], sample_rate: float) -> float:
    """As `spread_of_mean`, of the ratio of two rms values of signals [samples] at the same instants."""
    top, bottom = (_parts(np.square(each), sample_rate) for each in (above, below))
    if top is None or bottom is None or bottom.mean() <= AT_REST**2:
        return math.nan
    square = float(top.mean() / bottom.mean())
    rest = (top - square * bottom) / bottom.mean()
    return half_interval(rest) / (2.0 * math.sqrt(square)) if square else 0.0


def _parts(values: NDArray[np.float64], sample_rate: float) -> NDArray[np.float64] | None:
    length = max(1, round(PART_TIME * sample_rate))
    count = values.size // length
    if count < FEWEST_PARTS:
        return None
    found: NDArray[np.float64] = values[: count * length].reshape(count, length).mean(axis=1)
    return found


def short(samples: int, sample_rate: float, *, repeated: bool = False) -> tuple[str, ...]:
    """That a record of so many ``samples`` at a rate [Hz], ``repeated`` or not, is too short; empty where it is not."""
    caution = shortage_of_record(samples, sample_rate)
    needed = caution.partition("; a ride of ")[2].partition(" s or more")[0]
    length = f"{samples / sample_rate:.3g} s{' repeated' if repeated else ''}"
    return (f"too short: {length}, {needed} s needed",) if caution else ()


def slow(sample_rate: float) -> tuple[str, ...]:
    """That a rate [Hz] does not carry the band of whole-body vibration."""
    if sample_rate >= 2.0 * HIGHEST_FREQUENCY:
        return ()
    return (
        f"wrong rate: {sample_rate:.4g} Hz carries nothing above {0.5 * sample_rate:.4g} Hz, the weighting goes to 80",
    )


def peaky(crest_factor: float) -> tuple[str, ...]:
    """That a crest factor is above 9."""
    return (f"crest factor {crest_factor:.3g} above 9: read VDV and MTVV",) if crest_factor > LARGEST_CREST else ()


def clipped_share(values: NDArray[np.float64]) -> float:
    """Share of the samples [samples] that lie at an extreme value in successions of 3 or more; an extreme at which
    the signal mostly is, is its rest.
    """
    if values.size < PLATEAU or values.max() == values.min():
        return 0.0
    extremes = {float(values.max()), float(values.min())} - {float(np.median(values))}
    return sum(_plateaus(values == extreme) for extreme in extremes) / values.size


def _plateaus(at: NDArray[np.bool_]) -> int:
    """Samples in successions of `PLATEAU` or more."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], at, [False]]).astype(np.int8))).reshape(-1, 2)
    lengths = edges[:, 1] - edges[:, 0]
    return int(lengths[lengths >= PLATEAU].sum())


def clipped(share: float) -> tuple[str, ...]:
    """That a share of the samples is clipped."""
    return (f"clipped: {100.0 * share:.2g} % of the samples",) if share > CLIPPED_SHARE else ()
