"""The five papers, and how one, a figure, an equation or a system of it is found by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from importlib import import_module
from typing import Any

import numpy

from contact_sim_lab.records.paper import Drawn, Equation, Figure, Paper, PaperError, Parameter, System
from contact_sim_pkg.files import printable

__all__ = ["PAPERS", "equation_of", "evaluate", "figure_of", "load", "paper_of", "papers", "system_of", "values_of"]

PAPERS = {  # key -> module with its record PAPER
    "driver-seat": "driver_seat.paper",
    "contact-area": "contact_area.paper",
    "tire-road": "tire_road.paper",
    "rolling-contact": "rolling_contact.paper",
    "identifiability": "identifiability.paper",
}


def papers() -> list[Paper]:
    """All records."""
    return [paper_of(key) for key in PAPERS]


def paper_of(key: str) -> Paper:
    """The record of a paper; PaperError where there is none of this key."""
    if key not in PAPERS:
        raise PaperError(f"paper {printable(key)!r}: {_near(key, PAPERS)}")
    paper: Paper = import_module(f"contact_sim_lab.papers.{PAPERS[key]}").PAPER
    return paper


def figure_of(paper: Paper, number: str) -> Figure:
    """A figure by its number; PaperError where it shows no result of the bench."""
    found = {each.number: each for each in paper.figures}
    if number not in found:
        raise PaperError(
            f"{paper.key}, figure {printable(number)!r}: {_near(number, found)}. {paper.not_shown}".strip()
        )
    return found[number]


def equation_of(paper: Paper, number: str) -> Equation:
    """An equation by its number; PaperError where none is registered under it."""
    found = {each.number: each for each in paper.equations}
    if number not in found:
        raise PaperError(f"{paper.key}, equation {printable(number)!r}: {_near(number, found)}")
    return found[number]


def system_of(paper: Paper, name: str) -> System:
    """A system by its name; PaperError where the paper has none of this name."""
    found = {each.name: each for each in paper.systems if each.name}
    if name not in found:
        raise PaperError(f"{paper.key}, system {printable(name)!r}: {_near(name, found)}")
    return found[name]


def values_of(owner: str, parameters: Sequence[Parameter], given: Iterable[str]) -> dict[str, Any]:
    """Values of all parameters: the defaults, and what ``key=value`` texts set; PaperError for an unknown key, a value
    that is none, or one outside its range. ``owner`` takes them, as the user calls it.
    """
    known = {each.name: each for each in parameters}
    values: dict[str, Any] = {each.name: each.default for each in parameters}
    for text in given:
        key, equals, value = text.partition("=")
        if not equals:
            raise PaperError(f"--set {printable(text)!r}: KEY=VALUE is needed")
        if key not in known:
            raise PaperError(f"{owner}, --set {printable(key)!r}: {_near(key, known)}")
        values[key] = known[key].read(value)
    return values


def load(place: str) -> Any:
    """What stands at ``module:name``."""
    module, _, name = place.partition(":")
    return getattr(import_module(module), name)


def evaluate(equation: Equation, values: Mapping[str, Any]) -> dict[str, Any]:
    """Results of an equation by name: floats, truths, texts or lists of floats; PaperError where its function refuses."""
    call = equation.call or load(equation.place)
    arguments = {
        key: numpy.array(value, dtype=float) if isinstance(value, tuple) else value for key, value in values.items()
    }
    try:
        answer = call(**arguments)
    except (ValueError, ArithmeticError) as error:
        lists = {key: len(value) for key, value in values.items() if isinstance(value, tuple)}
        said = str(error)
        if "broadcast" in said and len(set(lists.values())) > 1:
            said = f"{', '.join(f'{key} has {count}' for key, count in lists.items())} values; give lists of the same length"
        raise PaperError(f"equation {equation.number}: {said}") from error
    parts = answer if isinstance(answer, tuple) else (answer,)
    return {name: _plain(part) for (name, _), part in zip(equation.results, parts, strict=True)}


def drawn(figure: Figure, values: Mapping[str, Any]) -> Drawn:
    """A figure computed with these values; PaperError where what it shows refuses them."""
    try:
        return figure.compute(values)
    except PaperError:
        raise
    except (ValueError, ArithmeticError) as error:
        raise PaperError(f"figure {figure.number}: {error}") from error


def _plain(value: Any) -> Any:
    if isinstance(value, complex):
        return [value.real, value.imag]
    if hasattr(value, "tolist"):
        value = value.tolist()
    return float(value) if isinstance(value, int) and not isinstance(value, bool) else value


def _near(name: str, known: Iterable[str]) -> str:
    names = list(known)
    close = get_close_matches(name, names, n=1, cutoff=0.6)
    hint = f"did you mean {close[0]!r}? " if close else ""
    return f"unknown; {hint}{'There is ' + ', '.join(names) if names else 'There is none'}"
