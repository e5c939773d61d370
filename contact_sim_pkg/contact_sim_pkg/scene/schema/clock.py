"""Times that must fit together: blocks in the duration, samples in a block, all in whole
nanoseconds.

Decimal fractions are taken as they are written (0.01 is 1/100), so nothing hangs on rounding. A
duration may be the sum of floats, such as 0.47000000000000003: it is taken as the whole number of
blocks that it is meant to be.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.scene import Scene

NANOSECONDS = 10**9
LONGEST_DURATION = 3600
ROUNDED = Fraction(1, 10**9)  # of a whole number of blocks: a duration this near to it is rounded


def exact(value: float) -> Fraction:
    """The shortest decimal number that reads as this float; in its unit, here times in [s] and
    rates in [Hz]."""
    return Fraction(repr(value))


def whole_duration(scene: Scene) -> float:
    """Duration in [s] of the scene's blocks: the requested one without its rounding."""
    return float(_blocks(scene) * exact(scene.block_length))


def _blocks(scene: Scene) -> Fraction:
    """Blocks in the duration: a whole number, unless the duration is further than ROUNDED from
    it.
    """
    blocks = exact(scene.duration) / exact(scene.block_length)
    whole = round(blocks)
    return Fraction(whole) if abs(blocks - whole) <= ROUNDED * whole else blocks


def clock_breaches(scene: Scene) -> Iterator[Breach]:
    """Block length, duration and rates that do not fit; each with the nearest allowed values."""
    nanoseconds = exact(scene.block_length) * NANOSECONDS
    if nanoseconds.denominator != 1:
        below = nanoseconds.numerator // nanoseconds.denominator
        near = " and ".join(_decimal(Fraction(n, NANOSECONDS)) for n in (below, below + 1))
        yield Breach(
            "block_length",
            f"{scene.block_length!r} s is not a whole number of nanoseconds; nearest allowed are {near} s",
        )
        return
    yield from _duration(scene)
    block = int(nanoseconds)
    yield from _rates(scene, block)
    if scene.vibration is not None:
        yield from _rate(scene.vibration.sample_rate, "vibration.sample_rate", block)


def _duration(scene: Scene) -> Iterator[Breach]:
    block, blocks = exact(scene.block_length), _blocks(scene)
    if blocks.denominator != 1:
        whole = int(blocks)
        near = [_decimal(n * block) for n in (whole, whole + 1) if 0 < n * block <= LONGEST_DURATION]
        sentence = f"{scene.duration!r} s is not a whole number of blocks of {_decimal(block)} s; {_nearest(near, 's')}"
        yield Breach("duration", sentence, ("block_length",))


def _rates(scene: Scene, block: int) -> Iterator[Breach]:
    outputs = scene.outputs
    faulty = False
    for name in ("force_rate", "display_rate", "field_rate"):
        for breach in _rate(getattr(outputs, name), f"outputs.{name}", block):
            faulty = True
            yield breach
    if faulty:
        return
    for name in ("display_rate", "field_rate"):
        slow, fast = exact(getattr(outputs, name)), exact(outputs.force_rate)
        if (fast / slow).denominator != 1:
            near = _near_multiples(int(slow * block / NANOSECONDS), fast, block)
            sentence = f"{_decimal(fast)} Hz is not a multiple of {name} ({_decimal(slow)} Hz); {_nearest(near, 'Hz')}"
            yield Breach("outputs.force_rate", sentence, (f"outputs.{name}", "block_length"))


def _rate(rate: float, where: str, block: int) -> Iterator[Breach]:
    samples = exact(rate) * block / NANOSECONDS
    length = f"a block of {_decimal(Fraction(block, NANOSECONDS))} s"
    if samples.denominator == 1 and block % int(samples) == 0:
        return
    near = _near(divisors(block), samples, block)
    if samples.denominator != 1:
        what = f"gives {_decimal(samples)} samples in {length}, a whole number is needed"
    else:
        what = f"gives {int(samples)} samples in {length}, which are no whole number of nanoseconds apart"
    yield Breach(where, f"{rate!r} Hz {what}; {_nearest(near, 'Hz')}", ("block_length",))


def _near_multiples(step: int, rate: Fraction, block: int) -> list[str]:
    samples = rate * block / NANOSECONDS
    return _near([count for count in divisors(block) if count % step == 0], samples, block)


def _near(counts: list[int], samples: Fraction, block: int) -> list[str]:
    """The rates next below and above that can be written as a decimal number."""
    rates = [(count, Fraction(count * NANOSECONDS, block)) for count in counts]
    exact_rates = [(count, rate) for count, rate in rates if Fraction(_decimal(rate)) == rate]
    below = [rate for count, rate in exact_rates if count < samples][-1:]
    above = [rate for count, rate in exact_rates if count > samples][:1]
    return [_decimal(rate) for rate in (*below, *above)]


def divisors(number: int) -> list[int]:
    """All divisors of a number, rising."""
    small = [n for n in range(1, int(number**0.5) + 1) if number % n == 0]
    return sorted({*small, *(number // n for n in small)})


def _nearest(near: list[str], unit: str) -> str:
    joint = "nearest allowed are" if len(near) > 1 else "nearest allowed is"
    return f"{joint} {' and '.join(near)} {unit}"


def _decimal(value: Fraction) -> str:
    return f"{float(value):.12g}"
