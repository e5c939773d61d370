"""What a test machine runs over time: load, deflection, slips, speed, inflation."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, NamedTuple, TypeAlias

from pydantic import Field

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.kinds import sha256_key
from contact_sim_pkg.records.breach import Breach, show
from contact_sim_pkg.records.fields import Section, number, numbers, text
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.schema.places import find_file

if TYPE_CHECKING:
    from contact_sim_pkg.excitation.recorded_csv import RecordedTable
    from contact_sim_pkg.scene.schema.scene import Scene

__all__ = ["COLUMNS", "PROGRAMME", "TireProgramme", "row_breaches"]

MOST_ROWS = 10000
PROGRAMME = "tire.programme"


class Quantity(NamedTuple):
    """What a column may hold."""

    unit: str
    low: float
    high: float
    names: tuple[str, ...] = ()  # in a file


TIME = Quantity("s", 0.0, 3600.0)
COLUMNS = {
    "load": Quantity("N", 0.0, 1e6, ("load", "fz", "normal_force", "vertical_force", "fzh", "fzw")),
    "deflection": Quantity("m", -0.1, 0.1, ("deflection",)),
    "slip": Quantity("1", -1.0, 10.0, ("slip", "longitudinal_slip", "kappa", "longslip")),
    "slip_angle": Quantity("rad", -1.5, 1.5, ("slip_angle", "alpha", "angle", "slipangl")),
    "speed": Quantity("m/s", 0.0, 100.0, ("speed", "velocity", "v", "trajvelw", "trajvelh")),
}


def _column(of: Quantity, meaning: str) -> Any:
    allowed = f"2 to {MOST_ROWS} numbers, each {show(of.low)} to {show(of.high)} {of.unit.replace('1', '')}".rstrip()
    return numbers(of.unit, meaning, allowed, default=None, shortest=2, longest=MOST_ROWS)


def _each(of: Quantity) -> Any:
    return Field(ge=of.low, le=of.high)


Instant: TypeAlias = Annotated[float, _each(TIME)]
Load: TypeAlias = Annotated[float, _each(COLUMNS["load"])]
Deflection: TypeAlias = Annotated[float, _each(COLUMNS["deflection"])]
SlipValue: TypeAlias = Annotated[float, _each(COLUMNS["slip"])]
Angle: TypeAlias = Annotated[float, _each(COLUMNS["slip_angle"])]
Speed: TypeAlias = Annotated[float, _each(COLUMNS["speed"])]

CAMBER = ("camber", "gamma", "inclination", "inclination_angle", "inclangl")
INFLATION = ("inflation", "inflation_pressure", "pressure", "inflpres")
STEADY = 0.01  # part of an inflation within which it stays
ONE_INFLATION = (
    "a run has one inflation; set effects.tire.inflation.pressure, or change it between blocks by a steered run"
)
NO_CAMBER = "the law has no camber, the tread stands upright on the road; leave the column out"


class TireProgramme(Section):
    """What the machine runs over time, straight between the rows, constant before the first and behind the last: columns of
    numbers, or a file of them.
    """

    fixed: ClassVar[str] = "a programme holds from the start"
    largest_file: ClassVar[int] = 16 << 20
    """[bytes]"""

    file: str | None = text(
        "table with a column time and columns of the names below, units in the header; from the scene file's folder",
        default=None, longest=500, example="sweep.csv",
    )  # fmt: skip
    sha256: str | None = sha256_key()
    header_line: int | None = number(
        1, 10_000, "1", "line of the column names; null: the first that is no comment", default=None
    )
    time: list[Instant] | None = _column(TIME, "time of each row, increasing")
    load: list[Load] | None = _column(COLUMNS["load"], "load of the servo, in place of mount.load")
    deflection: list[Deflection] | None = _column(COLUMNS["deflection"], "of a held axle, in place of mount.deflection")
    slip: list[SlipValue] | None = _column(COLUMNS["slip"], "longitudinal slip, as slip.longitudinal")
    slip_angle: list[Angle] | None = _column(COLUMNS["slip_angle"], "slip angle, as slip.angle")
    speed: list[Speed] | None = _column(COLUMNS["speed"], "speed, as travel.speed")

    def open_values(self, scene: Scene) -> dict[str, Any]:
        return {} if self.file is None or self.time is not None else self.columns(scene)

    def input_file(self) -> tuple[str, str | None] | None:
        """Name of the file that it reads, and the checksum that the scene states; None: it has its columns."""
        return None if self.file is None or self.time is not None else (self.file, self.sha256)

    def file_memory(self, path: Path) -> int:
        """Memory in [bytes] that reading its file takes."""
        from contact_sim_pkg.excitation.table_files import memory_needed

        return memory_needed(path)

    def columns(self, scene: Scene) -> dict[str, list[float]]:
        """Time and the quantities that it has, [rows] each in SI units, read from the file where the scene does not hold
        them. Raises SceneError with the sentence of the file, or where it is not there.
        """
        if self.file is None or self.time is not None:
            return {name: getattr(self, name) for name in ("time", *COLUMNS) if getattr(self, name) is not None}
        path = find_file(self.file, Path(scene.file).parent)
        if path is None:
            raise SceneError([Fault(scene.file, 1, 1, f"{PROGRAMME}.file", f"the file {self.file!r} is not there")])
        try:
            return read_programme(path, self.header_line)
        except ExcitationError as error:
            raise SceneError([Fault(scene.file, 1, 1, f"{PROGRAMME}.file", str(error))]) from None

    def pairs(self, scene: Scene, *names: str) -> list[list[float]] | None:
        """Rows of the time and of quantities, 0 where one is not among them; None without any of them, no row where the time is
        missing, which is refused.
        """
        found = self.columns(scene)
        if not any(name in found for name in names):
            return None
        if "time" not in found:
            return []
        zeros = [0.0] * len(found["time"])
        # columns of unlike length are refused
        return [list(row) for row in zip(found["time"], *(found.get(name, zeros) for name in names), strict=False)]

    def file_fault(self, scene: Scene) -> str:
        """What is wrong with the content of a file that is there; empty: nothing is."""
        try:
            columns = self.columns(scene)
        except SceneError as error:
            return error.faults[0].sentence
        beyond = next(_beyond(columns), "")
        return beyond or next((each.sentence for each in row_breaches(columns)), "")


def _beyond(columns: dict[str, list[float]]) -> Iterator[str]:
    """Numbers of a file outside their range."""
    for name, values in columns.items():
        of = COLUMNS.get(name, TIME)
        if not 2 <= len(values) <= MOST_ROWS:
            yield f"it has {len(values)} rows, 2 to {MOST_ROWS} are allowed"
        for row, value in enumerate(values, 1):
            if not of.low <= value <= of.high:
                yield f"{name} of row {row} is {show(value)} {of.unit}, outside {show(of.low)} to {show(of.high)} {of.unit}"


def read_programme(path: Path, header_line: int | None) -> dict[str, list[float]]:
    """Time [s] and the quantities of a table, [rows] each in SI units.

    Args:
        path: of the file, any table that a recording may be, with names as of `COLUMNS`.
        header_line: number of the line that names the columns; None: the first that is no comment.

    Raises:
        ExcitationError: no time, no quantity, a camber, an inflation that changes, or a column without a unit that fits,
            with the cure.
    """
    from contact_sim_pkg.excitation.table_files import read_recording  # numpy and libraries

    table = read_recording(path, header_line, section=PROGRAMME)
    time, _said = table.time(None)
    if time is None:
        raise ExcitationError(f"{path}: there is no column time; the header names {', '.join(table.columns)}")
    found = {"time": time.tolist()}
    for name in table.columns:
        _refuse_unknown(path, name, table)
        quantity = next((each for each, of in COLUMNS.items() if name in of.names), None)
        if quantity is None:
            continue
        unit = COLUMNS[quantity].unit
        if quantity in found:
            raise ExcitationError(f"{path}: column '{name}' gives the {quantity} a second time; keep one")
        given = table.units.get(name, "1" if unit == "1" else "")
        if given != unit:
            raise ExcitationError(
                f"{path}: column '{name}' has no unit that fits; write it behind the name, as {name} [{unit}]"
            )
        found[quantity] = table.column(name).tolist()
    if len(found) == 1:
        raise ExcitationError(
            f"{path}: there is no column {', '.join(COLUMNS)}; the header names {', '.join(table.columns)}"
        )
    return found


def _refuse_unknown(path: Path, name: str, table: RecordedTable) -> None:
    """A column that asks for what a run does not do; one that stays as it is asks for nothing."""
    if name in CAMBER and table.column(name).any():
        raise ExcitationError(f"{path}: column '{name}': {NO_CAMBER}")
    if name in INFLATION:
        values = table.column(name)
        low, high = float(values.min()), float(values.max())
        if high - low > STEADY * abs(high):
            raise ExcitationError(f"{path}: column '{name}' goes from {show(low)} to {show(high)}: {ONE_INFLATION}")


def row_breaches(columns: dict[str, list[float]]) -> Iterator[Breach]:
    """Times that do not rise, columns of another length."""
    time = columns["time"]
    for index, (before, after) in enumerate(pairwise(time), start=1):
        if not after > before:
            sentence = (
                f"{show(after)} s does not come after {show(before)} s; times must rise, change it or leave it out"
            )
            yield Breach(f"{PROGRAMME}.time.{index}", sentence)
    if time[0] != 0.0:
        yield Breach(f"{PROGRAMME}.time.0", f"the first time is {show(time[0])} s; it must be 0")
    for name, column in columns.items():
        if len(column) != len(time):
            sentence = f"has {len(column)} numbers, time has {len(time)}; give one for each time"
            yield Breach(f"{PROGRAMME}.{name}", sentence, (f"{PROGRAMME}.time",))
