"""Misspelt names of launch arguments and parameters, which ROS itself ignores."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

__all__ = ["misspelt"]


def misspelt(given: Iterable[str], known: Iterable[str]) -> dict[str, str]:
    """Each given name that is not known and resembles one that is, with that one."""
    names = list(known)
    found = {name: get_close_matches(name, names, n=1, cutoff=0.75) for name in given if name not in names}
    return {name: near[0] for name, near in found.items() if near}
