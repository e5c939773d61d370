"""Records of a paper: what it models, its systems, figures, equations and errata.

A figure is a record of runs of shipped scenes or functions: it holds numbers, each beside an
expected value of another origin, and a drawing. An equation names the shipped function that
evaluates it; neither holds a formula of its own.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from contact_sim_pkg.compiled.guards import require
from contact_sim_pkg.files import RefusedError, printable

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = [
    "JUDGED",
    "NO_REFERENCE",
    "SHAPE_ONLY",
    "Drawn",
    "Equation",
    "Erratum",
    "Figure",
    "Number",
    "Paper",
    "PaperError",
    "Parameter",
    "System",
    "SystemResult",
    "Values",
]

Values = Mapping[str, Any]
"""Values of parameters by name: float, int, text or a tuple of floats."""

JUDGED, SHAPE_ONLY, NO_REFERENCE = "judged", "shape only", "no reference"
ROUNDING = 1e-12
"""A difference below it is that of machines, not of models."""


class PaperError(RefusedError, ValueError):
    """A request that no paper answers; the message names the value and what is allowed."""


class Parameter(NamedTuple):
    """A number that the user may set. A default that is a tuple takes a list, one that is a text a choice."""

    name: str
    unit: str
    """empty where it is dimensionless"""
    default: float | int | str | tuple[float, ...]
    above: float = -math.inf
    least: float = -math.inf
    below: float = math.inf
    most: float = math.inf
    infinite: bool = False
    choices: tuple[str, ...] = ()
    help: str = ""

    def read(self, text: str) -> Any:
        """The value of a text; PaperError where it is none or outside the range."""
        if isinstance(self.default, str):
            if text not in self.choices:
                raise PaperError(f"{self.name} {printable(text)!r}: one of {', '.join(self.choices)} is needed")
            return text
        if isinstance(self.default, tuple):
            return tuple(self._number(part) for part in text.strip("[] ").split(","))
        number = self._number(text)
        if isinstance(self.default, int):
            if number != int(number):
                raise PaperError(f"{self.name} {printable(text)!r}: a whole number is needed")
            return int(number)
        return number

    def _number(self, text: str) -> float:
        try:
            number = float(text)
        except ValueError:
            raise PaperError(f"{self.name} {printable(text)!r}: a number is needed") from None
        return require(
            self.name, number, self.unit, above=self.above, least=self.least, below=self.below, most=self.most,
            infinite=self.infinite, error=PaperError,
        )  # fmt: skip

    @property
    def range(self) -> str:
        """The valid range as text."""
        if self.choices:
            return ", ".join(self.choices)
        low = f"> {self.above:g}" if self.above > -math.inf else f"≥ {self.least:g}" if self.least > -math.inf else ""
        high = f"< {self.below:g}" if self.below < math.inf else f"≤ {self.most:g}" if self.most < math.inf else ""
        return f"{low}, {high}".strip(", ") or "any"


class Equation(NamedTuple):
    """A formula of the paper and the shipped function that evaluates it."""

    number: str
    """as the paper counts, such as `41` or `10a`"""
    title: str
    formula: str
    place: str
    """``module:function`` that holds it"""
    parameters: tuple[Parameter, ...]
    results: tuple[tuple[str, str], ...]
    """name and unit of each value that the call returns"""
    call: Callable[..., Any] | None = None
    """takes the parameters by name and calls `place`; None: `place` takes them itself"""
    source: str = ""
    """where it is no equation of the paper itself: the book or paper with its number"""


class Number(NamedTuple):
    """A number of a figure: obtained from the bench, expected from elsewhere."""

    what: str
    unit: str
    obtained: float | None
    expected: float | None
    tolerance: float
    """at most three times the error of discretisation, or what the digits of the print resolve"""
    origin: str
    """of the expected value; never the bench itself"""
    relative: bool = False
    """whether the tolerance is a part of the expected value"""
    note: str = ""
    is_input: bool = False
    """whether the scene was given the value: it shows that it arrives, and nothing of the physics"""

    @property
    def difference(self) -> float | None:
        """Obtained minus expected, divided by it where the tolerance is relative: infinite where nothing is expected
        and something is obtained.
        """
        if self.obtained is None or self.expected is None:
            return None
        missed = self.obtained - self.expected
        if not self.relative or missed == 0.0:
            return missed
        return missed / abs(self.expected) if self.expected else math.copysign(math.inf, missed)

    def shown_difference(self, digits: int) -> str:
        """For a page that has the same bytes on every machine: what is rounding is `<1e-12`."""
        if self.difference is None:
            return ""
        if self.difference != 0.0 and abs(self.difference) < ROUNDING:
            return f"<{ROUNDING:g}"
        return f"{self.difference:.{digits}g}"

    @property
    def verdict(self) -> str:
        """`inside`, `OUTSIDE`, `input` where one was read back, `not reached` where nothing was obtained, `no reference`
        where nothing is expected.
        """
        if self.obtained is None:
            return "not reached"
        if self.difference is None:
            return NO_REFERENCE
        if not abs(self.difference) <= self.tolerance:
            return "OUTSIDE"
        return "input" if self.is_input else "inside"

    def row(self) -> dict[str, Any]:
        """As a row of a table."""
        return {
            "quantity": self.what, "unit": self.unit, "expected": self.expected, "obtained": self.obtained,
            "difference": self.difference, "tolerance": self.tolerance, "relative": self.relative, "verdict": self.verdict,
            "origin": self.origin, "note": self.note,
        }  # fmt: skip


class Drawn(NamedTuple):
    """A figure that was computed: its numbers, and what draws it on a canvas."""

    numbers: Sequence[Number]
    draw: Callable[[Canvas], None]
    size: tuple[float, float] = (7.0, 4.2)
    """of the canvas [inch]"""


class Figure(NamedTuple):
    """A figure of the paper."""

    number: str
    title: str
    made_by: tuple[str, ...]
    """scenes and ``module:function`` whose runs it shows"""
    judged_by: str
    compute: Callable[[Values], Drawn]
    kind: str = JUDGED
    """`JUDGED`, `SHAPE_ONLY` or `NO_REFERENCE`"""
    parameters: tuple[Parameter, ...] = ()
    note: str = ""


class SystemResult(NamedTuple):
    """What a system came to on the user's input."""

    rows: Sequence[Mapping[str, Any]]
    draw: Callable[[Canvas], None] | None = None
    note: str = ""
    size: tuple[float, float] = (7.0, 4.2)
    course: Sequence[Mapping[str, Any]] = ()
    """what the drawing shows, row by row, in a table of its own"""


