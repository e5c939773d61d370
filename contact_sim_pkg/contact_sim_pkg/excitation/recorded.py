"""Recorded vibration: what a real accelerometer file carries is found, reported, and treated as the
user says.

Between samples the signal is band-limited: interpolation with 64 samples under a sinc windowed by
the 4-term Blackman-Harris window. At the recorded instants it gives the samples themselves; up to
0.85 of half the recording rate it is exact to 1e-4.
"""

from math import acos, degrees, sqrt
from pathlib import Path
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.judge import UNEVEN, Cures, judge_acceleration, judge_stamps
from contact_sim_pkg.excitation.recorded_csv import STANDARD_GRAVITY, RecordedTable
from contact_sim_pkg.excitation.recorded_units import signed_column
from contact_sim_pkg.excitation.table_files import read_recording
from contact_sim_pkg.excitation.table_words import bare_name

LARGEST_TIME = 1e11  # [s] a time column may count from 1970
RATE_AGREEMENT = 0.01  # stated and found rate may differ by this part
USUAL_FULL_SCALES = (1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 16.0)  # [g] of accelerometers, data-sheet values
SHORTEST_PLATEAU = 3  # equal extreme samples that no unclipped vibration gives but by chance
HALF_WIDTH = 32  # samples on each side of the interpolated instant
BEYOND = ("refuse", "zero", "repeat")

CURES = Cures(
    "vibration.unit: {}, or in the header, such as z [g]", "vibration.vertical_column: {}",
    "write vibration.time_unit: ms, us or ns where they are",
)  # fmt: skip
Array = NDArray[numpy.float64]


class Clipping(NamedTuple):
    """Samples of one axis at the end of the sensor's range."""

    samples: int
    value: float  # [m/s^2] the full scale, as recorded
    first_line: int
    longest_run: int  # samples in succession


