"""What varies from case to case: keys with a range or a list, and the samples of them."""

from __future__ import annotations

import csv
import itertools
import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.files import RefusedError

__all__ = ["SweepError", "Variation", "read_rows", "read_variation", "samples_of"]

GRID, LATIN, SOBOL, SALTELLI = "grid", "lhs", "sobol", "saltelli"
LOGARITHMIC = "log"
SEED = "seed"  # key of a scene
MOST_CASES = 1_000_000
COMMA = re.compile(r",(?![^\[{]*[\]}])")
"""One that parts a list, not one within a value such as `{kind: flat}`."""

Field = NDArray[numpy.float64]
Values = dict[str, str]
"""Of a case: what `--set` would take, by key."""


class SweepError(RefusedError):
    """What cannot be swept as it was asked."""


class Variation(NamedTuple):
    """A key of the scene and what it takes: a list, or a range of numbers."""

    key: str
    listed: tuple[str, ...] = ()
    low: float = math.nan
    high: float = math.nan
    number: int = 0
    """points of a range on a grid; 0: not said"""
    is_logarithmic: bool = False

    @property
    def ends(self) -> tuple[str, ...]:
        """Values that have to be allowed for all of them to be: the list, or both ends of the range."""
        return self.listed or (repr(self.low), repr(self.high))

    @property
    def points(self) -> tuple[str, ...]:
        """Values on a grid. Raises SweepError for a range without a count."""
        if self.listed:
            return self.listed
        if not self.number:
            raise SweepError(
                f"--vary {self.key}: a grid needs the number of points: {self.key}={self.low:.6g}:{self.high:.6g}:5; or take "
                "--sample lhs:N"
            )
        return (
            tuple(self.at(part) for part in numpy.linspace(0.0, 1.0, self.number))
            if self.number > 1
            else (repr(self.low),)
        )

    def at(self, part: float) -> str:
        """Value at a ``part`` in [0, 1) of the range, or of the list."""
        if self.listed:
            return self.listed[min(int(part * len(self.listed)), len(self.listed) - 1)]
        if self.is_logarithmic:
            # Both ends as they were written
            value = self.low * (self.high / self.low) ** part if part < 1.0 else self.high
        else:
            value = self.low + part * (self.high - self.low)
        return f"{value:.12g}"


def read_variation(text: str, option: str = "--vary") -> Variation:
    """`KEY=low:high`, `KEY=low:high:count`, either with `:log`, or `KEY=a,b,c`, of which each may be a list or a mapping.

    Raises SweepError for what is none of them.
    """
    key, equals, value = (part.strip() for part in text.partition("="))
    if not equals or not key or not value:
        raise SweepError(f"{option} {text}: is not of the form KEY=low:high:count or KEY=a,b,c")
    parts = value.split(":")
    if len(parts) > 1 and not set(value) & set(",{["):
        return _range(f"{option} {text}", key, parts)
    listed = tuple(each.strip() for each in COMMA.split(value))
    if not all(listed):
        raise SweepError(f"{option} {text}: a value of the list is empty")
    kinds = [_kind_of(each) for each in listed]
    for place, kind in enumerate(kinds):
        if kind in kinds[:place]:
            raise SweepError(f"{option} {text}: {listed[place]} is there twice")
    return Variation(key, listed)


def _kind_of(text: str) -> float | str:
    """What a value is the same as: 3 and 3.0 are one number."""
    try:
        return float(text)
    except ValueError:
        return text


def _range(given: str, key: str, parts: list[str]) -> Variation:
    is_logarithmic = parts[-1] == LOGARITHMIC
    numbers = parts[:-1] if is_logarithmic else parts
    try:
        low, high = float(numbers[0]), float(numbers[1])
        count = int(numbers[2]) if len(numbers) == 3 else 0
    except (ValueError, IndexError):
        raise SweepError(f"{given}: is not of the form KEY=low:high:count or KEY=a,b,c") from None
    if len(numbers) > 3 or not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise SweepError(f"{given}: a range is low:high:count with low below high")
    if len(numbers) == 3 and not 1 <= count <= MOST_CASES:
        raise SweepError(f"{given}: {count} points; at least 1, at most {MOST_CASES}")
    if is_logarithmic and low <= 0.0:
        raise SweepError(f"{given}: a logarithmic range begins above 0")
    return Variation(key, (), low, high, count, is_logarithmic)


