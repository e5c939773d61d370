"""Guards of public functions: what cannot be computed is refused before anything is, in one
sentence.

The sentence holds the name, the value and what is allowed: `radius -1.0 m: a finite number above 0
is needed`. A guard stands where Python calls, once; compiled functions have none. Every function
here raises `error`, a kind of `ValueError`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from numbers import Real
from typing import Any

import numpy
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "require",
    "require_choice",
    "require_count",
    "require_fields",
    "require_not_negative",
    "require_poisson_ratio",
    "require_positive",
    "require_values",
]

Error = type[ValueError]


def require(
    name: str, value: Any, unit: str = "", *, above: float = -math.inf, least: float = -math.inf, below: float = math.inf,
    most: float = math.inf, infinite: bool = False, error: Error = ValueError,
) -> float:  # fmt: skip
    """`value` as a float where it is a number within its bounds, and finite unless `infinite`;
    raises `error` otherwise.

    value: a number in `unit`, dimensionless where that is empty; bounds in the same unit. `unit` is
    for the sentence alone.
    """
    # At once, for it is called often
    if type(value) is float and above < value < below and least <= value <= most:
        return value
    try:
        number = float(value) if isinstance(value, Real) else math.nan
    except OverflowError:  # a whole number above 1.8e308
        number = math.inf
    inside = number > above or above == -math.inf
    inside = inside and (number < below or below == math.inf) and least <= number <= most
    if inside and (infinite or math.isfinite(number)):
        return number
    shown = str(value)[:60] if isinstance(value, Real) else repr(value)[:60]
    raise error(f"{name} {shown}{_blank(unit)}: {_wanted(above, least, below, most, infinite)} is needed")


def require_positive(name: str, value: Any, unit: str = "", *, error: Error = ValueError) -> float:
    """`value` where it is finite and above 0; in `unit`, dimensionless where that is empty."""
    return require(name, value, unit, above=0.0, error=error)


def require_not_negative(name: str, value: Any, unit: str = "", *, error: Error = ValueError) -> float:
    """`value` where it is finite and at least 0; in `unit`, dimensionless where that is empty."""
    return require(name, value, unit, least=0.0, error=error)


def require_poisson_ratio(value: Any, *, error: Error = ValueError) -> float:
    """Poisson ratio `value` [1] where it lies above -1 and not above 1/2."""
    return require("Poisson ratio", value, above=-1.0, most=0.5, error=error)


def require_count(name: str, value: Any, *, least: int = 1, most: float = math.inf, error: Error = ValueError) -> int:
    """`value` [1] where it is a whole number from `least` to `most`."""
    number = require(name, value, least=least, most=most, error=error)
    if number != math.floor(number):
        raise error(f"{name} {value}: a whole number is needed")
    return int(number)


def require_choice(name: str, value: Any, allowed: Iterable[Any], *, error: Error = ValueError) -> None:
    """Refuse a `value` that is none of `allowed`."""
    choices = list(allowed)
    if value not in choices:
        raise error(f"{name} {value!r}: {' or '.join(map(repr, choices))} is needed")


def require_fields(
    kind: str, record: Any, *, positive: str = "", not_negative: str = "", finite: str = "", error: Error = ValueError
) -> None:
    """Refuse a record of `kind` by its fields, named in words: those above 0, those at least 0,
    those that are only finite.
    """
    for names, least, above in (
        (positive, -math.inf, 0.0),
        (not_negative, 0.0, -math.inf),
        (finite, -math.inf, -math.inf),
    ):
        for name in names.split():
            require(f"{kind}: {name}", getattr(record, name), least=least, above=above, error=error)


def require_values(
    name: str, values: ArrayLike, unit: str = "", *, shape: tuple[int | None, ...] | None = None, rising: bool = False,
    above: float = -math.inf, least: float = -math.inf, most: float = math.inf, error: Error = ValueError,
) -> NDArray[numpy.float64]:  # fmt: skip
    """`values` as a contiguous array where all are finite and within bounds; the sentence names the
    first that is not.

    shape: None in it allows any length. rising: each value above the one before. values: array-like
    of the required shape, in `unit`, dimensionless where that is empty; the result is float64 of
    that shape.
    """
    try:
        array = numpy.ascontiguousarray(values, dtype=numpy.float64)
    except (TypeError, ValueError):
        raise error(f"{name} {repr(values)[:60]}: an array of numbers is needed") from None
    if numpy.ndim(values) == 0:
        array = array.reshape(())  # numpy makes an array of a single number
    if shape is not None and not _fits(array.shape, shape):
        wanted = ", ".join("any" if length is None else str(length) for length in shape)
        raise error(f"{name}: shape {array.shape}, [{wanted}] is needed")
    bad = ~(numpy.isfinite(array) & (array >= least) & (array <= most) & ((array > above) | (above == -math.inf)))
    if bad.any():
        place = tuple(int(i) for i in numpy.argwhere(bad)[0])
        wanted = _wanted(above, least, math.inf, most, False)
        raise error(f"{name}{list(place) or ''} {array[place]}{_blank(unit)}: {wanted} is needed")
    if rising and not (numpy.diff(array) > 0.0).all():
        place = (int(numpy.argmin(numpy.diff(array) > 0.0)) + 1,)
        raise error(f"{name}{list(place)} {array[place]}{_blank(unit)}: rising numbers are needed")
    return array


def _fits(found: tuple[int, ...], wanted: tuple[int | None, ...]) -> bool:
    return len(found) == len(wanted) and all(w is None or f == w for f, w in zip(found, wanted, strict=True))


def _wanted(above: float, least: float, below: float, most: float, infinite: bool) -> str:
    """What is allowed, in words."""
    bounds = []
    if above > -math.inf:
        bounds.append(f"above {above:.6g}")
    if least > -math.inf:
        bounds.append(f"at least {least:.6g}")
    if below < math.inf:
        bounds.append(f"below {below:.6g}")
    if most < math.inf:
        bounds.append(f"at most {most:.6g}")
    return " ".join(filter(None, ("a number" if infinite else "a finite number", " and ".join(bounds))))


def _blank(unit: str) -> str:
    return f" {unit}" if unit else ""
