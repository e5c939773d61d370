"""One bracketed root search for all of the impact model."""

from __future__ import annotations

from collections.abc import Callable

from contact_sim_pkg.compiled.guards import require, require_positive

__all__ = ["bracketed_root"]

ITERATIONS = 200


def bracketed_root(function: Callable[[float], float], low: float, high: float, relative: float = 4.0e-16) -> float:
    """Where `function` changes its sign between `low` and `high`: regula falsi (Illinois), with
    bisection.

    Ends where the bracket is `relative`, dimensionless, of its ends. Raises ArithmeticError where
    the ends have the same sign, ValueError for ends that are not finite and where the function is
    not a number at one of them.
    """
    low, high = require("low end", low), require("high end", high)
    require_positive("relative resolution", relative)
    # Both ends, with a change of sign between them.
    low_value, high_value = function(low), function(high)
    for end, value in ((low, low_value), (high, high_value)):
        require(f"function at {end:g}:", value, infinite=True)
    if low_value == 0.0 or high_value == 0.0:
        return low if low_value == 0.0 else high
    if (low_value > 0.0) == (high_value > 0.0):
        raise ArithmeticError(f"no change of sign between {low:g} and {high:g}")
    # Regula falsi (Illinois), every eighth time bisection.
    kept = 0
    for i in range(ITERATIONS):
        width = high - low
        resolution = relative * max(abs(low), abs(high))
        if abs(width) <= resolution:
            break
        middle = high - high_value * width / (high_value - low_value)
        inside = min(low, high) < middle < max(low, high)
        if not inside or i % 8 == 7:
            middle = low + 0.5 * width
        # Not nearer to an end than half the resolution.
        if abs(middle - low) < 0.5 * resolution or abs(high - middle) < 0.5 * resolution:
            step = 0.5 * resolution if width > 0.0 else -0.5 * resolution
            middle = low + step if abs(middle - low) < abs(high - middle) else high - step
        value = function(middle)
        if value == 0.0:
            return middle
        if (value > 0.0) == (high_value > 0.0):
            high, high_value = middle, value
            low_value *= 0.5 if kept == 1 else 1.0
            kept = 1
        else:
            low, low_value = middle, value
            high_value *= 0.5 if kept == -1 else 1.0
            kept = -1
    return low if abs(low_value) < abs(high_value) else high