class System(NamedTuple):
    """A system of the paper, and the command that reaches it."""

    title: str
    shows: tuple[tuple[str, str], ...]
    """equations, and where the command shows them: ``topic: columns`` of a run, the names of its output, the N of
    `--equation N`"""
    command: str
    """as the user types it"""
    name: str = ""
    """of `--system NAME`; empty where another command runs it"""
    run: str = ""
    """``module:function`` of `--system`: (input file or bag or None, values) -> `SystemResult`"""
    input: str = ""
    """what the file or bag holds, as text; empty: it takes none"""
    parameters: tuple[Parameter, ...] = ()

    @property
    def equations(self) -> str:
        """Their numbers, as text."""
        return ", ".join(equations for equations, _ in self.shows)


class Erratum(NamedTuple):
    """An error of the print."""

    equation: str
    printed: str
    corrected: str
    found: str
    """how it was found"""
    effect: str
    """on a number; or why it has none"""


class Paper(NamedTuple):
    """One of the five papers."""

    key: str
    short: str
    """title by which the pages cite it"""
    title: str
    authors: str
    year: str
    models: str
    """what it models, in a few sentences"""
    systems: tuple[System, ...]
    figures: tuple[Figure, ...]
    equations: tuple[Equation, ...]
    errata: tuple[Erratum, ...]
    not_shown: str = ""
    """figures without a result, and why"""
    left_open: tuple[str, ...] = ()
    """what the paper holds and the bench does not, with the reason"""

    @property
    def page(self) -> str:
        """Name of its page in `docs/papers`."""
        return f"{self.key}.md"
