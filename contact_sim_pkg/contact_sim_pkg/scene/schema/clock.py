"""Times that must fit together: blocks in the duration, samples in a block, all in whole
nanoseconds.

Decimal fractions are taken as they are written (0.01 is 1/100), so nothing hangs on rounding. A
duration may be the sum of floats, such as 0.47000000000000003: it is taken as the whole number of
blocks that it is meant to be.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from itertools import chain, islice

from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.suggested import allows

Rule = Callable[[Scene], Iterable[Breach]]
NANOSECONDS = 10**9
ROUNDED = Fraction(1, 10**9)  # of a whole number, of blocks or turns: what is this near to it is rounded
TRIED = 20  # rates next to the given one, from which the nearest that every rule allows is taken


def exact(value: float) -> Fraction:
    """The shortest decimal number that reads as this float; in its unit, here times in [s] and
    rates in [Hz]."""
    return Fraction(repr(value))


def whole_duration(scene: Scene) -> float:
    """Duration in [s] of the scene's blocks: the requested one without its rounding."""
    return float(_blocks(scene) * exact(scene.block_length))


def snapped(count: Fraction) -> Fraction:
    """A whole number, unless the count is further than ROUNDED from it."""
    whole = round(count)
    return Fraction(whole) if abs(count - whole) <= ROUNDED * whole else count


def _blocks(scene: Scene) -> Fraction:
    """Blocks in the duration."""
    return snapped(exact(scene.duration) / exact(scene.block_length))


def clock_breaches(scene: Scene) -> Iterator[Breach]:
    """Block length, duration and rates that do not fit; each with the nearest allowed values."""
    faults = list(_block(scene))
    yield from faults or chain(_duration(scene), _rates(scene), _vibration(scene))


def _block(scene: Scene) -> Iterator[Breach]:
    nanoseconds = exact(scene.block_length) * NANOSECONDS
    if nanoseconds.denominator != 1:
        below = nanoseconds.numerator // nanoseconds.denominator
        near = [Fraction(n, NANOSECONDS) for n in (below, below + 1)]
        sentence = f"{scene.block_length!r} s is not a whole number of nanoseconds"
        yield Breach("block_length", sentence + _nearest(scene, "block_length", near, "s", _block))


def _duration(scene: Scene) -> Iterator[Breach]:
    block, blocks = exact(scene.block_length), _blocks(scene)
    if blocks.denominator != 1:
        whole = int(blocks)
        sentence = f"{scene.duration!r} s is not a whole number of blocks of {_decimal(block)} s"
        near = _nearest(scene, "duration", [whole * block, (whole + 1) * block], "s", _duration)
        yield Breach("duration", sentence + near, ("block_length",))


def _rates(scene: Scene) -> Iterator[Breach]:
    outputs, block = scene.outputs, int(exact(scene.block_length) * NANOSECONDS)
    faulty = False
    for name in ("force_rate", "display_rate", "field_rate"):
        for breach in _rate(scene, getattr(outputs, name), f"outputs.{name}", _rates):
            faulty = True
            yield breach
    if faulty:
        return
    for name in ("display_rate", "field_rate"):
        slow, fast = exact(getattr(outputs, name)), exact(outputs.force_rate)
        if (fast / slow).denominator != 1:
            where = "outputs.force_rate"
            near = _nearest_rates(scene, where, fast * block / NANOSECONDS, _rates)
            sentence = f"{_decimal(fast)} Hz is not a multiple of {name} ({_decimal(slow)} Hz)"
            yield Breach(where, sentence + near, (f"outputs.{name}", "block_length"))


def _vibration(scene: Scene) -> Iterator[Breach]:
    if scene.vibration is not None:
        yield from _rate(scene, scene.vibration.sample_rate, "vibration.sample_rate", _vibration)


def _rate(scene: Scene, rate: float, where: str, rule: Rule) -> Iterator[Breach]:
    block = int(exact(scene.block_length) * NANOSECONDS)
    samples = exact(rate) * block / NANOSECONDS
    length = f"a block of {_decimal(Fraction(block, NANOSECONDS))} s"
    if samples.denominator == 1 and block % int(samples) == 0:
        return
    near = _nearest_rates(scene, where, samples, rule)
    if samples.denominator != 1:
        what = f"gives {_decimal(samples)} samples in {length}, a whole number is needed"
    else:
        what = f"gives {int(samples)} samples in {length}, which are no whole number of nanoseconds apart"
    yield Breach(where, f"{rate!r} Hz {what}{near}", ("block_length",))


def _nearest_rates(scene: Scene, where: str, samples: Fraction, rule: Rule) -> str:
    """The rates next below and above ``samples`` a block that the rule allows, as `_nearest` words them."""
    block = int(exact(scene.block_length) * NANOSECONDS)
    counts = divisors(block)
    below = [Fraction(count * NANOSECONDS, block) for count in reversed(counts) if count < samples]
    above = [Fraction(count * NANOSECONDS, block) for count in counts if count > samples]
    near = [rate for side in (below, above) for rate in islice(_allowed(scene, where, side[:TRIED], rule), 1)]
    return _nearest(scene, where, near, "Hz", rule)


def divisors(number: int) -> list[int]:
    """All divisors of a number, rising."""
    small = [n for n in range(1, int(number**0.5) + 1) if number % n == 0]
    return sorted({*small, *(number // n for n in small)})


def _allowed(scene: Scene, where: str, values: Iterable[Fraction], rule: Rule) -> Iterator[Fraction]:
    """Those of ``values`` that the rule allows as they are printed."""
    return (value for value in values if allows(scene, where, float(_decimal(value)), rule))


def _nearest(scene: Scene, where: str, values: Iterable[Fraction], unit: str, rule: Rule) -> str:
    """`; nearest allowed are A and B UNIT`, of those of a key's ``values`` that are allowed; empty where none is."""
    near = [_decimal(value) for value in _allowed(scene, where, values, rule)]
    joint = "nearest allowed are" if len(near) > 1 else "nearest allowed is"
    return f"; {joint} {' and '.join(near)} {unit}" if near else ""


def _decimal(value: Fraction) -> str:
    return f"{float(value):.12g}"
