"""Figures of *Contact Area*: forces over one impact."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from contact_sim_lab.records.paper import SHAPE_ONLY, Drawn, Figure, Number, Parameter, Values
from contact_sim_lab.rigs.impact.twins.goloshchapov import impact as scaled_twin
from contact_sim_lab.rigs.impact.twins.goloshchapov import severity
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.motion import FreeImpact, ImpactCourse, course, solve_impact

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["FIGURES"]

Array = NDArray[numpy.float64]

ORIGIN = "scipy (DOP853, 1e-13) of eq 54 at its own frequency"
INSIDE = 1e-5
CHOICE = (0.02, 0.01, 8.0e6, 0.2, 2.0)  # mass, radius, E', tan beta, V0 of the paper's missing data, as chosen

PARAMETERS = (
    Parameter("speed", "m/s", 2.0, least=1e-6, most=1e3, help="V0"),
    Parameter("mass", "kg", 0.02, least=1e-9, most=1e6),
    Parameter("radius", "m", 0.01, least=1e-6, most=1e3),
    Parameter("storage_modulus", "Pa", 8.0e6, least=1e3, most=1e12, help="E' of both bodies in series"),
    Parameter("loss_tangent", "", 0.2, least=0.0, most=6.0, help="tan β"),
)


def _solved(values: Values) -> tuple[FreeImpact, ImpactCourse]:
    sphere = Sphere(values["mass"], values["radius"])
    impact = solve_impact(sphere, Material(values["storage_modulus"], values["loss_tangent"]), values["speed"])
    return impact, course(impact, numpy.linspace(0.0, impact.duration, 401, dtype=numpy.float64))


def _forces_of_twin(values: Values, frequency: float, times: Array) -> Array:
    """F_c and F_b [2, times] [N] of eqs 8 and 9 on scipy's motion."""
    shape = math.sqrt(2.0) * math.sqrt(values["radius"])
    elastic = 4.0 / 3.0 * shape * values["storage_modulus"]
    viscous = 4.0 * shape * values["storage_modulus"] * values["loss_tangent"] / frequency

    def rates(time: float, state: Array) -> list[float]:
        root = math.sqrt(max(state[0], 0.0))
        return [state[1], -root * (elastic * state[0] + viscous * state[1]) / values["mass"]]

    start = [0.0, values["speed"]]
    found = solve_ivp(rates, (0.0, times[-1]), start, "DOP853", times, rtol=1e-13, atol=1e-18)
    depth, speed = numpy.maximum(found.y[0], 0.0), found.y[1]
    return numpy.array([elastic * depth**1.5, viscous * numpy.sqrt(depth) * speed])


def _figure_4(values: Values) -> Drawn:
    impact, found = _solved(values)
    zeta = severity(values["loss_tangent"], "force")
    twin = scaled_twin(zeta, "force")
    coefficient = 4.0 / 3.0 * math.sqrt(2.0 * values["radius"]) * values["storage_modulus"]
    length = (values["mass"] * values["speed"] ** 2 / coefficient) ** 0.4
    unit = values["mass"] * values["speed"] ** 2 / length
    duration = twin.duration * length / values["speed"]
    expected = {
        "depth x_m": ("m", impact.depth, twin.depth * length), "contact time": ("s", impact.duration, duration),
        "restitution": ("", impact.restitution, twin.restitution),
        "largest force": ("N", impact.peak_force, twin.peak_force * unit),
    }  # fmt: skip
    numbers = [
        Number(what, in_unit, own, other, INSIDE, ORIGIN, relative=True)
        for what, (in_unit, own, other) in expected.items()
    ]
    places = [80, 160, 240, 320]
    forces = _forces_of_twin(values, math.pi / duration, found.time[[0, *places]])[:, 1:]
    for k, place in enumerate(places):
        for name, own, other in (("F_c", found.elastic_force, forces[0]), ("F_b", found.viscous_force, forces[1])):
            numbers.append(
                Number(
                    f"{name} at {place / 400:g} of the contact",
                    "N",
                    float(own[place]),
                    float(other[k]),
                    INSIDE * unit,
                    ORIGIN,
                )
            )
    if tuple(values[each] for each in ("mass", "radius", "storage_modulus", "loss_tangent", "speed")) == CHOICE:
        worked = "worked out for the chosen sample, two digits"
        numbers += [
            Number("x_m/R", "", impact.depth / values["radius"], 0.11, 0.005, worked),
            Number("contact time", "s", impact.duration, 1.8e-3, 5e-5, worked),
        ]

    def draw(canvas: Canvas) -> None:
        axes = canvas.subplots()
        time = found.time * 1e3
        axes.plot(time, found.elastic_force, label="F_c, elastic")
        axes.plot(time, found.viscous_force, label="F_b, viscous")
        axes.plot(time, found.force, "k", label="F_c + F_b")
        axes.plot(time, numpy.hypot(found.elastic_force, found.viscous_force), ":", label="√(F_c² + F_b²)")
        axes.set(xlabel="t, ms", ylabel="force, N")
        axes.legend()

    return Drawn(numbers, draw, (6.5, 4.2))


def _figure_5(values: Values) -> Drawn:
    impact, found = _solved(values)
    time, force = found.time / impact.duration, found.force / found.force.max()
    half = time[force >= 0.5]
    note = "the oscilloscope's photograph has no scales"
    numbers = [
        Number("time of the peak over the contact time", "", impact.peak_time / impact.duration, None, 0.0, "", note=note),
        Number("width at half the peak over the contact time", "", float(half[-1] - half[0]), None, 0.0, "", note=note),
        Number("centroid of the pulse over the contact time", "", float(numpy.sum(time * force) / numpy.sum(force)), None, 0.0, "",
               note=note),
        Number("humps of the pulse", "", float(numpy.sum(numpy.diff(numpy.sign(numpy.diff(force))) < 0)), 1.0, 0.0,
               "the photograph shows a single one"),
    ]  # fmt: skip

    def draw(canvas: Canvas) -> None:
        axes = canvas.subplots()
        axes.plot(time, force, "k")
        axes.axvline(impact.peak_time / impact.duration, color="C3", linewidth=0.8)
        axes.set(xlabel="t over the contact time", ylabel="force over its peak")

    return Drawn(numbers, draw, (6.0, 3.8))


_MADE_BY = ("contact_sim_pkg.rigs.impact.theory.motion:solve_impact", "scene impact_rubber_drop")
FIGURES: tuple[Figure, ...] = (
    Figure("4", "elastic, viscous and total force over the impact", _MADE_BY,
           "x_m/R 0.11 and 1.8 ms; scipy of eq 54, 1e-5", _figure_4, parameters=PARAMETERS,
           note="The paper gives the speed of its machine, 0 to 2 m/s; mass, radius and rubber are chosen."),
    Figure("5", "signal of a steel ball on rubber: the total force over its peak", _MADE_BY,
           "time of the peak, width and centroid over the contact time, no per cent", _figure_5, SHAPE_ONLY, PARAMETERS),
)  # fmt: skip