class RecordedVibration:
    """A recording as a function of time, gravity and bias removed, t = 0 at `start` seconds into
    it.
    """

    def __init__(
        self,
        path: str | Path,
        rate: float | None = None,
        vertical: str = "z",
        forward: str | None = "x",
        lateral: str = "y",
        time: str | None = None,
        tilt: str = "keep",
        remove_bias: bool = True,
        clipped: str = "keep",
        full_scale: float | None = None,
        high_pass: float | None = None,
        beyond: str = "refuse",
        start: float = 0.0,
        sample_rate: float | None = None,
        unused: str = "",
        unit: str | None = None,
        time_unit: str | None = None,
        header_line: int | None = None,
    ) -> None:
        """Read, check and treat the recording.

        Args:
            path: text file, see recorded_csv.read_table; values in [m/s^2], or in `unit`. rate:
            sampling rate, [Hz]; None: from the time column. It is never guessed. vertical: column
            that points up; "-z" turns it round. forward: column that points forward; "-x" turns it
            round. None: no forward acceleration. lateral: column to the left; needed only to
            correct the tilt, else used for the tilt angle where it exists. time: time column, [s];
            None: a column named time, t or time_s where there is one. tilt: keep, or correct (turn
            the axes so that the mean lies along the vertical). remove_bias: take the mean of each
            axis (gravity and bias) off. clipped: keep (samples at full scale stay as they are), or
            refuse. full_scale: of the sensor, [m/s^2]; None: an extreme value that occurs
                three times in succession, or twice where it is a usual full scale (2, 4, 8, 16 g
                …).
            high_pass: corner frequency, [Hz], of a zero-phase high-pass with the gain 1 / (1 +
            (corner / f)^8); None:
                no filter.
            beyond: after the end of the recording: refuse, zero, or repeat. start: time in the
            recording at t = 0, [s]. sample_rate: rate at which it will be sampled, [Hz]; below the
            recording's rate, frequencies above half of
                it are removed first (cosine flank from 0.4 to 0.5 of it). None: as fast as recorded
                or faster.
            unused: axes, of x and z, whose column the file may lack: there is no acceleration along
            them then.

            unit: of the accelerations, m/s^2, g or mg, for columns whose unit the header does not
            name. None: m/s^2; a
                recording whose mean or rms says otherwise is refused.
            time_unit: of the time column, s, ms, us or ns; None: as the file says, else s. Where its stamps scatter, the
                samples are taken at them.
            header_line: line that names the columns, from 1; None: the first that is no comment.

        Raises:
            ExcitationError: bad file (with line), values beyond 1e5 m/s^2, no rate, stated and
            found rate that differ
                by more than 1 %, a vertical axis that points down, or by the choices above.
        """
        for name, choice, allowed in (
            ("tilt", tilt, ("keep", "correct")), ("clipped", clipped, ("keep", "refuse")), ("beyond", beyond, BEYOND)
        ):  # fmt: skip
            if choice not in allowed:
                raise ExcitationError(f"{path}: {name} is '{choice}'; allowed: {', '.join(allowed)}")
        self.path, self.tilt, self.beyond, self.high_pass, self.start = Path(path), tilt, beyond, high_pass, start
        self.sample_rate = sample_rate
        self._notes: list[str] = []
        self._uneven = False
        # Columns, rate and units.
        table = read_recording(self.path, header_line)
        stamps, said = table.time(time, time_unit)
        self._notes += [*table.notes, *([said] if said else [])]
        self.rate = self._settle_rate(table, rate, stamps)
        self.remove_bias = remove_bias
        names = _columns(table, {"x": forward, "y": lateral, "z": vertical}, needed=tilt == "correct", unused=unused)
        raw = {axis: signed_column(table, name, unit, axis) for axis, name in names.items()}
        self._unit_assumed = unit is None and not all(
            bare_name(name.removeprefix("-")) in table.with_unit for name in names.values()
        )
        self._judge(table, raw, names)
        # Section that is used.
        self.samples = len(table.lines)
        self.duration = self.samples / self.rate
        if not 0.0 <= start < self.duration:
            raise ExcitationError(
                f"{path}: start is {start} s; allowed: 0 to below the recording's {self.duration:g} s"
            )
        # Clipping is looked for in the samples as recorded
        self.clipping = {axis: _find_clipping(table, raw[axis], full_scale) for axis in ("x", "z") if axis in raw}
        self._report_clipping(names, clipped)
        self._remove_gravity(self._at_stamps(raw, stamps), names)

    def _judge(self, table: RecordedTable, raw: dict[str, Array], names: dict[str, str]) -> None:
        """Refuse values in another unit, and gravity on another axis than the vertical column."""
        judged = judge_acceleration(raw, self.rate, table.file, CURES, unit=None if self._unit_assumed else "m/s^2")
        axis = judged.up.removeprefix("-")
        if axis not in ("", "z") and judged.up:
            sign = "-" if judged.up.startswith("-") is not names[axis].startswith("-") else ""
            column = f"{sign}{names[axis].removeprefix('-')}"
            raise ExcitationError(
                f"{table.file}: gravity lies on {names[axis]} (mean {raw[axis].mean():.4g} m/s^2), not on {names.get('z', 'z')}; "
                f"name the axis that points up ({CURES.up.format(column)})"
            )
        if judged.unknown:
            axis, said = next(iter(judged.unknown.items()))
            raise ExcitationError(
                f"{table.file}: column {names[axis]!r}: {said}; fill the gap or cut the recording there"
            )
        warned = ("the sensor turns", "failed reads", "frozen")
        self._notes += [f"WARNING: {said}." for said in judged.faults if said.startswith(warned)]

    def _at_stamps(self, raw: dict[str, Array], stamps: Array | None) -> dict[str, Array]:
        """Evenly spaced samples of what was sampled at stamps that scatter, by a spline of degree 5 through them."""
        if stamps is None or not self._uneven:
            return raw
        from scipy.interpolate import make_interp_spline  # takes 0.2 s

        even = stamps[0] + numpy.arange(len(stamps)) * ((stamps[-1] - stamps[0]) / (len(stamps) - 1))
        return {
            axis: make_interp_spline(stamps, values, k=min(5, len(stamps) - 1))(even) for axis, values in raw.items()
        }

    def _settle_rate(self, table: RecordedTable, stated: float | None, time: Array | None) -> float:
        if stated is not None and not 1e-3 <= stated <= 1e6:
            raise ExcitationError(f"{table.file}: the stated rate is {stated} Hz; allowed: 0.001 to 1e6 Hz")
        if stated is not None and table.nominal_rate is not None:
            self._compare(stated, table, table.nominal_rate, "a comment in the file")
        if time is None:
            if stated is None:
                raise ExcitationError(
                    f"{table.file}: the file has no time column, so its sampling rate must be stated "
                    "(vibration.rate, or --rate); it is never guessed"
                )
            self._notes.append(
                f"The rate of {stated:g} Hz is as stated; the file has no time column to compare it with."
                if table.nominal_rate is None
                else f"The rate of {stated:g} Hz is as stated; a comment in the file says so too."
            )
            return stated
        # Two statements of the rate must agree
        found, scatter = _found_rate(table, time)
        self._uneven = scatter > UNEVEN
        if self._uneven:
            self._notes.append(f"The stamps scatter by {100.0 * scatter:.2g} % of the step: resampled by them.")
        if table.nominal_rate is not None:
            self._compare(table.nominal_rate, table, found, "the time column", "a comment states")
        if stated is None:
            self._notes.append(f"The rate of {found:.6g} Hz was derived from the time column.")
            return found
        self._compare(stated, table, found, "the time column")
        self._notes.append(f"The rate of {stated:g} Hz is as stated; the time column says {found:.6g} Hz.")
        return stated

    @staticmethod
    def _compare(
        stated: float, table: RecordedTable, found: float, source: str, states: str = "the stated rate is"
    ) -> None:
        if not abs(stated - found) <= RATE_AGREEMENT * found:
            raise ExcitationError(
                f"{table.file}: {states} {stated:g} Hz, {source} says {found:.6g} Hz; they must agree within 1 %"
            )

    def _report_clipping(self, names: dict[str, str], clipped: str) -> None:
        for axis, clipping in self.clipping.items():
            if clipping.samples == 0:
                continue
            sentence = (
                f"{clipping.samples} of {self.samples} samples of {names[axis]} lie at the full scale of "
                f"{clipping.value:.4g} m/s^2 (clipped; first "
                f"in line {clipping.first_line}, at most {clipping.longest_run} in succession)"
            )
            if clipped == "refuse":
                raise ExcitationError(f"{self.path}: {sentence}; keep them (clipped: keep) or take another recording")
            self._notes.append(f"{sentence}; kept as recorded.")

    def _remove_gravity(self, raw: dict[str, Array], names: dict[str, str]) -> None:
        """Bias, gravity and tilt: what the mean says, and what is done about it."""
        self.bias = {axis: float(values.mean()) for axis, values in raw.items()}
        total = sqrt(sum(value**2 for value in self.bias.values()))
        # Direction of gravity from the means of the axes.
        mean = self.bias.get("z", 0.0)
        if mean < -0.5 * STANDARD_GRAVITY:
            raise ExcitationError(
                f"{self.path}: the mean of {names['z']} is {mean:.4g} m/s^2, so this axis points down; name "
                "it with a minus sign or name another vertical axis"
            )
        self.tilt_angle = acos(mean / total) if mean > 0.5 * STANDARD_GRAVITY else None
        if self.tilt_angle is None:
            self._no_gravity(names.get("z"), mean)
        else:
            done = "corrected" if self.tilt == "correct" else "not corrected"
            self._notes.append(
                f"The mean is {total:.4g} m/s^2 (standard gravity {STANDARD_GRAVITY:.4g}) and "
                f"{degrees(self.tilt_angle):.3g} degrees off the vertical axis; the tilt was {done}."
            )
        # Axes made upright, means removed, then filtered.
        turned = _turn_upright(raw, self.bias) if self.tilt == "correct" else raw
        self._notes.append(
            "The mean of each axis (gravity and bias) was " + ("removed." if self.remove_bias else "not removed.")
        )
        self._acceleration = {
            axis: self._filtered(turned[axis] - self.remove_bias * turned[axis].mean())
            for axis in ("x", "z")
            if axis in turned
        }
        if self.high_pass is not None:
            self._notes.append(f"Frequencies below about {self.high_pass:g} Hz were removed (zero-phase high-pass).")
        if self.sample_rate is not None and self.sample_rate < self.rate:
            self._notes.append(
                f"Frequencies above {0.4 * self.sample_rate:g} Hz were removed before sampling at "
                f"{self.sample_rate:g} Hz."
            )

    def _no_gravity(self, vertical: str | None, mean: float) -> None:
        found = "no column is vertical" if vertical is None else f"{vertical} holds no gravity (mean {mean:.3g} m/s^2)"
        if self.tilt == "correct":
            raise ExcitationError(f"{self.path}: the tilt cannot be corrected, as {found}")
        self._notes.append(f"{found[0].upper()}{found[1:]}, so the sensor's tilt is unknown.")
        if self._unit_assumed:
            self._notes.append(
                "WARNING: that the values are in m/s^2 is assumed: neither the header nor the scene states their unit, and no "
                "gravity shows it; state it (vibration.unit)."
            )

    def _filtered(self, values: Array) -> Array:
        """The record through its filters, zero-phase, mirrored at its ends."""
        if self.high_pass is not None and not 0.0 < self.high_pass < 0.5 * self.rate:
            raise ExcitationError(
                f"{self.path}: high_pass is {self.high_pass} Hz; allowed: above 0 and below half the rate, "
                f"{0.5 * self.rate:g} Hz"
            )
        if self.sample_rate is not None and self.sample_rate < self.rate and not self.sample_rate > 0.0:
            raise ExcitationError(f"{self.path}: sample_rate is {self.sample_rate} Hz; it must be above 0")
        # Mirrored at the end: the periodic transform sees no jump
        mirrored = numpy.concatenate((values, values[::-1]))
        frequency = numpy.fft.rfftfreq(len(mirrored), 1.0 / self.rate)
        gain = numpy.ones(len(frequency))
        if self.high_pass is not None:
            with numpy.errstate(divide="ignore"):
                gain /= 1.0 + (self.high_pass / frequency) ** 8
        if self.sample_rate is not None and self.sample_rate < self.rate:
            # Anti-alias filter: cosine flank from 0.4 to 0.5 of the new rate
            flank = numpy.clip((frequency / self.sample_rate - 0.4) / 0.1, 0.0, 1.0)
            gain *= 0.5 * (1.0 + numpy.cos(numpy.pi * flank))
        if (gain == 1.0).all():
            return values
        return numpy.fft.irfft(gain * numpy.fft.rfft(mirrored), len(mirrored))[: len(values)]

    def refuse_longer_run(self, duration: float) -> None:
        """Raise ExcitationError where a run of `duration`, [s], needs more than the recording and
        that is refused.
        """
        length = (self.samples - 1) / self.rate - self.start
        if self.beyond == "refuse" and (duration - length) * self.rate > 1e-6:
            raise ExcitationError(
                f"{self.path}: the recording ends after {length:.6g} s, the scene lasts {duration:.6g} s; "
                "shorten the run or choose what comes after the recording (vibration.beyond: zero, repeat)"
            )

    def acceleration(self, t: Array) -> tuple[Array, Array]:
        """See blocks.Signal; ExcitationError beyond the recording where that is refused.

        t: [n] [s]; the result: forward and up, [n] each [m/s^2].
        """
        position = (t + self.start) * self.rate
        outside = (position < -1e-6) | (position > self.samples - 1 + 1e-6)
        if self.beyond == "refuse" and outside.any():
            raise ExcitationError(
                f"{self.path}: the recording ends after {(self.samples - 1) / self.rate - self.start:.6g} s, t = "
                f"{t[outside][0]:.6g} s was requested; "
                "shorten the run or choose what comes after the recording (vibration.beyond: zero or repeat)"
            )
        index, weight = _interpolation(position)
        # Samples beyond the ends: the first ones again, or zero
        index = index % self.samples if self.beyond == "repeat" else numpy.clip(index, 0, self.samples - 1)
        if self.beyond == "zero":
            weight[outside] = 0.0
        x, z = (
            numpy.einsum("ij,ij->i", self._acceleration[axis][index], weight)
            if axis in self._acceleration
            else numpy.zeros(len(t))
            for axis in ("x", "z")
        )
        return x, z

    def describe(self) -> dict[str, Any]:
        """See blocks.Signal."""
        axes = {
            axis: {
                "bias_m_per_s2": self.bias[axis],
                "rms_m_per_s2": float(numpy.sqrt(numpy.mean(values**2))),
                "peak_m_per_s2": float(numpy.abs(values).max()),
                "clipped_samples": self.clipping[axis].samples,
                "full_scale_m_per_s2": self.clipping[axis].value if self.clipping[axis].samples else None,
            }
            for axis, values in self._acceleration.items()
        }
        return {
            "kind": "recorded", "file": self.path.name, "samples": self.samples, "rate_Hz": self.rate,
            "duration_s": self.duration, "start_s": self.start, "axes": axes,
            "lateral_bias_m_per_s2": self.bias.get("y"),
            "tilt_degrees": None if self.tilt_angle is None else degrees(self.tilt_angle), "tilt": self.tilt,
            "high_pass_Hz": self.high_pass, "beyond_the_recording": self.beyond, "notes": list(self._notes),
        }  # fmt: skip


