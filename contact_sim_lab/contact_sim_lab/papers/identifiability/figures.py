"""Figure 1 of *Identifiability*: the block in free fall, and what becomes of it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy
from numpy.typing import NDArray
from scipy.optimize import brentq

from contact_sim_lab.papers.runs import series_of
from contact_sim_lab.records.paper import Drawn, Figure, Number, Values
from contact_sim_lab.twins.rigid_impact import energetic_by_path

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["FIGURES"]

Array = NDArray[Any]

SCENE, SIDE, GRAVITY, HEIGHT, TILT = (
    "block_fall",
    0.1,
    9.81,
    0.2,
    0.2,
)  # [m], [m/s^2], [m] under the lowest corner, [rad]
FRICTION, RESTITUTION = 0.3, 0.3  # of the scene
START = HEIGHT + 0.5 * SIDE * (math.cos(TILT) + math.sin(TILT))  # [m] of the centre


def _first_impact(time: Array, height: Array, speed: Array) -> float:
    """Instant [s] of the first impact: the fall before it and the flight after it meet there."""
    after = int(numpy.argmax(numpy.abs(speed + GRAVITY * time) > 1e-6))

    def apart(instant: float) -> float:
        span = time[after] - instant
        return float(
            height[0] - 0.5 * GRAVITY * instant**2 + speed[after] * span + 0.5 * GRAVITY * span**2 - height[after]
        )

    return float(brentq(apart, time[after - 1] - 1e-6, time[after] + 1e-6, xtol=1e-12))


def _outline(x: float, z: float, pitch: float) -> tuple[Array, Array]:
    """Outline of the block; a pitch about y turns x to -z."""
    corners = 0.5 * SIDE * numpy.array([(1, 1), (-1, 1), (-1, -1), (1, -1), (1, 1)])
    cosine, sine = math.cos(pitch), math.sin(pitch)
    return x + cosine * corners[:, 0] + sine * corners[:, 1], z - sine * corners[:, 0] + cosine * corners[:, 1]


def _left_by_impact() -> Array:
    """Velocity [3] (x, z [m/s] and pitch rate [rad/s]) behind the first impact of the falling block by the twin: A and
    the slip of its lowest corner, at (x, z) from the centre.
    """
    arm = -0.5 * SIDE * numpy.array([math.cos(TILT) - math.sin(TILT), math.cos(TILT) + math.sin(TILT)])
    rows = numpy.array([[0.0, 1.0, -arm[0]], [1.0, 0.0, arm[1]]])  # pitch about y turns x to -z
    inverse = numpy.diag([1.0, 1.0, 6.0 / SIDE**2])  # of a homogeneous square of 1 kg
    before = numpy.array([0.0, -math.sqrt(2.0 * GRAVITY * HEIGHT), 0.0])
    impulse = energetic_by_path(rows @ inverse @ rows.T, FRICTION, RESTITUTION, rows @ before)
    return numpy.asarray(before + inverse @ rows.T @ impulse)


def _figure_1(values: Values) -> Drawn:
    found = series_of("bench/motion", SCENE, f"block.position=[0.0, 0.0, {START!r}]")
    x, z, pitch = (found[f"position.block_{name}"] for name in ("x", "z", "pitch"))
    v_x, v_z, rate = (found[f"velocity.block_{name}"] for name in ("x", "z", "pitch"))
    energy = 0.5 * (v_x**2 + v_z**2) + SIDE**2 / 12.0 * rate**2 + GRAVITY * z  # of a homogeneous square of 1 kg
    lowest = numpy.array([_outline(*each)[1].min() for each in zip(x, z, pitch, strict=True)])
    turns = pitch[-1] / (0.5 * math.pi)
    # Of the flight behind the first impact, back to its instant.
    after, fallen = int(numpy.argmax(numpy.abs(v_z + GRAVITY * found.time) > 1e-6)), math.sqrt(2.0 * HEIGHT / GRAVITY)
    left = (v_x[after], v_z[after] + GRAVITY * (found.time[after] - fallen), rate[after])
    origin = "energetic rule along the path of the impulse, by scipy"
    numbers = [
        Number("first impact", "s", _first_impact(found.time, z, v_z), math.sqrt(2.0 * HEIGHT / GRAVITY), 1e-5, "√(2h/g)"),
        *(
            Number(f"{what} behind it", unit, float(own), float(other), 1e-11, origin)
            for what, unit, own, other in zip(
                ("v_x", "v_z", "pitch rate"), ("m/s", "m/s", "rad/s"), left, _left_by_impact(), strict=True
            )
        ),
        Number("largest rise of the energy between samples over m g h", "",
               float(max(numpy.diff(energy).max(), 0.0)) / (GRAVITY * HEIGHT), 0.0, 1e-6, "energy is not supplied: it never grows"),
        Number("depth below the ground, largest", "m", float(max(-lowest.min(), 0.0)), 0.0, 1e-6, "the ground is rigid"),
        Number("quarter turns at rest", "", turns, float(round(turns)), 1e-6, "a square rests on a face"),
        Number("height of the centre at rest", "m", float(z[-1]), 0.5 * SIDE, 1e-6, "half the side"),
        Number("speed at the end", "m/s", float(math.hypot(v_x[-1], v_z[-1])), 0.0, 1e-9, "it is at rest"),
    ]  # fmt: skip

    def draw(canvas: Canvas) -> None:
        path, lost = canvas.subplots(1, 2, width_ratios=(1.3, 1.0))
        colours = numpy.linspace(0.85, 0.0, 16)
        for shade, k in zip(colours, numpy.linspace(0, len(z) - 1, 16).astype(int), strict=True):
            path.plot(*_outline(x[k], z[k], pitch[k]), color=str(shade), linewidth=0.9)
        path.plot(x, z, "C3", linewidth=0.8, label="centre")
        path.axhline(0.0, color="k")
        path.set(xlabel="x, m", ylabel="z, m", aspect="equal")
        path.legend()
        lost.plot(found.time, energy / (GRAVITY * z[0]))
        lost.axvline(math.sqrt(2.0 * HEIGHT / GRAVITY), color="k", linestyle=":")
        lost.set(xlabel="t, s   (dotted: √(2h/g))", ylabel="energy over that at the start")

    return Drawn(numbers, draw, (8.4, 4.2))


FIGURES: tuple[Figure, ...] = (
    Figure("1", "square block that falls on a corner", (f"scene {SCENE}",),
           "fall √(2h/g), velocity behind the first impact by scipy, energy never up, rests on a face", _figure_1,
           note="The paper's only drawing shows the block in free fall, without numbers."),
)  # fmt: skip
