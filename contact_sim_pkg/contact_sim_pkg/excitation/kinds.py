"""What every road and every vibration is: the section of a scene that makes its surface or signal, and
answers what others ask of it. Nobody compares the name of a kind.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

from contact_sim_pkg.excitation.blocks import Signal, Surface
from contact_sim_pkg.records.breach import Breach
from contact_sim_pkg.records.fields import Section, number, text
from contact_sim_pkg.records.registry import kinds
from contact_sim_pkg.records.rig import load

__all__ = [
    "Kind", "Obstacle", "RoadKind", "Setting", "VibrationKind", "Wave", "kind_known", "kind_of", "sha256_key",
]  # fmt: skip


class Setting(NamedTuple):
    """The run that a kind makes its surface or signal for."""

    seed: int
    duration: float  # [s]
    accuracy: float  # requested relative error
    file: Path | None  # of its key `file`, the checksum checked
    cell: float = 0.0  # [m] finest spacing at which a surface is asked
    unused: str = ""  # axes, of x and z, whose vibration moves nothing


class Kind(Section):
    """A section whose key `kind` says which class it is.

    A key `file`, beside `sha256`, names an input file: it is looked for, bounded in size, checked
    against the checksum and handed over as `Setting.file`.
    """

    fixed: ClassVar[str] = (
        "another form would jump under the wheel, or on the floor; what scales it is live where there is such a key"
    )

    largest_file: ClassVar[int] = 256 << 20
    """[bytes]"""

    kind: str

    def input_file(self) -> tuple[str, str | None] | None:
        """Name of the file that it reads, and the checksum that the scene states; None: it reads none."""
        keys = vars(self)
        return (keys["file"], keys.get("sha256")) if "file" in keys else None

    def file_memory(self, path: Path) -> int:
        """Memory in [bytes] that reading its file takes."""
        return path.stat().st_size

    def memory(self) -> tuple[str, int]:
        """What it makes beside, in words that end with `needs`, and the memory of it in [bytes]."""
        return "", 0

    def breaches(self, duration: float) -> Iterator[Breach]:
        """Rules between its keys, and with the `duration` [s] of the run, that do not hold."""
        yield from ()


class Wave(NamedTuple):
    """The shortest wave of a road, or the shortest part of an obstacle."""

    length: float  # [m]
    height: float  # [m] root mean square of the waves below the length that was asked for, or of the obstacle
    words: str
    """up to `shorter than`, behind which a length follows"""
    curvature: float = 0.0  # [1/m] largest of a smooth obstacle


class Obstacle(NamedTuple):
    """What rises out of an even road, or lies below it, across the whole track."""

    position: float  # [m] of its middle
    length: float  # [m] along the road, flanks included
    height: float  # [m] negative: downwards
    flank: float  # [m] from its foot to its height; 0: a sharp edge
    has_corners: bool = True  # whether the slope changes at once at the ends of its flanks
    ends: bool = True  # whether the road comes back to its height
    flank_key: str = "length"  # by which its flanks are made longer
    period: float | None = None  # [m] to the next equal one


class RoadKind(Kind):
    """A road under a wheel. What a kind does not answer holds for a road with waves of unknown length."""

    is_even: ClassVar[bool] = False

    @abstractmethod
    def surface(self, setting: Setting) -> Surface:
        """Its heights. Raises ExcitationError."""

    def shortest_wave(self, limit: float) -> Wave | None:
        """Its shortest wave, and the height of those below ``limit`` [m]; None: it has no waves."""
        return Wave(0.0, float("inf"), "the road may have waves shorter than")

    def is_reached(self, first: float, last: float) -> bool:
        """Whether a wheel that touches the road from ``first`` to ``last`` [m] comes to what it has."""
        return True

    def obstacle(self) -> Obstacle | None:
        """The obstacle that the road is; None: it is another road."""
        return None

    @property
    def condition(self) -> str:
        """What it is, for the bands of metrics that hold on some roads."""
        return self.kind


class VibrationKind(Kind):
    """An acceleration of the floor."""

    sample_rate: float = number(
        10.0, 1e5, "Hz", "samples a second sent to the rig, joined by straight lines", default=1000.0
    )

    @abstractmethod
    def signal(self, setting: Setting) -> Signal:
        """Its acceleration. Raises ExcitationError."""

    is_shock: ClassVar[bool] = False
    """Whether it is one event at an instant, so that means over the run say how long the run is."""

    @property
    def axes(self) -> str:
        """Axes, of x and z, along which it may shake."""
        return "xz"

    def strength(self) -> float | None:
        """Amplitude, or root mean square, along its axes [m/s^2]; None: the signal has to be looked at."""
        return None

    @property
    def period(self) -> float | None:
        """[s] of its cycles; None: it has none."""
        return None


def kind_of(section: str, data: Mapping[str, Any] | None) -> Any:
    """The `road` or `vibration` of plain data; None where there is none. ValueError: they fit no kind."""
    if data is None:
        return None
    known = kinds(section)
    if data.get("kind") not in known:
        raise ValueError(f"{section}.kind is {data.get('kind')!r:.40}, it must be one of {', '.join(known)}")
    return load(known[data["kind"]]).model_validate(data)


def kind_known(section: str, data: object) -> Any:
    """As `kind_of` for the scene of any bag; None also where its kind is not there, or has other keys."""
    try:
        return kind_of(section, data) if isinstance(data, Mapping) else None
    except (TypeError, ValueError):
        return None


def sha256_key() -> Any:
    """The key `sha256` beside `file`."""
    return text("checksum of the file; other content is refused", default=None, pattern="^[0-9a-f]{64}$")
