"""Vibrations of the floor: sine, sweep, noise, half-sine shock, recorded file."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.scene.schema.fields import Section, choice, number, text

Axis: TypeAlias = Literal["x", "z"]
Beyond: TypeAlias = Literal["refuse", "zero", "repeat"]
HIGHEST = 1e4
SHARPEST = 1000.0


def _sample_rate() -> float:
    sample_rate: float = number(
        10.0, 1e5, "Hz", "samples a second sent to the rig, joined by straight lines", default=1000.0
    )
    return sample_rate


def _axis() -> Axis:
    axis: Axis = choice("direction: z up, x forward", default="z")
    return axis


def _frequency(meaning: str, example: float) -> float:
    frequency: float = number(0.0, HIGHEST, "Hz", meaning, above=True, example=example)
    return frequency


def _acceleration(meaning: str) -> float:
    acceleration: float = number(0.0, SHARPEST, "m/s²", meaning, example=1.0)
    return acceleration


class SineSection(Section):
    """A sine: amplitude · sin(2π frequency t)."""

    kind: Literal["sine"]
    frequency: float = _frequency("frequency", 4.0)
    amplitude: float = _acceleration("amplitude of the acceleration")
    axis: Axis = _axis()
    sample_rate: float = _sample_rate()


class SweepSection(Section):
    """A sine of rising or falling frequency, logarithmic in time; `octaves_per_minute` or
    `duration`.
    """

    kind: Literal["sweep"]
    start_frequency: float = _frequency("frequency at the start", 0.5)
    end_frequency: float = _frequency("frequency at the end", 20.0)
    amplitude: float = _acceleration("amplitude of the acceleration")
    octaves_per_minute: float | None = number(
        0.0, 6000.0, "1/min", "rate of the sweep; 1 is usual", above=True, default=None
    )
    duration: float | None = number(
        0.001, 3600.0, "s", "time from the start frequency to the end frequency", default=None
    )
    axis: Axis = _axis()
    sample_rate: float = _sample_rate()


class NoiseSection(Section):
    """Gaussian noise of constant spectral density between two frequencies; drawn from `seed`."""

    kind: Literal["noise"]
    low: float = _frequency("lowest frequency", 0.5)
    high: float = _frequency("highest frequency", 20.0)
    rms: float = _acceleration("root mean square of the acceleration")
    axis: Axis = _axis()
    sample_rate: float = _sample_rate()


class HalfSineSection(Section):
    """One shock: half a sine of acceleration."""

    kind: Literal["half_sine"]
    amplitude: float = number(
        -SHARPEST, SHARPEST, "m/s²", "peak of the acceleration; negative is downwards or backwards", example=10.0
    )
    duration: float = number(1e-4, 10.0, "s", "length of the shock", example=0.05)
    start: float = number(0.0, 3600.0, "s", "start of the shock", default=0.5)
    axis: Axis = _axis()
    sample_rate: float = _sample_rate()


TimeUnit: TypeAlias = Literal["s", "ms", "us", "ns"]
AccelerationUnit: TypeAlias = Literal["m/s^2", "g", "mg"]


class RecordedSection(Section):
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
    sha256: str | None = text("checksum of the file; other content is refused", default=None, pattern="^[0-9a-f]{64}$")
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
    sample_rate: float = _sample_rate()


Vibration: TypeAlias = Annotated[
    SineSection | SweepSection | NoiseSection | HalfSineSection | RecordedSection, Field(discriminator="kind")
]