def _columns(table: RecordedTable, names: dict[str, str | None], needed: bool, unused: str) -> dict[str, str]:
    """The column of each axis; the lateral one and those of unused axes may be absent unless all
    are needed.
    """
    if names["x"] is None and needed:
        raise ExcitationError(f"{table.file}: the tilt cannot be corrected without a forward column; name it")
    named = {axis: name for axis, name in names.items() if name is not None}
    if needed:
        return named
    absent = {axis for axis, name in named.items() if bare_name(name.removeprefix("-")) not in table.columns}
    return {axis: name for axis, name in named.items() if axis not in absent or axis not in f"y{unused}"}


def _found_rate(table: RecordedTable, time: Array) -> tuple[float, float]:
    """Rate [Hz] of a time column, and the share of the step by which its stamps scatter."""
    far = numpy.flatnonzero(numpy.abs(time) > LARGEST_TIME)
    if far.size:
        raise ExcitationError(
            f"{table.file}, line {table.lines[far[0]]}: the time is {time[far[0]]:g} s; allowed: within "
            f"+-{LARGEST_TIME:g} s"
        )
    steps = numpy.diff(time)
    mean = float(time[-1] - time[0]) / len(steps)
    wrong = numpy.flatnonzero(~((steps > 0.5 * mean) & (steps < 1.5 * mean)))
    if mean <= 0.0 or wrong.size:
        index = int(wrong[0]) + 1 if wrong.size else 1
        raise ExcitationError(
            f"{table.file}, line {table.lines[index]}: time goes on by {steps[index - 1]:g} s, the mean step is "
            f"{mean:g} s; samples must be evenly spaced, without gaps"
        )
    stamps = judge_stamps(time, table.file, CURES.time)
    return stamps.rate, stamps.scatter


