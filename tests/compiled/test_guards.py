"""The guards of public functions: what passes, what is refused, and the sentence."""

from __future__ import annotations

import math
import re
from fractions import Fraction

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_pkg.compiled import guards


@settings(max_examples=200)
@given(st.floats())
def test_the_bounds_are_what_the_names_say(value: float) -> None:
    def passes(guard: object) -> bool:
        try:
            return guard("x", value) == value  # type: ignore[operator]
        except ValueError:
            return False

    assert passes(guards.require_positive) == (0.0 < value < math.inf)
    assert passes(guards.require_not_negative) == (0.0 <= value < math.inf)
    assert passes(guards.require) == math.isfinite(value)
    assert passes(lambda _, x: guards.require_poisson_ratio(x)) == (-1.0 < value <= 0.5)
    assert passes(lambda n, x: guards.require(n, x, below=2.0, infinite=True)) == (value < 2.0)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: guards.require_positive("radius", -1.0, "m"), "radius -1.0 m: a finite number above 0 is needed"),
        (lambda: guards.require_positive("radius", math.nan), "radius nan: a finite number above 0 is needed"),
        (lambda: guards.require_positive("radius", 10**400), f"radius 1{'0' * 59}: a finite number above 0 is needed"),
        (lambda: guards.require_positive("radius", "2"), "radius '2': a finite number above 0 is needed"),
        (lambda: guards.require_positive("radius", 1j), "radius 1j: a finite number above 0 is needed"),
        (lambda: guards.require("x", 0.5, least=0.0, below=0.5), "x 0.5: a finite number at least 0 and below 0.5 is needed"),
        (lambda: guards.require_count("cells", 2.5), "cells 2.5: a whole number is needed"),
        (lambda: guards.require_choice("form", "odd", ("a", "b")), "form 'odd': 'a' or 'b' is needed"),
        (lambda: guards.require_values("t", [0.0, math.nan], "s"), "t[1] nan s: a finite number is needed"),
        (lambda: guards.require_values("t", [0.0, 2.0, 2.0], rising=True), "t[2] 2.0: rising numbers are needed"),
        (lambda: guards.require_values("p", [[1.0], [-1.0]], "Pa", least=0.0),
         "p[1, 0] -1.0 Pa: a finite number at least 0 is needed"),
        (lambda: guards.require_values("p", [1.0], shape=(None, 3)), "p: shape (1,), [any, 3] is needed"),
        (lambda: guards.require_values("p", ["a"]), "p ['a']: an array of numbers is needed"),
    ],
)  # fmt: skip
def test_a_refusal_names_what_was_given_and_what_is_allowed(call: object, sentence: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        call()  # type: ignore[operator]


def test_what_is_within_bounds_comes_back_as_a_float() -> None:
    for value in (2, numpy.float32(2.0), numpy.int64(2), Fraction(2), True + 1):
        assert guards.require("x", value, least=2.0, most=2.0) == 2.0
    assert guards.require_values("t", 3).shape == ()
    assert guards.require_values("t", [[1, 2], [3, 4]], shape=(None, 2)).dtype == numpy.float64
