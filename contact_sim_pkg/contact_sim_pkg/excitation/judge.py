"""The one judge of a recorded acceleration: what its values and stamps show of unit, vertical axis, rate and gaps.

File, bag and topic are judged alike. What contradicts itself is refused with its cure; what is assumed is said; an axis with an
unknown sample has no value.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import acos, cos, degrees, pi, radians, sqrt
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.table_words import STANDARD_GRAVITY, UNITS

__all__ = ["Cures", "Judgement", "Stamps", "is_known", "judge_acceleration", "judge_stamps", "unknown_samples"]

LARGEST_ACCELERATION = 1e5
"""[m/s^2] about 10 000 g, the end of the range of shock accelerometers"""
LARGEST_MEAN = 5.0 * STANDARD_GRAVITY
"""[m/s^2] no rig is accelerated so for the length of a recording"""
LARGEST_RMS = 200.0
"""[m/s^2] about 20 g: seats and floors stay a factor 10 below"""
GRAVITY_AGREEMENT = 0.1
"""of the mean with gravity"""
UNIT_AGREEMENT = 0.25
"""a mean this close to 1 or 1000 is gravity in g or mg, of a sensor however badly calibrated"""
ERROR_CODES = (999.0, 9999.0, 99999.0, 32767.0, 32768.0, 65535.0)
"""What loggers write for a sample that they do not have, with either sign"""
CODE_STANDS_OUT = 10.0
"""times the largest of the other samples: such a number is an error code"""
FROZEN_TIME, FROZEN_SAMPLES = 1.0, 20
"""[s] and samples for which no sensor under vibration repeats itself in all axes"""
STILL = 1.0
"""[m/s^2] mean below which a recording holds no gravity"""
UPRIGHT = radians(30.0)
"""angle between the mean and an axis below which that is the vertical one"""
TURNED = radians(5.0)
"""angle by which the mean of a part may lie beside that of the whole: 0.85 m/s^2 of gravity in a horizontal axis"""
PART_TIME = 5.0
"""[s] of those parts"""
LOWEST_RATE, HIGHEST_RATE = 5.0, 1e6
"""[Hz] of a vibration by its stamps: those of 1 to 4 kHz in milliseconds lie below"""
UNEVEN = 0.05
"""share of the step by which stamps may scatter"""

Array = NDArray[numpy.float64]


class Cures(NamedTuple):
    """What to write where the judge cannot know, by the words of whoever asks."""

    unit: str
    """such as `--unit g`, with `{}` for the unit"""
    up: str
    """such as `--up y`, with `{}` for the axis"""
    time: str
    """where the stamps are no seconds"""


class Judgement(NamedTuple):
    """What is known of a recorded acceleration."""

    factor: float
    """of the values, to [m/s^2]"""
    up: str
    """axis that points up, with a minus sign where it points down; empty where no gravity shows it"""
    assumed: tuple[str, ...]
    """what was assumed, a sentence each"""
    faults: tuple[str, ...]
    """what is doubtful about every axis"""
    unknown: Mapping[str, str]
    """axis -> why it has no value"""


class Stamps(NamedTuple):
    """What the times of samples show."""

    rate: float
    """[Hz] by the mean step"""
    scatter: float
    """half the distance of the quartiles of the steps over their middle"""
    gaps: int
    """steps of more than 1.5 usual ones"""
    back: int
    """steps that do not go forward"""
    first_wrong: int
    """sample behind the first gap or step back; 0 without any"""

    @property
    def faults(self) -> tuple[str, ...]:
        """What is doubtful about the rate."""
        found = (
            [f"wrong rate: stamps scatter by {100.0 * self.scatter:.2g} % of the step"] if self.scatter > UNEVEN else []
        )
        if self.gaps:
            found.append(f"wrong rate: {self.gaps} gaps in the stamps, the first before sample {self.first_wrong}")
        if self.back:
            found.append(f"wrong rate: {self.back} stamps go back, the first at sample {self.first_wrong}")
        return tuple(found)


def judge_stamps(time: Array, name: str, cure: str) -> Stamps:
    """Rate, scatter, gaps of the times of samples.

    Args:
        time: [n] [s], n > 1.
        name: of file and topic, for the sentence.
        cure: what to write where the times are no seconds.

    Raises:
        ExcitationError: times that do not go forward, or a rate that no vibration has.
    """
    steps = numpy.diff(time)
    low, high = numpy.quantile(steps, (0.25, 0.75))
    step = 0.5 * float(low + high)
    if not step > 0.0:
        raise ExcitationError(f"{name}: the stamps do not ascend, so the rate is unknown; record one stamp a sample")
    wrong = numpy.flatnonzero((steps <= 0.0) | (steps > 1.5 * step))
    rate = len(steps) / float(time[-1] - time[0]) if time[-1] > time[0] else 1.0 / step
    if not LOWEST_RATE <= 1.0 / step <= HIGHEST_RATE:
        slow = 1.0 / step < LOWEST_RATE
        raise ExcitationError(
            f"{name}: {1.0 / step:.4g} Hz by the stamps is no rate of a vibration ({LOWEST_RATE:g} to {HIGHEST_RATE:g} Hz); "
            f"are the times {'milliseconds or microseconds' if slow else 'seconds'}? {cure}"
        )
    return Stamps(
        rate,
        0.5 * float(high - low) / step,
        int((steps > 1.5 * step).sum()),
        int((steps <= 0.0).sum()),
        int(wrong[0]) + 1 if wrong.size else 0,
    )


def is_known(values: Array, factor: float = 1.0) -> NDArray[numpy.bool_]:
    """Whether each sample is one: a number, within what can be measured, and no error code of a logger.

    values: [n] as recorded; factor: of them, to [m/s^2].
    """
    size = numpy.abs(values)
    known: NDArray[numpy.bool_] = size <= LARGEST_ACCELERATION / factor
    coded = numpy.isin(size, ERROR_CODES)
    if coded.any():
        others = size[known & ~coded]
        known &= ~(coded & (size > CODE_STANDS_OUT * (others.max() if others.size else 0.0)))
    return known


def unknown_samples(values: Array, factor: float = 1.0) -> str:
    """Samples that are none by `is_known`, with the place of the first; empty without any."""
    wrong = numpy.flatnonzero(~is_known(values, factor))
    if not wrong.size:
        return ""
    first = values[wrong[0]]
    kind = "NaN" if numpy.isnan(first) else f"{first:g}"
    return f"{wrong.size} of {values.size} samples unknown: {kind} at sample {wrong[0]}"


def _stood_still(axes: Mapping[str, Array], rate: float) -> list[str]:
    """Failed reads, 0 in all axes beside gravity, and a sensor that repeats itself in all axes for a second."""
    samples = numpy.stack(list(axes.values()))
    found = []
    empty = numpy.flatnonzero((samples == 0.0).all(axis=0))
    if empty.size:
        found.append(f"failed reads: {empty.size} samples are 0 in all axes, the first {empty[0]}")
    moved = numpy.flatnonzero(numpy.concatenate([[True], (numpy.diff(samples) != 0.0).any(axis=0), [True]]))
    runs = numpy.diff(moved)
    longest = int(runs.argmax())
    if runs[longest] > max(FROZEN_SAMPLES, FROZEN_TIME * rate):
        found.append(f"frozen: {runs[longest]} samples from {moved[longest]} on are equal in all axes")
    return found


def judge_acceleration(
    axes: Mapping[str, Array], rate: float, name: str, cures: Cures, *, unit: str | None = None, up: str | None = None
) -> Judgement:
    """Unit, vertical axis and unknown samples of an acceleration.

    Args:
        axes: `x`, `y`, `z` -> [n] as recorded; an axis may be absent.
        rate: [Hz].
        name: of file and topic, for the sentences.
        cures: what to write where it cannot be known.
        unit: as stated, m/s^2, g or mg; None: m/s^2, where gravity does not contradict it.
        up: vertical axis as stated, `-y` where y points down; None: by gravity.

    Raises:
        ExcitationError: the values are in another unit, or the axis stated is not the one that gravity lies on.
    """
    factor = 1.0 if unit is None else UNITS[unit]
    unknown = {axis: said for axis, values in axes.items() if (said := unknown_samples(values, factor))}
    known = {axis: factor * values[is_known(values, factor)] for axis, values in axes.items()}
    known = {axis: values for axis, values in known.items() if values.size}
    means = {axis: float(values.mean()) for axis, values in known.items()}
    length = sqrt(sum(value**2 for value in means.values()))
    if unit is None:
        refuse_other_unit(length, max((float(each.std()) for each in known.values()), default=0.0), name, cures)
    # Gravity says where up is, and whether the unit is right
    assumed: list[str] = []
    faults: list[str] = []
    found = up or ""
    if abs(length - STANDARD_GRAVITY) <= GRAVITY_AGREEMENT * STANDARD_GRAVITY:
        found = _upward(means, length, name, cures, up)
        if up is None and found not in ("", "z"):
            axis, points = found[-1], "down" if found.startswith("-") else "up"
            assumed.append(f"gravity lies on {axis}, so {axis} points {points}")
        if not found:
            faults.append("gravity lies between the axes: none of them is vertical")
        turn = _turn(known, means, rate)
        if turn > TURNED:
            faults.append(f"the sensor turns: gravity by {degrees(turn):.2g}° within the recording")
        faults += _stood_still({axis: axes[axis] for axis in known}, rate)
    elif length > STILL:
        faults.append(f"the mean of {length:.3g} m/s² is neither gravity nor none")
    elif unit is None:
        assumed.append(f"no gravity shows the unit: m/s² is assumed ({cures.unit.format('m/s^2')} states it)")
        faults.append("unit assumed: m/s²")
    return Judgement(factor, found, tuple(assumed), tuple(faults), unknown)


def refuse_other_unit(mean: float, rms: float, name: str, cures: Cures) -> None:
    """Refuse values that are not in m/s^2 by what they show: gravity, a steady acceleration or an
    rms that cannot be.

    mean, rms: length of the mean, and largest rms of an axis about it, as if in [m/s^2].
    """
    # A mean of 1 or 1000 is gravity in g or mg
    for unit, gravity in (("g", 1.0), ("mg", 1000.0)):
        if abs(mean - gravity) <= UNIT_AGREEMENT * gravity:
            raise ExcitationError(
                f"{name}: the mean acceleration is {mean:.4g}, which is gravity in {unit} and not in m/s^2 "
                f"({STANDARD_GRAVITY:.4g}); state the unit ({cures.unit.format(unit)})"
            )
    if mean > LARGEST_MEAN or rms > LARGEST_RMS:
        raise ExcitationError(
            f"{name}: the mean acceleration is {mean:.4g} and the rms about it {rms:.4g}; in m/s^2 allowed are "
            f"{LARGEST_MEAN:.3g} and {LARGEST_RMS:g}; state the unit ({cures.unit.format('g')})"
        )


def _upward(means: Mapping[str, float], length: float, name: str, cures: Cures, stated: str | None) -> str:
    """The axis that gravity lies on, with its sign; empty where it lies between them.

    Raises ExcitationError where another one, or the other end of it, is stated.
    """
    axis = max(means, key=lambda each: abs(means[each]))
    if abs(means[axis]) < length * cos(UPRIGHT):
        return stated or ""
    found = axis if means[axis] > 0.0 else f"-{axis}"
    if stated is not None and stated != found:
        raise ExcitationError(
            f"{name}: gravity lies on {axis} ({means[axis]:.3g} m/s^2), so {found} points up and not {stated}; "
            f"write {cures.up.format(found)}"
        )
    return found


def _turn(known: Mapping[str, Array], means: Mapping[str, float], rate: float) -> float:
    """Largest angle [rad] between the mean of a part of 5 s and that of the whole; 0 with fewer than two parts."""
    length = round(PART_TIME * rate)
    count = min((len(values) for values in known.values()), default=0) // max(length, 1)
    if count < 2 or length < 1:
        return 0.0
    whole = numpy.array([means[axis] for axis in known])
    parts = numpy.array([values[: count * length].reshape(count, length).mean(axis=1) for values in known.values()])
    cosines = whole @ parts / numpy.maximum(numpy.linalg.norm(whole) * numpy.linalg.norm(parts, axis=0), 1e-300)
    return float(min(acos(max(-1.0, float(cosines.min()))) if cosines.min() < 1.0 else 0.0, pi))
