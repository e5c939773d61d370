"""Figures 9 and 10: radii and load over time, and the contact ellipse that follows them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy

from contact_sim_lab.papers.runs import at, series_of
from contact_sim_lab.records.paper import Drawn, Figure, Number, Values
from contact_sim_pkg.library import load_scene
from contact_sim_pkg.rigs.roller.model import build_roller

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["FIGURE_9", "FIGURE_10", "INSTANTS", "SCENE"]

SCENE = "roller_steady"
INSTANTS = (0.0, 2.0, 4.0, 6.0)  # [s]
_CHOSEN = "radii and load chosen to meet every statement of section 5"
_WORKED = "Hertz's ellipse worked out from the chosen radii and load, four digits"
_TEXT = "statement of section 5"

# At the instants: semi-axes along x and y [m], area [m^2], pressure [Pa], approach [m].
_EXPECTED = {
    "semi-axis along x": ((4.292e-4, 5.779e-4, 4.745e-4, 5.443e-4), 1e-7, "m"),
    "semi-axis along y": ((5.682e-4, 4.671e-4, 5.568e-4, 4.823e-4), 1e-7, "m"),
    "area S": ((0.766e-6, 0.848e-6, 0.830e-6, 0.825e-6), 1e-9, "m²"),
    "p₀": ((141.0e6, 100.8e6, 130.1e6, 103.7e6), 1e5, "Pa"),
    "approach δ": ((9.43e-7, 7.11e-7, 9.09e-7, 7.22e-7), 1e-9, "m"),
}


def _laws(time: float) -> tuple[float, float, float]:
    """R11, R21 [m] and F_N [N] at a time [s], as chosen."""
    return (
        0.320 + 0.002 * time,
        0.340 - (0.130 - 0.012 * time) * math.cos(0.5 * math.pi * time),
        72.0 - 15.0 * math.sin(0.25 * math.pi * time) ** 2,
    )


def _figure_9(values: Values) -> Drawn:
    programme = build_roller(load_scene(SCENE)).programme
    times = programme.time
    numbers = []
    for time in INSTANTS:
        curvatures, (r11, r21, load) = programme.curvatures_at(time), _laws(time)
        numbers += [
            Number(f"R11 at {time:g} s", "m", 1.0 / curvatures.shaft_rolling, r11, 5e-7, _CHOSEN, is_input=True),
            Number(f"R21 at {time:g} s", "m", 1.0 / curvatures.roller_axial, r21, 5e-7, _CHOSEN, is_input=True),
            Number(f"F_N at {time:g} s", "N", float(programme.loads(numpy.array([time]))[0]), load, 5e-5, _CHOSEN,
                   is_input=True),
            Number(
                f"sign of R11 − R21 at {time:g} s", "",
                math.copysign(1.0, curvatures.roller_axial - curvatures.shaft_rolling), 1.0 if time in (0.0, 4.0) else -1.0, 0.0,
                _TEXT,
            ),
        ]  # fmt: skip

    def draw(canvas: Canvas) -> None:
        upper, lower = canvas.subplots(2, 1, sharex=True)
        radii = 1e3 / numpy.array([programme.curvatures_at(float(time)) for time in times])[:, [2, 0]]
        for column, name in enumerate(("R11", "R21")):
            upper.plot(times, radii[:, column], label=name)
        upper.set_ylabel("radius, 10⁻³ m")
        upper.legend(ncols=2)
        lower.plot(times, programme.loads(times) / 100.0)
        lower.set_ylabel("F_N, 10² N")
        lower.set_xlabel("t, s")

    return Drawn(numbers, draw)


def _figure_10(values: Values) -> Drawn:
    found = series_of("roller/contact", SCENE)
    area = math.pi * found["along_x"] * found["along_y"]
    columns = dict(
        zip(
            _EXPECTED,
            (found["along_x"], found["along_y"], area, found["peak_pressure"], found["approach"]),
            strict=True,
        )
    )
    numbers = []
    for k, time in enumerate(INSTANTS):
        place = int(numpy.argmin(numpy.abs(found.time - time)))
        for name, (expected, digit, unit) in _EXPECTED.items():
            numbers.append(
                Number(f"{name} at {time:g} s", unit, float(columns[name][place]), expected[k], 0.51 * digit, _WORKED)
            )
    first, second, third, fourth = (at(found, time) for time in INSTANTS)
    area_of = {id(each): each["along_x"] * each["along_y"] for each in (first, second, third, fourth)}
    for what, difference in (
        ("S(4) > S(0)", area_of[id(third)] - area_of[id(first)]),
        ("p₀(0) > p₀(4)", first["peak_pressure"] - third["peak_pressure"]),
        ("S(2) > S(6)", area_of[id(second)] - area_of[id(fourth)]),
        ("p₀(6) > p₀(2)", fourth["peak_pressure"] - second["peak_pressure"]),
    ):
        numbers.append(Number(f"{what}: sign of the difference", "", math.copysign(1.0, difference), 1.0, 0.0, _TEXT))

    def draw(canvas: Canvas) -> None:
        axes = canvas.subplots(4, 1, sharex=True)
        for name, label in (("semi-axis along x", "X_ab"), ("semi-axis along y", "Y_ab")):
            axes[0].plot(found.time, columns[name] * 1e4, label=label)
        axes[0].legend(ncols=2)
        axes[0].set_ylabel("10⁻⁴ m")
        for ax, name, scale, label in (
            (axes[1], "area S", 1e6, "S, 10⁻⁶ m²"), (axes[2], "p₀", 1e-6, "p₀, 10⁶ Pa"), (axes[3], "approach δ", 1e7, "δ, 10⁻⁷ m"),
        ):  # fmt: skip
            ax.plot(found.time, columns[name] * scale)
            ax.plot(INSTANTS, numpy.array(_EXPECTED[name][0]) * scale, "k+")
            ax.set_ylabel(label)
        axes[3].set_xlabel("t, s   (+ expected)")

    return Drawn(numbers, draw, (7.0, 6.4))


FIGURE_9 = Figure(
    "9", "radii R11, R21 and load F_N over time", (f"scene {SCENE}",),
    "the chosen laws, which are input, to their last digit; which radius is larger, by the text", _figure_9,
    note="The paper gives only the scales of its axes. The radii and the load are chosen so that every statement of its "
    "section 5 holds.",
)  # fmt: skip
FIGURE_10 = Figure(
    "10", "semi-axes, area, largest pressure and approach over time",
    (f"scene {SCENE}", "contact_sim_pkg.rigs.roller.theory.ellipse:contact_of_rollers"),
    "a, b, S, p₀, δ at four instants to their last digit; the order of S and p₀, by the text", _figure_10,
)  # fmt: skip
