"""Property tests of public functions by a table: function, strategy of its stated domain, independent check, what it refuses.

A check is written under `@holds(function, argument=strategy, …)` and called with what the function found and with its arguments.
Three things are tested of each entry:

* the check holds over the domain;
* of every number in the arguments, inside records and arrays too, NaN is refused, and infinity, zero and -1 are refused or
  answered in finite real numbers; so is an unknown word. A refusal is a ValueError of one line;
* what is listed as `outside` is refused.

Compiled functions are not guarded: their docstrings must say so.
"""

from __future__ import annotations

import importlib
import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

Test = Callable[..., None]
HOSTILE = (math.nan, math.inf, -math.inf, 0.0, -1.0)


class Property(NamedTuple):
    function: Callable[..., Any]
    domain: dict[str, Any]  # argument: strategy
    check: Callable[..., None]
    outside: tuple[dict[str, Any], ...] = ()  # arguments that are refused beside a domain's others
    infinite: bool = False  # whether a result may be infinite
    examples: int = 20
    refused: Callable[[Any], bool] = lambda found: False  # a result that is a refusal

    @property
    def name(self) -> str:
        plain = getattr(self.function, "py_func", self.function)
        return f"{plain.__module__.removeprefix('contact_sim_pkg.')}.{plain.__qualname__}"


class Table(list[Property]):
    """The properties of one test module."""

    def holds(
        self, function: Callable[..., Any], /, *, outside: tuple[dict[str, Any], ...] = (), infinite: bool = False,
        examples: int = 20, refused: Callable[[Any], bool] = lambda found: False, **domain: Any,
    ) -> Callable[[Callable[..., None]], Callable[..., None]]:  # fmt: skip
        def enter(check: Callable[..., None]) -> Callable[..., None]:
            self.append(Property(function, domain, check, outside, infinite, examples, refused))
            return check

        return enter

    def missing(self, package: str, modules: Iterable[str]) -> list[str]:
        """Public functions without a property."""
        here = {id(case.function) for case in self}
        found = []
        for module in modules:
            loaded = importlib.import_module(f"{package}.{module}")
            functions = [getattr(loaded, name) for name in loaded.__all__]
            found += [f"{module}.{f}" for f in functions if _is_function(f) and id(f) not in here]
        return found

    def tests(self, package: str, modules: Iterable[str], trusted: tuple[type, ...] = ()) -> tuple[Test, Test, Test]:
        """The tests of a module: of the domains, of the refusals, and that no public function is left out.

        trusted: types of records that only functions of the package make.
        """
        names = [case.name for case in self]

        @pytest.mark.parametrize("case", self, ids=names)
        def domain(case: Property) -> None:
            check_domain(case)

        @pytest.mark.parametrize("case", self, ids=names)
        def refusals(case: Property) -> None:
            if hasattr(case.function, "py_func"):  # compiled: not guarded, and says so
                assert "not checked" in " ".join((case.function.__doc__ or "").lower().split())
            else:
                check_refusals(case, trusted)

        def complete() -> None:
            assert self.missing(package, modules) == []

        return domain, refusals, complete


def positive(low: float, high: float) -> Any:
    """Numbers from `low` to `high`, as many in each decade."""
    return st.floats(math.log(low), math.log(high)).map(lambda x: min(max(math.exp(x), low), high))


def rows(values: Any, least: int = 1, most: int = 6) -> Any:
    """Arrays of numbers."""
    return st.lists(values, min_size=least, max_size=most).map(lambda v: numpy.array(v, dtype=float))


def check_domain(case: Property) -> None:
    """The independent check, over the domain."""

    @settings(max_examples=case.examples)
    @given(st.fixed_dictionaries(case.domain))
    def over(arguments: dict[str, Any]) -> None:
        case.check(case.function(**arguments), **arguments)

    over()


def check_refusals(case: Property, trusted: tuple[type, ...] = ()) -> None:
    """Hostile numbers and words at every place of the arguments; records of `trusted` types are made by the package itself."""

    @settings(max_examples=2 if case.examples > 5 else 1)
    @given(st.fixed_dictionaries(case.domain))
    def over(arguments: dict[str, Any]) -> None:
        real = not any(isinstance(value, complex) for value in _numbers(case.function(**arguments)))
        for name, value in arguments.items():
            for place, bad, hostile in _spoilt(value, trusted):
                must = bad != bad or isinstance(bad, str)
                _try(case, {**arguments, name: hostile}, f"{name}{place} = {bad}", must, real)
        for other in case.outside:
            _try(case, {**arguments, **other}, f"{other}", True, real)

    over()


def _try(case: Property, arguments: dict[str, Any], what: str, must: bool, real: bool) -> None:
    try:
        found = case.function(**arguments)
    except ValueError as error:
        sentence = str(error)
        assert sentence, f"{case.name}: no sentence for {what}"
        assert "\n" not in sentence, f"{case.name}: more than a line for {what}: {sentence}"
        plain = ("math domain", "cannot convert", "could not", "setting an array", "expected")
        assert not sentence.startswith(plain), f"{case.name}, {what}: {sentence}"
        return
    except Exception as error:
        if type(error) is ArithmeticError:  # of a search that a function documents, none of its kinds
            return
        raise AssertionError(f"{case.name} with {what}: {type(error).__name__}: {error}") from error
    if case.refused(found):
        return
    assert not must, f"{case.name} takes {what} and gives {found}"
    for value in _numbers(found):
        assert not (real and isinstance(value, complex)), f"{case.name} with {what} gives {found}"
        assert abs(value) < math.inf or (case.infinite and value == value), f"{case.name} with {what} gives {found}"


def _spoilt(value: Any, trusted: tuple[type, ...]) -> Iterator[tuple[str, Any, Any]]:
    """Each place of a value, what is put there, and the value with it."""
    if isinstance(value, (bool, type(None), *trusted)) or callable(value):
        return
    if isinstance(value, (int, float)):
        for bad in HOSTILE:
            yield "", bad, bad
    elif isinstance(value, complex):
        for bad in (complex(math.nan, value.imag), complex(value.real, math.nan), complex(math.inf, 0.0), 0j):
            yield "", bad, bad
    elif isinstance(value, str):
        yield "", "no such word", "no such word"
    elif isinstance(value, numpy.ndarray):
        for bad in HOSTILE if value.size else ():
            spoilt = value.astype(float)
            spoilt.flat[value.size // 2] = bad
            yield "[…]", bad, spoilt
    elif isinstance(value, tuple):
        names = getattr(value, "_fields", range(len(value)))
        for i, part in enumerate(value):
            for place, bad, hostile in _spoilt(part, trusted):
                parts = (*value[:i], hostile, *value[i + 1 :])
                yield f".{names[i]}{place}", bad, type(value)(*parts) if hasattr(value, "_fields") else parts


def _numbers(found: Any) -> Iterator[complex]:
    if isinstance(found, numpy.ndarray):
        yield from found.ravel().tolist()
    elif isinstance(found, (int, float, complex, numpy.number)) and not isinstance(found, bool):
        yield complex(found) if isinstance(found, (complex, numpy.complexfloating)) else float(found)
    elif isinstance(found, (tuple, list)):
        for part in found:
            yield from _numbers(part)


def _is_function(thing: Any) -> bool:
    return callable(thing) and not isinstance(thing, type)
