"""Belt of an inflated tire: a ring under tension on the sidewalls, that bends along and is rigid
across.

Inflation carries the wheel through the belt. The sidewalls are membranes, arcs of half angle phi
over a chord c: they take a share of the pressure on the belt of width b, and hold it with a spring
that grows with the pressure. The belt takes the rest as a hoop:

* share ``f = 1 - (c / b) cot phi``, tension ``T = f p b R``;
* radial foundation of both sidewalls ``k_r = k_0 + C p``, ``C = (cos phi + phi sin phi) / (sin phi -
  phi cos phi)``, from an arc of fixed length.

Under a unit line force the inextensible ring takes the form

    G(x) = 1 / (pi R) sum over n >= 2 of cos(n x / R) / D_n
    D_n = k_r + k_t / n^2 + T (n^2 - 1) / R^2 + B (n^2 - 1)^2 / R^4

The translation n = 1 is not in G: it is the rigid ring on the sidewalls, of stiffness K_b, which
moves the whole contact by F / K_b. There is no n = 0. G changes its sign at 0.15 m; with all D_n
above 0 the sum with the half-space is positive definite, and one solve finds both in series.

Under a flat road the belt is straight, so it pushes with ``T / R + k_r w`` along the contact: a
plateau of f p, and what the sidewalls add to it.

``C p`` is the sidewalls' stiffness at rest. As the belt comes closer to the rim by w, the ring's
translation included, their arcs keep the length L = phi c / sin phi and open:

    S(w) = 2 p (h_0 - h),  h = L cos phi' / (2 phi'),  sin phi' / phi' = (c - w) / L

What they bear less, ``D(x) = C p w - S(w)``, loads the belt beside the road:

    w = G * (q + D) + c (F + sum c D) / K_b,  c = cos(x / R)

since the ring's translation moves the belt by c; D is that of the lower half, found in
``sidewalls.py``.

Valid for 120 to 300 kPa, deflections up to 40 mm, road slopes that are small, contact within 0.12 m
of its middle. Sources: Gong, A study of in-plane dynamics of tires (1993), for the ring; Pacejka,
Tire and Vehicle Dynamics, ch. 9, for the rigid ring; the membrane is derived in
``rigs/vehicle/tire/README.md``.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require, require_positive
from contact_sim_pkg.pressure.settings import InflatedBelt, SidewallArc

__all__ = [
    "arc_force", "belt_share", "inflated_influence", "make_belt", "membrane_stiffness", "ring_modes",
    "ring_stiffness", "rubber_share", "stiffened",
]  # fmt: skip

Field = NDArray[numpy.float64]

MODES = 1000
"""Of the sum: 5e-8 of G at the force."""

ARC_POINTS = 2000
"""Of the table of S: straight lines between them miss 1e-6 of it."""

STRAIGHTER, CLOSED = 0.7, 2.4  # ends of that table: of phi, and [rad]; the belt is near the rim

NOMINAL_PRESSURE = 220e3  # [Pa]
OF_RUBBER = 0.5
"""Share of the structural stiffness k_0 that has the memory of rubber, the rest is cord; fitted to the
rolling resistance over load and inflation.
"""

OF_STRUCTURE = 0.25
"""Share of the rigid ring's stiffness at the nominal pressure that is there without inflation; a
choice.
"""


def belt_share(half_angle: float, chord: float, width: float) -> float:
    """Share [1] of the inflation that the hoop tension of the belt carries, ``1 - (c / b) cot phi``.

    half_angle: phi [rad] of the sidewall's arc; chord: c [m] of it; width: b [m] of the belt under
    pressure. Raises ValueError unless 0 < phi < pi, c, b > 0, and where the sidewalls carry all.
    """
    phi = require("half_angle", half_angle, "rad", above=0.0, below=math.pi)
    share = 1.0 - require_positive("chord", chord, "m") / require_positive("width", width, "m") / math.tan(phi)
    return require("share of the inflation on the belt", share, above=0.0)


def membrane_stiffness(half_angle: float) -> float:
    """Radial stiffness of two sidewalls, per circumference and inflation [N/m^2/Pa = 1]: C.

    half_angle: phi [rad]. Raises ValueError unless 0 < phi < pi.
    """
    phi = require("half_angle", half_angle, "rad", above=0.0, below=math.pi)
    return (math.cos(phi) + phi * math.sin(phi)) / (math.sin(phi) - phi * math.cos(phi))


def ring_stiffness(nominal: float, pressure: float) -> float:
    """Stiffness [N/m] of the rigid ring against the rim at an inflation of ``pressure`` [Pa], where
    it is ``nominal`` [N/m] at 220 kPa.
    """
    return nominal * (OF_STRUCTURE + (1.0 - OF_STRUCTURE) * pressure / NOMINAL_PRESSURE)


def make_belt(
    pressure: float, radius: float, half_angle: float, chord: float, width: float, structure: float,
    tangential: float, bending: float, ring: float, ring_is_body: bool = False,
) -> InflatedBelt:  # fmt: skip
    """The belt of a tire of free ``radius`` [m] at an inflation of ``pressure`` [Pa].

    half_angle [rad], chord, width [m] of the sidewalls and the belt; structure: k_0, tangential: k_t
    [N/m^2]; bending: B [N m^2]; ring: K_b [N/m]; ring_is_body: whether the rigid ring is a body of its own.
    """
    share = belt_share(half_angle, chord, width)
    return InflatedBelt(
        radius, share * pressure * width * radius, structure + membrane_stiffness(half_angle) * pressure, tangential,
        bending, 0.0 if ring_is_body else 1.0 / ring, SidewallArc(pressure, half_angle, chord, 1.0 / ring),
        OF_RUBBER * structure,
    )  # fmt: skip


def stiffened(belt: InflatedBelt, factor: float) -> InflatedBelt:
    """The belt with its rubber, bending and a part of the sidewalls, stiffer by a ``factor``; tension and the rest of
    the foundation are the inflation's.
    """
    rubber = factor * belt.rubber
    return belt._replace(
        bending=factor * belt.bending, rubber=rubber, foundation=belt.foundation + rubber - belt.rubber
    )


def rubber_share(belt: InflatedBelt, stiffer: float, rows: int, cell_x: float) -> Field:
    """What a unit curve imposed on the rubber alone is of the belt, i cells of ``cell_x`` [m] away from it, [rows] [1]:
    ``V_n / (D_n + S V_n)`` of every mode n, V_n the part of D_n of the rubber, S how much ``stiffer`` it is, >= 0.

    Of the shortest waves of a belt that bends 1 / (1 + S): that stands where the curve does, the rest is a sum that
    converges.
    """
    n = numpy.arange(MODES + 1, dtype=numpy.float64)
    rigidity, rubber = ring_modes(belt, numpy.maximum(n, 2.0))
    rubber[:2] = 0.0  # translations
    shortest = 1.0 / (1.0 + stiffer) if belt.bending > 0.0 else 0.0
    weight = rubber / (rigidity + stiffer * rubber) - shortest
    weight *= numpy.sinc(0.5 * n * cell_x / belt.radius / math.pi) * cell_x / (math.pi * belt.radius)
    weight[0] *= 0.5
    share = numpy.cos(numpy.outer(numpy.arange(rows) * cell_x / belt.radius, n)) @ weight
    share[0] += shortest
    return numpy.asarray(share)


def ring_modes(belt: InflatedBelt, n: Field) -> tuple[Field, Field]:
    """Rigidity D_n and what of it is rubber, V_n [N/m^2], of the modes ``n`` >= 2 of the ring."""
    bends = belt.bending * (n**2 - 1.0) ** 2 / belt.radius**4
    rigidity = belt.foundation + belt.tangential / n**2 + belt.tension * (n**2 - 1.0) / belt.radius**2 + bends
    return rigidity, belt.rubber + bends


def inflated_influence(
    belt: InflatedBelt, rows: int, cols: int, cell_x: float, cell_y: float
) -> NDArray[numpy.float64]:
    """Displacement [m/Pa] i rows and j cols away from a cell under unit pressure, [rows, cols]; the
    same for every j.

    The exact integral of G over the loaded cell, term n of it by ``sin(n c / 2R) / (n c / 2R)``, and
    the translation of the rigid ring. cell_x, cell_y: size of a cell [m].
    """
    along = _influence_along(belt, rows, cell_x)
    return numpy.repeat(((along + belt.ring_compliance) * cell_x * cell_y)[:, None], cols, axis=1)


@lru_cache(16)  # grids of one tire
def _influence_along(belt: InflatedBelt, rows: int, cell_x: float) -> Field:
    """The sum over the modes, a cell's length taken out [m/N], [rows]."""
    n = numpy.arange(2, MODES + 1, dtype=numpy.float64)
    half = 0.5 * n * cell_x / belt.radius
    weight = numpy.sin(half) / half / ring_modes(belt, n)[0] / (math.pi * belt.radius)
    return numpy.asarray(numpy.cos(numpy.outer(numpy.arange(rows) * cell_x / belt.radius, n)) @ weight)


def arc_force(arc: SidewallArc) -> tuple[Field, Field]:
    """How much closer [m] the belt is to the rim, increasing, and the force S [N/m] of both sidewalls
    against that, [points]. It goes on straight beyond both ends.
    """
    length = arc.half_angle * arc.chord / math.sin(arc.half_angle)
    opened = numpy.linspace(STRAIGHTER * arc.half_angle, CLOSED, ARC_POINTS)
    closer = arc.chord - length * numpy.sin(opened) / opened
    height = 0.5 * length * numpy.cos(opened) / opened
    rest = 0.5 * length * math.cos(arc.half_angle) / arc.half_angle
    return closer, 2.0 * arc.pressure * (rest - height)
