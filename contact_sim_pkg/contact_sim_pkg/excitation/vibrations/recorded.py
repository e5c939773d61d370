"""A recorded acceleration; what reads its file is loaded when the signal is made."""

from collections.abc import Iterator
from pathlib import Path
from typing import Literal, TypeAlias

from contact_sim_pkg.excitation.blocks import Signal
from contact_sim_pkg.excitation.kinds import Setting, VibrationKind, sha256_key
from contact_sim_pkg.files import BAG_ENDINGS
from contact_sim_pkg.records.breach import Breach
from contact_sim_pkg.records.fields import choice, given, number, text

Beyond: TypeAlias = Literal["refuse", "zero", "repeat"]
TimeUnit: TypeAlias = Literal["s", "ms", "us", "ns"]
AccelerationUnit: TypeAlias = Literal["m/s^2", "g", "mg"]


class RecordedSection(VibrationKind):
    """A recorded acceleration (CSV), its mean (gravity, bias) taken off; give `rate` or
    `time_column`.

    An axis that moves nothing in the scene (upwards at a seat back, forward under a seat without
    friction) needs no column.
    """

    kind: Literal["recorded"]
    file: str = text(
        "file name, from the scene file's folder; data/… also finds the files of the package",
        longest=500,
        example="floor.csv",
    )
    sha256: str | None = sha256_key()
    rate: float | None = number(1.0, 1e6, "Hz", "sampling rate of the file; never guessed", default=None)
    time_column: str | None = text(
        "column of time; a column of dates and one of times of day: DATE+TIME", default=None, longest=200
    )
    time_unit: TimeUnit | None = choice(
        "unit of the time column; null: as the file says, times since 1970 by their size, else s", default=None
    )
    header_line: int | None = number(
        1, 10_000, "1", "line of the column names; null: the first that is no comment", default=None
    )
    vertical_column: str = text("column of the upward acceleration in m/s²", default="z", longest=100)
    forward_column: str = text("column of the forward acceleration in m/s²", default="x", longest=100)
    lateral_column: str = text(
        "column of the acceleration to the left; needed to correct a tilt", default="y", longest=100
    )
    unit: AccelerationUnit | None = choice(
        "unit of the accelerations where the header has none; null: m/s^2, refused if gravity contradicts it",
        default=None,
    )
    start: float = number(0.0, 1e6, "s", "start of the run in the file", default=0.0)
    beyond: Beyond = choice("beyond the end of the file: refused, no vibration, or repeated", default="refuse")
    correct_tilt: bool = choice("rotate the sensor axes so that the mean acceleration is vertical", default=False)

    def signal(self, setting: Setting) -> Signal:
        """See VibrationKind."""
        from contact_sim_pkg.excitation.recorded import RecordedVibration

        recording = RecordedVibration(
            given(setting.file), self.rate, self.vertical_column, self.forward_column, time=self.time_column,
            tilt="correct" if self.correct_tilt else "keep", beyond=self.beyond, start=self.start,
            sample_rate=self.sample_rate, unused=setting.unused, unit=self.unit, lateral=self.lateral_column,
            time_unit=self.time_unit, header_line=self.header_line,
        )  # fmt: skip
        recording.refuse_longer_run(setting.duration)
        return recording

    def file_memory(self, path: Path) -> int:
        """See Kind."""
        from contact_sim_pkg.excitation.table_files import memory_needed

        return memory_needed(path)

    def breaches(self, duration: float) -> Iterator[Breach]:
        """See Kind."""
        if self.rate is not None or self.time_column is not None or self.file.endswith(BAG_ENDINGS):
            return  # the messages of a bag have stamps
        sentence = (
            "is missing; give the file's sampling rate in Hz, or its time_column where it has one (nothing is guessed)"
        )
        yield Breach("vibration.rate", sentence, ("vibration.time_column",))


KIND = RecordedSection