def _find_clipping(table: RecordedTable, values: Array, full_scale: float | None) -> Clipping:
    """Samples at the stated full scale; where none is stated, at an extreme that looks like one.

    A constant signal has no extremes: only a stated full scale shows that it is clipped.
    """
    if full_scale is not None:
        return _clipping_at(table, numpy.abs(values) >= full_scale, full_scale)
    found = Clipping(0, 0.0, 0, 0)
    if values.max() == values.min():
        return found
    # A plateau at an extreme, or a usual full scale that is reached more than once
    for extreme in (float(values.max()), float(values.min())):
        clipping = _clipping_at(table, values == extreme, abs(extreme))
        if clipping.longest_run >= SHORTEST_PLATEAU or (clipping.samples > 1 and _is_usual_full_scale(extreme)):
            found = Clipping(
                found.samples + clipping.samples,
                max(found.value, clipping.value),
                min(found.first_line or clipping.first_line, clipping.first_line),
                max(found.longest_run, clipping.longest_run),
            )
    return found


def _is_usual_full_scale(value: float) -> bool:
    return any(abs(abs(value) - scale * STANDARD_GRAVITY) < 2e-3 * abs(value) for scale in USUAL_FULL_SCALES)


def _clipping_at(table: RecordedTable, at_limit: NDArray[numpy.bool_], limit: float) -> Clipping:
    if not at_limit.any():
        return Clipping(0, limit, 0, 0)
    edges = numpy.flatnonzero(numpy.diff(numpy.concatenate(([False], at_limit, [False])).astype(numpy.int8)))
    first = int(table.lines[numpy.argmax(at_limit)])
    return Clipping(int(at_limit.sum()), limit, first, int((edges[1::2] - edges[::2]).max()))


