"""Lower surface of a seated person, and the surface of the back, as gaps over a flat cushion.

Sections of buttocks, thighs and back are superellipses: ``S(rho; c, n) = c (1 - (1 - rho)^(1/n))``
is the height over the lowest point, continued along its tangent from rho = 0.95.

The pan: each side is one surface from hip to knee,
``S(|x-/a|^n + |(y - y_c)/w|^n; c, n) + floor - t/(1 + (x^2 + Y^2)/r^2)``, x forward from the
tuberosities, y left. x- is the part of x behind them, so that the buttock closes as a superellipsoid
and the thigh goes on from it; its middle ``y_c``, half width ``w`` and lowest line ``floor`` turn
from their courses under the buttock into those of the thigh over 80 mm, by
``(x + sqrt(x^2 + l^2))/2`` in place of the larger of x and 0. The last term is the tuberosity, Y
from its middle: half its depth at r, a fifth at 2 r. A smooth minimum of width 4 mm joins the
sides. Height and slope are continuous everywhere, and the outline at every depth has no waist.

The back: x up from its lower edge, y left.

The shape is that under load: soft tissue is not compressed again. Its form is a choice of this
project; the sizes scale with body dimensions: hip breadth sitting (Pheasant and Haslegrave,
Bodyspace, 2006; US adults: 5th percentile woman 310 mm, 50th man 360, 95th man 410) and buttock to
popliteal length (440, 495, 550 mm).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require, require_fields, require_values

__all__ = ["PERCENTILES", "LumbarSupport", "Sitter", "back_gap", "pan_gap"]

Field = NDArray[numpy.float64]
BLEND = 0.004  # [m] width of the smooth minimum
TURN = 0.08  # [m] over which the buttock turns into the thigh, of the 50th percentile
FINE = 0.002  # [m] lattice on which the lowest point is sought
TANGENT_FROM = 0.95
FARTHEST = 10.0  # [m] of a cell from the origin


class Sitter(NamedTuple):
    """Sizes of a person by percentile."""

    mass: float  # [kg] whole body
    breadth: float  # hip breadth over that of the 50th percentile
    length: float  # buttock to popliteal length over that of the 50th percentile


PERCENTILES = {5: Sitter(50.0, 0.86, 0.89), 50: Sitter(78.0, 1.0, 1.0), 95: Sitter(102.0, 1.14, 1.11)}
"""Percentile -> person: 5 a woman, 50 and 95 men."""


class LumbarSupport(NamedTuple):
    """Bulge of the seat back under the lumbar spine, as wide as the back."""

    depth: float = 0.0  # [m] in its middle; 0: none
    height: float = 0.20  # [m] of its middle over the lower edge
    length: float = 0.06  # [m] of its standard deviation up the back


def pan_gap(sitter: Sitter, x: Field, y: Field, tilt: float = 0.0) -> Field:
    """Gap [m] of buttocks and thighs over their lowest point, [len(x), len(y)].

    x: [m] forward of the tuberosities; y: [m] left; tilt: [rad] of the pan, front up,
    less than a right angle. Both rise, at least two of each within 10 m. Raises ValueError outside.
    """
    _require_sitter(sitter)
    require("tilt", tilt, "rad", above=-0.5 * math.pi, below=0.5 * math.pi)
    return _over_lowest(lambda along, across: _lower_surface(sitter, along, across) - math.tan(tilt) * along, x, y)


def back_gap(sitter: Sitter, support: LumbarSupport, x: Field, y: Field) -> Field:
    """Gap [m] of the back over its lowest point, [len(x), len(y)].

    x: [m] up from the lower edge of the seat back; y: [m] left; both rise, at least two of each
    within 10 m. Raises ValueError outside.
    """
    _require_sitter(sitter)
    require_fields("lumbar support", support, positive="length", not_negative="depth", finite="height")
    b, s = sitter.breadth, sitter.length

    def surface(up: Field, across: Field) -> Field:
        spine = 0.006 * numpy.exp(-(across**2) / (2.0 * 0.020**2))
        lumbar = 0.014 * numpy.exp(-0.5 * ((up - 0.20 * s) / (0.09 * s)) ** 2)
        shoulders = numpy.maximum(up - 0.42 * s, 0.0) ** 2 / (2.0 * 0.35 * s)
        pelvis = numpy.maximum(0.10 - up, 0.0) ** 2 / 0.5
        bend = (up - 0.28 * s) ** 2 / (4.0 * 0.9 * s)
        supported = support.depth * numpy.exp(-0.5 * ((up - support.height) / support.length) ** 2)
        trunk = _superellipsoid(numpy.abs(across / (0.19 * b)) ** 2.2, 0.09, 2.2)
        return numpy.asarray(trunk + spine + lumbar + shoulders + pelvis + bend - supported)

    return _over_lowest(surface, x, y)


def _require_sitter(sitter: Sitter) -> None:
    require_fields("sitter", sitter, positive="mass breadth length")


def _places(name: str, values: Field) -> Field:
    """Rising places [m] of cells, at least two."""
    found = require_values(name, values, "m", shape=(None,), rising=True, least=-FARTHEST, most=FARTHEST)
    if len(found) < 2:
        raise ValueError(f"{name}: shape {found.shape}, at least two places are needed")
    return found


def _lower_surface(sitter: Sitter, along: Field, across: Field) -> Field:
    """Height [m] of buttocks and thighs over any plane."""
    b, s = sitter.breadth, sitter.length
    half, forward = 0.5 * 0.125 * b, _ahead(along, s)
    # Along the thigh the middle goes outwards, the section grows narrower, the lowest line rises.
    part = forward / (0.32 * s)
    outwards, width = half + 0.05 * b * part, 0.130 * b / (1.0 + 0.12 * part)
    floor = 0.012 * forward + _ahead(along - 0.18 * s, s) ** 2 / (2.0 * 0.30 * s)
    behind = (numpy.maximum(-along, 0.0) / (0.166 * s)) ** 2.4
    sides = []
    for side in (-1.0, 1.0):
        section = numpy.abs((across - side * outwards) / width) ** 2.4
        distance = (along**2 + (across - side * half) ** 2) / (0.042 * s) ** 2
        sides.append(_superellipsoid(behind + section, 0.092 * s, 2.4) + floor - 0.019 / (1.0 + distance))
    return _smooth_minimum(sides)


def _ahead(along: Field, length: float) -> Field:
    """The larger of ``along`` [m] and 0, rounded over ``length`` times TURN."""
    return numpy.asarray(0.5 * (along + numpy.hypot(along, TURN * length)))


def _over_lowest(surface: Callable[[Field, Field], Field], x: Field, y: Field) -> Field:
    """A surface [m] over its lowest point between the ends of x and y, which lies on no cell."""
    x, y = _places("x", x), _places("y", y)
    on_cells = surface(x[:, None], y[None, :])
    fine = surface(numpy.arange(x[0], x[-1], FINE)[:, None], numpy.arange(y[0], y[-1], FINE)[None, :])
    return numpy.asarray(on_cells - min(float(fine.min()), float(on_cells.min())))


def _superellipsoid(rho: Field, height: float, power: float) -> Field:
    """S(rho; height, power) in [m]."""
    inside = numpy.minimum(rho, TANGENT_FROM)
    slope = height / power * (1.0 - TANGENT_FROM) ** (1.0 / power - 1.0)
    return numpy.asarray(height * (1.0 - (1.0 - inside) ** (1.0 / power)) + slope * (rho - inside))


def _smooth_minimum(pieces: list[Field]) -> Field:
    """-BLEND log(sum of exp(-z/BLEND)) of all pieces z in [m]."""
    least = numpy.minimum.reduce(pieces)
    total = numpy.zeros_like(least)
    for each in pieces:
        total += numpy.exp(-(each - least) / BLEND)
    return numpy.asarray(least - BLEND * numpy.log(total))
