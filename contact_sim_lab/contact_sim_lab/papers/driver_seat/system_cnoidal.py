"""System *cnoidal*: the ansatz fitted to a motion of one's own (Driver and Seat eqs 12, 13, A1-A6).

The last whole period of the motion is fitted with the linear superposition alone, with the
quotient, and with as many harmonics as the quotient has unknowns. Of each term, m gives the entry
``B = -2 pi K(1 - m)/K(m)`` of the theta function of one phase, whose wave is compared with its cn^2
form.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from contact_sim_lab.papers.cnoidal.fit import AnsatzFit, ansatz, fit_ansatz, fit_harmonics, harmonics_of_period
from contact_sim_lab.papers.cnoidal.theta import ThetaError, one_phase, theta_wave
from contact_sim_lab.papers.inputs import is_bag, read_table
from contact_sim_lab.records.paper import PaperError, SystemResult, Values
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.library import series
from contact_sim_pkg.pressure.closed_form.jacobi import cn_squared, quarter_period

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["Period", "cnoidal", "last_period"]

Array = NDArray[numpy.float64]

SAMPLES = 256  # of the period
SEARCHED = 0.02  # of the frequency, about the strongest line
LEAST_PARAMETER = 1e-6  # m below which a term is a cosine


class Period(NamedTuple):
    """One period of a motion."""

    frequency: float  # [Hz]
    values: Array  # [SAMPLES]
    mismatch: float  # rms of its difference from the period before, over its spread


def cnoidal(path: Path | None, values: Values) -> SystemResult:
    """Fit of the last period of a motion, in a CSV file or a bag.

    Raises PaperError for a motion without two periods.
    """
    assert path is not None
    time, motion, unit = _motion(path, values)
    period = last_period(time, motion, float(values["frequency"]))
    terms = int(values["terms"])
    phases = harmonics_of_period(SAMPLES, terms)
    try:
        linear, whole = (fit_ansatz(period.values, phases, nonlinear=quotient) for quotient in (False, True))
    except ValueError as error:
        raise PaperError(f"{path}: {error}") from None
    harmonics = (whole.unknowns - 1) // 2
    rows: list[Mapping[str, Any]] = [
        {"fit": "S_lin, cn² alone (eq 13)", "unknowns": linear.unknowns, "residual": linear.residual},
        {"fit": "S, with the quotient (A6)", "unknowns": whole.unknowns, "residual": whole.residual},
        {"fit": f"mean and {harmonics} harmonics", "unknowns": 1 + 2 * harmonics,
         "residual": fit_harmonics(period.values, harmonics)},
        *(_term(number, float(m), whole) for number, m in enumerate(whole.parameters, start=1)),
    ]  # fmt: skip
    note = (
        f"period {1.0 / period.frequency:.6g} s at {period.frequency:.6g} Hz; it differs from the one before by "
        f"{period.mismatch:.2g} of its spread. residual: rms over the spread; of a term k: B of its one-phase theta function, "
        "difference of that wave from its cn² form (A5)"
    )
    return SystemResult(rows, lambda canvas: _draw(canvas, period, (linear, whole), unit), note)


def _motion(path: Path, values: Values) -> tuple[Array, Array, str]:
    """Time [s] and values, with a name for the axis."""
    if not is_bag(path):
        table = read_table(path, ("time", "value"), fewest=8)
        if not (numpy.diff(table["time"]) > 0.0).all():
            raise PaperError(f"{path}: time does not rise from row to row")
        return table["time"], table["value"], "value"
    topic, column = f"{values['contact']}/force", str(values["column"])
    found = series(open_bag(path), topic)
    return numpy.asarray(found.time, float), numpy.asarray(found[column], float), f"{column}, {found.units[column]}"


def last_period(time: Array, values: Array, frequency: float = 0.0) -> Period:
    """The last whole period [SAMPLES] of values [samples] at time [samples] [s]; frequency [Hz], 0:
    that by which the last two periods differ least, about the strongest line of the spectrum.

    Raises PaperError where fewer than two periods are there.
    """
    from scipy.optimize import minimize_scalar

    length = float(time[-1] - time[0])
    searched = frequency == 0.0
    if searched:
        frequency = _strongest(time, values)
    # A searched period may turn out up to 2 % longer.
    if not length * frequency >= 2.0 * (1.0 + SEARCHED * searched):
        held = f"{length * frequency:.3g} periods of {frequency:.6g} Hz"
        raise PaperError(f"the motion of {length:.6g} s holds {held}; two are needed")
    motion = CubicSpline(time, values)

    def periods(frequency: float) -> tuple[Array, Array]:
        steps = numpy.arange(SAMPLES) / (SAMPLES * frequency)
        return motion(time[-1] - 1.0 / frequency + steps), motion(time[-1] - 2.0 / frequency + steps)

    def mismatch(frequency: float) -> float:
        last, before = periods(frequency)
        spread = float(last.std())
        return float(numpy.sqrt(numpy.mean((last - before) ** 2))) / spread if spread > 0.0 else 0.0

    if searched:
        about = ((1.0 - SEARCHED) * frequency, (1.0 + SEARCHED) * frequency)
        options = {"xatol": 1e-10 * frequency}
        frequency = float(minimize_scalar(mismatch, bounds=about, method="bounded", options=options).x)
    return Period(frequency, periods(frequency)[0], mismatch(frequency))


def _strongest(time: Array, values: Array) -> float:
    """Frequency [Hz] of the strongest line of values [samples] at time [samples] [s]: the parabola through the
    logarithms of the three largest lines of a Hann window's spectrum.
    """
    even = numpy.linspace(time[0], time[-1], len(time))
    part = numpy.interp(even, time, values)
    lines = numpy.log(numpy.abs(numpy.fft.rfft(numpy.hanning(len(part)) * (part - part.mean()))) + 1e-300)
    place = min(int(lines[1:].argmax()) + 1, len(lines) - 2)
    low, middle, high = lines[place - 1 : place + 2]
    bend = low - 2.0 * middle + high
    shift = 0.5 * (low - high) / bend if bend < 0.0 else 0.0
    return float((place + shift) / (len(part) * (even[1] - even[0])))


def _term(number: int, m: float, fit: AnsatzFit) -> dict[str, float | str | None]:
    """A term of the fit, with its one-phase theta function (A1-A5); alpha and beta where not their sum alone is
    determined.
    """
    alpha, beta, apart = (float(each[number - 1]) for each in (fit.linear, fit.numerator, fit.apart))
    row: dict[str, float | str | None] = {
        "fit": f"term {number}", "m": m, "alpha_plus_beta": alpha + beta, "alpha": alpha if apart else None,
        "beta": beta if apart else None, "gamma": float(fit.denominator[number - 1]),
    }  # fmt: skip
    if not LEAST_PARAMETER < m < 1.0:
        return row
    entry = -2.0 * math.pi * quarter_period(m)[0] / quarter_period(1.0 - m)[0]
    try:
        wave = one_phase(entry, 1.0)
    except ThetaError:
        return row
    eta = numpy.linspace(0.0, 2.0 * math.pi, 64, endpoint=False)
    by_theta = theta_wave(eta[:, None], numpy.array([[entry]]), numpy.ones(1))
    by_cn = wave.offset + wave.amplitude * cn_squared(wave.argument * eta + wave.integral_k, wave.complement)
    return {**row, "B": entry, "A5_difference": float(numpy.abs(by_theta - by_cn).max() / numpy.abs(by_theta).max())}


def _draw(canvas: Canvas, period: Period, fits: tuple[AnsatzFit, AnsatzFit], unit: str) -> None:
    """Motion and fits over a period, what is left below."""
    above, below = canvas.subplots(2, 1, sharex=True, height_ratios=[2, 1])
    share = numpy.arange(SAMPLES) / SAMPLES
    above.plot(share, period.values, color="#333333", linewidth=2.4, alpha=0.4, label="motion")
    for fit, colour, label in zip(fits, ("#e08a2e", "#136f96"), ("S_lin", "S with the quotient"), strict=True):
        found = ansatz(fit, harmonics_of_period(SAMPLES, len(fit.parameters)))
        above.plot(share, found, color=colour, label=f"{label}, residual {fit.residual:.2g}")
        below.plot(share, found - period.values, color=colour)
    above.set_ylabel(unit)
    above.legend()
    below.set_ylabel("fit less motion")
    below.set_xlabel(f"share of the period of {1.0 / period.frequency:.4g} s")