def _turn_upright(raw: dict[str, Array], bias: dict[str, float]) -> dict[str, Array]:
    """The smallest rotation that puts the mean on the vertical axis (Rodrigues' formula), applied
    to every sample.
    """
    mean = numpy.array([bias["x"], bias["y"], bias["z"]])
    mean /= numpy.linalg.norm(mean)
    cross = numpy.array([mean[1], -mean[0], 0.0])  # mean x up
    skew = numpy.array([[0.0, -cross[2], cross[1]], [cross[2], 0.0, -cross[0]], [-cross[1], cross[0], 0.0]])
    rotation = numpy.eye(3) + skew + skew @ skew / (1.0 + mean[2])
    return {
        axis: rotation[row, 0] * raw["x"] + rotation[row, 1] * raw["y"] + rotation[row, 2] * raw["z"]
        for row, axis in enumerate("xyz")
    }


def _interpolation(position: Array) -> tuple[NDArray[numpy.int64], Array]:
    """Samples under the kernel and their weights, [len(position), 64]; weights sum to 1."""
    base = numpy.floor(position).astype(numpy.int64)
    offset = numpy.arange(1 - HALF_WIDTH, HALF_WIDTH + 1)
    distance = (position - base)[:, None] - offset
    angle = numpy.pi / HALF_WIDTH * distance
    window = 0.35875 + 0.48829 * numpy.cos(angle) + 0.14128 * numpy.cos(2.0 * angle) + 0.01168 * numpy.cos(3.0 * angle)
    weight = numpy.sinc(distance) * window
    weight /= weight.sum(axis=1)[:, None]
    return base[:, None] + offset, weight
