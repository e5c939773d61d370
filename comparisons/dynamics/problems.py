"""The six problems, each with an answer in closed form, and what an engine must offer to be measured on them."""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

import numpy
from numpy.typing import NDArray

from contact_sim_lab.twins.rigid_impact import newton_by_enumeration

__all__ = ["GRAVITY", "PROBLEMS", "SIDE", "Engine", "Outcome", "Start", "measure"]

Array = NDArray[numpy.float64]
GRAVITY, SIDE, RADIUS = 9.81, 0.1, 0.05
GAP = 1e-10  # [m] under the corner that is about to hit: the turn until then is an error of all
PROBLEMS = (
    "restitution", "block impact", "slope creep", "slide to a stop", "elastic energy", "box on four contacts",
)  # fmt: skip


class Start(NamedTuple):
    """A body over the plane z = 0: a box of the side 0.1 m and 1 kg, or a ball of radius 0.05 m and 1 kg."""

    ball: bool
    height: float  # [m] of the centre
    pitch: float = 0.0  # [rad] about y
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    spin: float = 0.0  # [rad/s] about y
    friction: float = 0.3
    restitution: float = 0.0
    gravity: tuple[float, float, float] = (0.0, 0.0, -GRAVITY)


class Engine(Protocol):
    """One engine at one step: a world with one body."""

    def place(self, start: Start) -> None:
        """Make the world anew."""

    def run(self, seconds: float) -> None:
        """Go on for a time."""

    def state(self) -> tuple[Array, Array, Array]:
        """Position, velocity and angular velocity in world axes."""

    def loads(self) -> Array:
        """Normal forces [N] of the contact points at rest; empty where the engine does not tell."""


class Outcome(NamedTuple):
    """Error of a problem, its unit, and the time that was simulated [s]."""

    error: float
    unit: str
    simulated: float


def measure(problem: str, engine: Engine, step: float) -> Outcome:
    """Run one problem."""
    return _RUNS[problem](engine, step)


def _restitution(engine: Engine, step: float) -> Outcome:
    """Height to which a ball dropped from 1 m comes back, e 0.8, as an error of e."""
    engine.place(Start(True, 1.0 + RADIUS, restitution=0.8))
    first = math.sqrt(2.0 / GRAVITY)
    engine.run(first + 0.3)
    position, velocity, _spin = engine.state()
    speed = math.sqrt(max(0.0, float(velocity[2]) ** 2 + 2.0 * GRAVITY * (float(position[2]) - RADIUS)))
    return Outcome(abs(speed / math.sqrt(2.0 * GRAVITY) - 0.8), "of e", first + 0.3)


def _impact(engine: Engine, step: float) -> Outcome:
    """Worst velocity after eight corner impacts without gravity, e 0 and friction 0.2, over the greatest before."""
    generator, worst, simulated = numpy.random.default_rng(3), 0.0, 0.0
    for _ in range(8):
        theta, v_x, v_z, spin = generator.uniform([0.3, -2.0, -3.0, -2.0], [0.7, 2.0, -1.0, 2.0])
        reach = SIDE / math.sqrt(2.0)
        corner = numpy.array([reach * math.sin(math.pi / 4 - theta), -reach * math.cos(math.pi / 4 - theta)])
        height = GAP - float(corner[1])
        start = Start(False, height, theta, (v_x, 0.0, v_z), spin, 0.2, 0.0, (0.0, 0.0, 0.0))
        expected = _after_impact(numpy.array([v_x, v_z, spin]), corner)
        engine.place(start)
        seconds = max(min(20.0 * step, 5e-3), 2.0 * step)  # before the next corner comes down
        engine.run(seconds)
        simulated += seconds
        _position, velocity, turning = engine.state()
        found = numpy.array([velocity[0], velocity[2], turning[1]])
        scale = numpy.array([1.0, 1.0, SIDE])
        worst = max(worst, numpy.abs(scale * (found - expected)).max() / numpy.abs(scale * (v_x, v_z, spin)).max())
    return Outcome(float(worst), "of the velocity", simulated)


def _after_impact(v: Array, arm: Array) -> Array:
    """Velocity (x, z, spin about y) after an impact at the corner ``arm`` = (x, z), by enumeration of index sets."""
    rows = numpy.array([[0.0, 1.0, -arm[0]], [1.0, 0.0, arm[1]]])
    inverse = numpy.array([1.0, 1.0, 6.0 / SIDE**2])
    impulse = newton_by_enumeration(rows * inverse @ rows.T, 0.2, 0.0, rows @ v)
    return numpy.asarray(v + inverse * (rows.T @ impulse))


def _creep(engine: Engine, step: float) -> Outcome:
    """Mean speed between 1 s and 5 s of a box on a slope of 15°, friction 0.3; gravity leans instead of the plane."""
    lean = math.radians(15.0)
    engine.place(Start(False, 0.5 * SIDE, gravity=(-GRAVITY * math.sin(lean), 0.0, -GRAVITY * math.cos(lean))))
    engine.run(1.0)
    first = engine.state()[0]
    engine.run(4.0)
    return Outcome(float(numpy.abs((engine.state()[0] - first)[:2]).max()) / 4.0, "m/s", 5.0)


def _slide(engine: Engine, step: float) -> Outcome:
    """Distance in which a box at 2 m/s stops, friction 0.3, relative."""
    engine.place(Start(False, 0.5 * SIDE, velocity=(2.0, 0.0, 0.0)))
    engine.run(1.0)
    return Outcome(abs(float(engine.state()[0][0]) / (4.0 / (2.0 * 0.3 * GRAVITY)) - 1.0), "of the distance", 1.0)


def _elastic(engine: Engine, step: float) -> Outcome:
    """Energy of a ball after 5 s of elastic bounces from 0.1 m, relative."""
    engine.place(Start(True, 0.1 + RADIUS, friction=0.0, restitution=1.0))
    engine.run(5.0)
    position, velocity, _spin = engine.state()
    energy = 0.5 * float(velocity @ velocity) + GRAVITY * (float(position[2]) - RADIUS)
    return Outcome(abs(energy / (0.1 * GRAVITY) - 1.0), "of the energy", 5.0)


def _rest(engine: Engine, step: float) -> Outcome:
    """Loads of the four corners of a box at rest after 1 s against a quarter of its weight each, relative."""
    engine.place(Start(False, 0.5 * SIDE))
    engine.run(1.0)
    loads = engine.loads()
    corners = numpy.zeros(max(4, len(loads)))
    corners[: len(loads)] = loads
    return Outcome(float(numpy.abs(corners / (0.25 * GRAVITY) - 1.0).max()), "of a load", 1.0)


_RUNS = {
    "restitution": _restitution, "block impact": _impact, "slope creep": _creep, "slide to a stop": _slide,
    "elastic energy": _elastic, "box on four contacts": _rest,
}  # fmt: skip