def samples_of(variations: Sequence[Variation], sample: str, seeds: int, seed: int) -> list[Values]:
    """The values of all cases, in their order.

    Args:
        variations: keys that vary; two may not have the same.
        sample: `grid`, `lhs:N`, `sobol:N`, `saltelli:N` for Sobol indices, or the path of a CSV file whose header names
            keys and whose rows are cases.
        seeds: of each case so many with seeds from 1; 0: the seed of the scene.
        seed: of the samples themselves.

    Raises:
        SweepError: nothing varies, a key varies twice, or the sample is none.
    """
    keys = [each.key for each in variations]
    twice = sorted({key for key in keys if keys.count(key) > 1})
    if twice:
        raise SweepError(f"--vary {twice[0]}: varies twice")
    kind, _, number = sample.partition(":")
    if kind == GRID and not number:
        points = [each.points for each in variations]
        _refuse_too_many(math.prod(map(len, points)), seeds)
        found = [dict(zip(keys, each, strict=True)) for each in itertools.product(*points)]
    elif kind in (LATIN, SOBOL, SALTELLI):
        found = _drawn(variations, kind, number, seed)
    else:
        found = _from_file(Path(sample), keys)
    _refuse_too_many(len(found), seeds)
    if seeds and kind == SALTELLI:
        raise SweepError("--seeds beside --sample saltelli: the indices take each case once; leave --seeds out")
    if seeds:
        if any(SEED in each for each in found):
            raise SweepError("--seeds beside --vary seed: leave one out")
        found = [{**each, SEED: str(number)} for each in found for number in range(1, seeds + 1)]
    if not found or not found[0]:
        raise SweepError("nothing varies: give --vary KEY=low:high:count, --seeds N or --sample FILE.csv")
    return found


def _refuse_too_many(number: int, seeds: int) -> None:
    """Raise SweepError before a list is built that nobody has the time to run."""
    if number * max(seeds, 1) > MOST_CASES:
        raise SweepError(
            f"{number * max(seeds, 1)} cases; at most {MOST_CASES}: vary less, or draw samples by --sample lhs:N"
        )


def _drawn(variations: Sequence[Variation], kind: str, number: str, seed: int) -> list[Values]:
    """Samples by scipy: Latin hypercube, or Sobol's sequence, scrambled; for Sobol indices two samples of N, and the first
    with each key in turn from the second.
    """
    from scipy.stats import qmc

    if not variations:
        raise SweepError(f"--sample {kind}:{number}: draws from the ranges of --vary, and there is none")
    if not number.isdecimal() or not 1 <= int(number) <= MOST_CASES:
        raise SweepError(f"--sample {kind}:{number}: write the number of cases, {kind}:64 for one")
    count = int(number)
    if kind == SALTELLI:
        if count & (count - 1):
            raise SweepError(f"--sample {kind}:{number}: N is a power of two, {2 ** round(math.log2(count))} for one")
        _refuse_too_many(count * (len(variations) + 2), 0)
        both = qmc.Sobol(2 * len(variations), seed=numpy.random.default_rng(seed)).random(count)
        first, second = numpy.hsplit(both, 2)
        mixed = [numpy.where(numpy.arange(len(variations)) == key, second, first) for key in range(len(variations))]
        return _values_at(variations, numpy.concatenate([first, second, *mixed]))
    draw = qmc.LatinHypercube if kind == LATIN else qmc.Sobol
    whole = 2 ** math.ceil(math.log2(count)) if kind == SOBOL else count  # of that sequence a power of two is balanced
    points = draw(len(variations), seed=numpy.random.default_rng(seed)).random(whole)[:count]
    return _values_at(variations, points)


def _values_at(variations: Sequence[Variation], points: Field) -> list[Values]:
    """Values at ``points`` [cases, keys] of the unit cube."""
    return [{each.key: each.at(float(part)) for each, part in zip(variations, row, strict=True)} for row in points]


def _from_file(path: Path, keys: Sequence[str]) -> list[Values]:
    if not path.is_file():
        raise SweepError(f"--sample {path}: is none of grid, lhs:N, sobol:N, saltelli:N, and there is no such file")
    if keys:
        raise SweepError(f"--sample {path}: the file says what varies; leave --vary {keys[0]} out")
    rows = read_rows(path)
    header = rows[0] if rows else []
    if not header or not all(header) or len(set(header)) < len(header):
        raise SweepError(f"{path}: the first row names the keys that vary, each once")
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(header) or not all(row):
            raise SweepError(
                f"{path}: row {number} has {len([each for each in row if each])} values for {len(header)} keys"
            )
    return [dict(zip(header, row, strict=True)) for row in rows[1:]]


def read_rows(path: Path) -> list[list[str]]:
    """The rows of a CSV file without the empty ones, cells stripped. Raises SweepError where it is no text of UTF-8."""
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            return [[each.strip() for each in row] for row in csv.reader(file) if any(each.strip() for each in row)]
    except UnicodeDecodeError as error:
        raise SweepError(f"{path}: byte {error.start} is no UTF-8; save it as a CSV file of UTF-8 text") from None
    except csv.Error as error:
        raise SweepError(f"{path}: is no CSV file ({error})") from None
