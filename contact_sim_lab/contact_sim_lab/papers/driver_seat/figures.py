"""Figures of *Driver and Seat*: contact domain, loops of force over deflection, area over time.

The paper gives the band of the spine, 4.75 to 6.25 Hz, and no other number. Mass, law, friction and
amplitudes are those of the shipped scenes.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.closed_form.lame_domain import lame_boundary
from contact_sim_lab.closed_form.lame_points import fit_points, hull
from contact_sim_lab.papers.cnoidal.periodic_contact import steady_response
from contact_sim_lab.papers.runs import series_of
from contact_sim_lab.records.paper import SHAPE_ONLY, Drawn, Figure, Number, Values
from contact_sim_lab.rigs.backrest.twin import SlappingMass, slapping_course, sliding_friction
from contact_sim_lab.twins.impact import damping_of_restitution
from contact_sim_pkg.library import load_scene
from contact_sim_pkg.pressure.closed_form.lame import LameFit
from contact_sim_pkg.records.fields import given
from contact_sim_pkg.rigs.backrest.schema import BackFriction

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Canvas

__all__ = ["FIGURES"]

Array = NDArray[Any]

FREQUENCIES = (4.75, 5.25, 5.75, 6.25)  # [Hz]
GRAVITY = 9.81
KEPT, SLAPS = 0.5, 1.5  # [g]: contact is kept, the back slaps
SCENES = {KEPT: "seat_slip", SLAPS: "seat_slap"}
RATE, SUBSTEPS = 10_000.0, 50  # samples a second; steps of the friction twin a sample
STROKE = 0.010  # [m] of the sliding
MASS, COEFFICIENT, EXPONENT = 45.6, 2.457e5, 1.5  # [kg], [N/m^n]
FRICTION, STIFFNESS, DAMPING = 0.4, 3.19e4, 619.0  # mu, C [N/m], D [N s/m]
RADII = (0.6, 1.5)  # [m] across and up the back
HEIGHT, WIDTH = 0.50, 0.40  # [m] of the back
MAPS = ("duration=1", "outputs.field_rate=500", "backrest.mat.rows=160", "backrest.mat.cols=128")
REST = (MASS * GRAVITY / COEFFICIENT) ** (1.0 / EXPONENT)  # [m]
LIFT_OFF = (0.73, 0.87, 1.07, 1.32)  # [g] at the frequencies
ORIGIN = "scipy (DOP853, 1e-12) of eqs 7 and 8"
FRICTION_ORIGIN = "eq 9 within Coulomb's limit, step by step at 2 μs, on scipy's F_c"
TOLERANCE = 1e-4


class Loops(NamedTuple):
    """One period at the end of a run, of the bench and of the twin; arrays [samples]."""

    slide: Array  # [m] of the back along the seat back
    approach: Array  # [m]
    normal: Array  # [N]
    tangential: Array  # [N] on the seat back
    twin: Array  # [3, samples] approach, rate, force
    twin_tangential: Array


def _run(frequency: float, amplitude: float) -> tuple[str, ...]:
    return (
        SCENES[amplitude], f"vibration.frequency={frequency}", f"backrest.sliding.frequency={frequency}",
        f"outputs.force_rate={RATE:g}", "vibration.sample_rate=20000", "accuracy=1e-6",
    )  # fmt: skip


def _body(frequency: float, amplitude: float) -> SlappingMass:
    damping = damping_of_restitution(0.6, 0.5)
    return SlappingMass(MASS, MASS * GRAVITY, amplitude * GRAVITY, frequency, COEFFICIENT, EXPONENT, damping)


def _loops(frequency: float, amplitude: float) -> Loops:
    found = series_of("backrest/force", *_run(frequency, amplitude))
    angular, period = 2.0 * math.pi * frequency, round(RATE / frequency)
    # The twin of the friction begins three periods before the end, at rest: a slip forgets what was before.
    first = len(found) - 1 - 3 * period
    fine = found.time[first] + numpy.arange(3 * period * SUBSTEPS + 1) / (RATE * SUBSTEPS)
    course = slapping_course(_body(frequency, amplitude), numpy.concatenate([[0.0], fine]))[:, 1:]
    velocity = STROKE * angular * numpy.cos(angular * fine)
    twin = sliding_friction(course[2], velocity, 1.0 / (RATE * SUBSTEPS), FRICTION, STIFFNESS, DAMPING)
    last, every = slice(-period - 1, None), slice(None, None, SUBSTEPS)
    time = found.time[last]
    return Loops(
        STROKE * numpy.sin(angular * time), found["approach"][last],
        found["normal"][last], -found["tangential"][last], course[:, every][:, last], twin[every][last],
    )  # fmt: skip


def _area(force: Array, along: Array) -> float:
    """Area of a loop [J], by trapezia."""
    return float(numpy.sum(0.5 * (force[1:] + force[:-1]) * numpy.diff(along)))


def _normal_numbers(loops: dict[float, Loops]) -> list[Number]:
    numbers = []
    for frequency, each in loops.items():
        own, twin = each.normal, each.twin[2]
        numbers += [
            Number(f"largest F_c at {frequency} Hz", "N", float(own.max()), float(twin.max()), TOLERANCE, ORIGIN, relative=True),
            Number(f"area of the loop F_c(δ) at {frequency} Hz", "J", _area(own, each.approach), _area(twin, each.twin[0]),
                   TOLERANCE, ORIGIN, relative=True),
        ]  # fmt: skip
    return numbers


def _tangential_numbers(loops: dict[float, Loops]) -> list[Number]:
    numbers = []
    for frequency, each in loops.items():
        own, twin = each.tangential, each.twin_tangential
        numbers += [
            Number(f"largest |F_t| at {frequency} Hz", "N", float(abs(own).max()), float(abs(twin).max()), TOLERANCE,
                   FRICTION_ORIGIN, relative=True),
            Number(f"area of the loop F_t(δ_t) at {frequency} Hz", "J", _area(own, each.slide), _area(twin, each.slide),
                   TOLERANCE, FRICTION_ORIGIN, relative=True),
        ]  # fmt: skip
    return numbers


def _draw_normal(axes: Axes, loops: dict[float, Loops]) -> None:
    for frequency, each in loops.items():
        axes.plot(each.approach * 1e3, each.normal, label=f"{frequency} Hz")
    axes.set(xlabel="δ, mm", ylabel="F_c, N")
    axes.legend()


def _draw_tangential(axes: Axes, loops: dict[float, Loops]) -> None:
    for frequency, each in loops.items():
        axes.plot(each.slide * 1e3, each.tangential, label=f"{frequency} Hz")
    axes.set(xlabel="δ_t, mm", ylabel="F_t, N")


def _all(amplitude: float) -> dict[float, Loops]:
    return {frequency: _loops(frequency, amplitude) for frequency in FREQUENCIES}


def _lift_off(frequency: float) -> float:
    """Amplitude [g] of the seat at which the steady contact first opens: the least approach of the response, by bisection
    to 0.002 g.
    """
    low, high = 0.5, 1.5
    while high - low > 0.002:
        middle = 0.5 * (low + high)
        opens = steady_response(frequency, middle).approach.min() <= 0.0
        low, high = (low, middle) if opens else (middle, high)
    return 0.5 * (low + high)


def _figure_4(values: Values) -> Drawn:
    loops = _all(KEPT)
    numbers = _normal_numbers(loops) + [
        Number(f"amplitude at lift-off, {frequency} Hz", "g", _lift_off(frequency), expected, 0.0075,
               "worked out with the power law, two digits")
        for frequency, expected in zip(FREQUENCIES, LIFT_OFF, strict=True)
    ]  # fmt: skip

    def draw(canvas: Canvas) -> None:
        axes = canvas.subplots()
        _draw_normal(axes, loops)
        axes.set_title(f"{KEPT} g: contact is kept")

    return Drawn(numbers, draw, (6.0, 4.2))


def _figure_5(values: Values) -> Drawn:
    kept, slaps = _all(KEPT), _all(SLAPS)
    friction = given(load_scene(SCENES[KEPT]).effect("backrest", BackFriction))
    limit = friction.coefficient_static * MASS * GRAVITY / friction.stiffness
    numbers = [
        Number("sliding that the stick spring bears, μP/C", "m", limit, 5.6e-3, 5e-5, "worked out by hand, two digits"),
        *_tangential_numbers(kept), *_normal_numbers(slaps),
    ]  # fmt: skip

    def draw(canvas: Canvas) -> None:
        left, right = canvas.subplots(1, 2)
        _draw_tangential(left, kept)
        left.set_title(f"{KEPT} g: contact is kept")
        _draw_normal(right, slaps)
        right.set_title(f"{SLAPS} g: slaps")

    return Drawn(numbers, draw, (8.4, 4.0))


def _figure_6(values: Values) -> Drawn:
    loops = _all(SLAPS)

    def draw(canvas: Canvas) -> None:
        axes = canvas.subplots()
        _draw_tangential(axes, loops)
        axes.legend()
        axes.set_title(f"{SLAPS} g: slaps and slips")

    return Drawn(_tangential_numbers(loops), draw, (6.0, 4.2))


def _domain(approach: Array) -> Array:
    """Area [m^2] of the domain x²/2R_up + y²/2R_across <= approach [samples] [m] on the back, whose edges cut the ellipse."""
    up, across = (numpy.sqrt(2.0 * radius * numpy.maximum(approach, 1e-12))[:, None] for radius in (RADII[1], RADII[0]))
    steps = (numpy.arange(2000) + 0.5) / 2000
    end = numpy.minimum(up, 0.5 * HEIGHT)
    half = across * numpy.sqrt(1.0 - (steps * end / up) ** 2)
    return numpy.asarray(4.0 * end[:, 0] * numpy.minimum(half, 0.5 * WIDTH).mean(axis=1))


class Shares(NamedTuple):
    """S/S_ref over a run; arrays [samples]."""

    time: Array  # [s]
    recorded: Array  # area of the loaded cells over that at rest
    twin: Array


def _shares(frequency: float) -> Shares:
    found = series_of("backrest/patch", *_run(frequency, SLAPS), *MAPS)
    course = slapping_course(_body(frequency, SLAPS), found.time)
    twin = numpy.where(course[2] > 0.0, _domain(course[0]), 0.0) / _domain(numpy.array([REST]))
    return Shares(found.time, found["area"] / found["area"][0], twin)


def _figure_7(values: Values) -> Drawn:
    shares = {frequency: _shares(frequency) for frequency in FREQUENCIES}
    origin = f"{ORIGIN}, and the ellipse of its approach on a back of {WIDTH:g} by {HEIGHT:g} m"
    numbers = []
    for frequency, each in shares.items():
        numbers += [
            Number(f"largest S/S_ref at {frequency} Hz", "", float(each.recorded.max()), float(each.twin.max()), 2.4e-3, origin,
                   relative=True),
            Number(f"mean of S/S_ref at {frequency} Hz", "", float(each.recorded.mean()), float(each.twin.mean()), 1.6e-3, origin,
                   relative=True),
        ]  # fmt: skip
    rest = series_of("backrest/patch", *_run(FREQUENCIES[0], SLAPS), *MAPS)["area"][0]
    area = float(_domain(numpy.array([REST]))[0])
    numbers.append(Number("S_ref", "m²", float(rest), area, 2.2e-3, "ellipse of eq 8 at rest", relative=True))

    def draw(canvas: Canvas) -> None:
        axes = canvas.subplots()
        for k, (frequency, each) in enumerate(shares.items()):
            last = each.time >= each.time[-1] - 1.0 / frequency
            since = (each.time[last] - each.time[last][0]) * 1e3
            axes.plot(since, each.recorded[last], f"C{k}.", markersize=3, label=f"{frequency} Hz")
            axes.plot(since, each.twin[last], f"C{k}", linewidth=0.8)
        axes.set(xlabel="t over one period, ms   (points: recorded map, lines: scipy)", ylabel="S/S_ref")
        axes.legend()

    return Drawn(numbers, draw, (6.5, 4.2))


def _figure_3(values: Values) -> Drawn:
    run = (
        "seat_slap", "effects.backrest.shell_modes.points_up=40", "effects.backrest.shell_modes.points_across=32",
        "backrest.preload=20", "duration=0.02",
    )  # fmt: skip
    found = series_of("backrest/points", *run)
    first = found.time == found.time[0]
    places = numpy.stack([found["x"][first], found["y"][first]], axis=1)
    touched = places[found["normal"][first] > 0.0]
    fit: LameFit = fit_points(touched)
    spacing = 0.0125  # [m] of the candidate points
    border = hull(touched)
    note = "the domain of the paper is a picture: what agrees is that it is one Lamé curve"
    numbers = [
        Number("points in contact", "", float(len(touched)), None, 0.0, "", note=note),
        Number("Lamé exponent n", "", fit.exponent, None, 0.0, "", note=note),
        Number("half axes up and across", "m", fit.a, None, 0.0, "", note=f"{fit.b:.4g} m across"),
        Number("rms deviation of ρ from 1 over the border", "", fit.deviation, 0.0, spacing / min(fit.a, fit.b),
               "one spacing of the points over the shorter half axis"),
    ]  # fmt: skip

    def draw(canvas: Canvas) -> None:
        axes = canvas.subplots()
        axes.plot(places[:, 1], places[:, 0], ".", color="#cccccc", markersize=2, label="candidate points")
        axes.plot(touched[:, 1], touched[:, 0], "o", markersize=4, label="in contact at first touch")
        x, y = lame_boundary(fit.a, fit.b, fit.exponent, 200)
        axes.plot(
            numpy.append(y, y[0]) + fit.centre_y,
            numpy.append(x, x[0]) + fit.centre_x,
            "C1",
            label=f"Lamé, n = {fit.exponent:.3g}",
        )
        axes.plot(border[:, 1], border[:, 0], "C1.", markersize=3)
        axes.set(xlabel="across the back, m", ylabel="up the back, m", aspect="equal")
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))

    return Drawn(numbers, draw, (6.5, 4.6))


_SLAP = "contact_sim_lab.papers.cnoidal.periodic_contact:steady_response"
FIGURES: tuple[Figure, ...] = (
    Figure("3", "contact domain with the points detected at first touch",
           ("scene seat_slap", "contact_sim_lab.closed_form.lame_points:fit_points"),
           "rms deviation of the border from the fitted Lamé curve, no per cent", _figure_3, SHAPE_ONLY),
    Figure("4", "contact force over the approach at four frequencies of the spine", ("scene seat_slip", _SLAP),
           "scipy of eqs 7, 8, 1e-4: peak and loop area; amplitudes at lift-off", _figure_4),
    Figure("5", "friction force over the slip, contact kept; contact force with slaps", ("scene seat_slip", "scene seat_slap"),
           "scipy of eqs 8, 9, 1e-4: peak and loop area; 5.6 mm that the stick spring bears", _figure_5,
           note="The captions of figures 5 and 6 are the same, the text takes one of them for F_c(δ). Shown are F_t(δ_t) at 0.5 g "
           "here and at 1.5 g in figure 6, and F_c(δ) at 1.5 g beside it."),
    Figure("6", "friction force over the slip, with slaps", ("scene seat_slap",),
           "scipy of eqs 8, 9, 1e-4: peak and loop area", _figure_6),
    Figure("7", "area of the contact domain over the impact",
           ("scene seat_slap",),
           "area of the recorded pressure map; scipy of eqs 7, 8 and its ellipse cut by the edges of the back, 0.24 %", _figure_7,
           note="S_ref is the area under the weight at rest. The domain reaches the ends of the back: S/S_ref grows less than the "
           "approach."),
)  # fmt: skip
