"""The rig as a line drawing made from its scene: parts on each other, from the ground upwards, each with its name and
value. A rig lists its parts; the line of conditions is the same list as text.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

from markupsafe import Markup

from contact_sim_pkg.excitation.kinds import RoadKind, kind_known

__all__ = [
    "Part", "Sketch", "at", "ball", "conditions_of", "drawing_of", "floor_part", "foam", "ground", "leaning", "mass",
    "parts_of_scene", "pushed", "road_parts", "sitter", "spring_and_damper", "tire",
]  # fmt: skip

WIDTH, AXIS, LABELS = 300.0, 62.0, 128.0
"""[px] of the drawing, of the line that the parts stand on, and where their labels begin."""
LINE = 15.0
"""[px] of a line of text"""
LETTERS = 24
"""of a line of a label, in the widest of the page's fonts"""


class Sketch:
    """Lines, circles and texts; y upwards from the ground, in [px]."""

    def __init__(self) -> None:
        """An empty drawing."""
        self._shapes: list[Markup] = []

    def path(self, points: Sequence[tuple[float, float]], kind: str = "line", *, closed: bool = False) -> None:
        """A line through points; ``kind``: class of its style, `line`, `fill`, `soft` or `move`."""
        text = " ".join(f"{x:.1f},{-y:.1f}" for x, y in points)
        self._shapes.append(
            Markup('<{} class="{}" points="{}"/>').format("polygon" if closed else "polyline", kind, text)
        )

    def circle(self, x: float, y: float, radius: float, kind: str = "fill") -> None:
        """A circle about a point."""
        self._shapes.append(
            Markup('<circle class="{}" cx="{:.1f}" cy="{:.1f}" r="{:.1f}"/>').format(kind, x, -y, radius)
        )

    def box(self, low_x: float, low_y: float, high_x: float, high_y: float, kind: str = "fill") -> None:
        """A rectangle."""
        self.path([(low_x, low_y), (high_x, low_y), (high_x, high_y), (low_x, high_y)], kind, closed=True)

    def label(self, y: float, name: str, value: str) -> None:
        """Name and value of a part, about the height ``y``."""
        lines = [*((text, "name") for text in _folded(name)), *((text, "value") for text in _folded(value))]
        top = y + LINE * (0.5 * len(lines) - 0.75)
        for place, (text, kind) in enumerate(lines):
            self._shapes.append(
                Markup('<text class="{}" x="{:.0f}" y="{:.1f}">{}</text>').format(
                    kind, LABELS, place * LINE - top, text
                )
            )

    def svg(self, height: float, description: str) -> Markup:
        """The drawing as an element of a page, from the ground to a ``height``."""
        frame = Markup(
            '<svg class="sketch" role="img" aria-label="{}" viewBox="0 {:.0f} {:.0f} {:.0f}" width="{:.0f}">'
        )
        shapes = Markup("").join(self._shapes)
        return frame.format(description, -height - 8.0, WIDTH, height + 30.0, WIDTH) + shapes + Markup("</svg>")


Glyph: TypeAlias = Callable[[Sketch, float], float]
"""Draws a part that stands on a height [px], and returns the height of its upper end."""


class Part(NamedTuple):
    """One part of a rig."""

    name: str
    value: str
    glyph: Glyph | None = None
    """None: named under the drawing's conditions alone"""


def drawing_of(parts: Sequence[Part], title: str) -> Markup:
    """Parts on each other, the first one lowest."""
    sketch, height, free = Sketch(), 0.0, -math.inf
    for part in parts:
        if part.glyph is None:
            continue
        top = part.glyph(sketch, height)
        # labels make room for each other, parts stand on each other
        reach = 0.5 * LINE * (len(_folded(part.name)) + len(_folded(part.value))) + 2.0
        middle = max(0.5 * (height + top), free + reach)
        sketch.label(middle, part.name, part.value)
        height, free = top, middle + reach
    height = max(height, free)
    return sketch.svg(height, f"Drawing of the rig: {title}")


def conditions_of(parts: Sequence[Part]) -> str:
    """The parts as one line."""
    return " · ".join(f"{part.name} {part.value}".strip() for part in parts)


def ground(sketch: Sketch, y: float) -> float:
    """Hatched ground."""
    low, high = AXIS - 48.0, AXIS + 48.0
    sketch.path([(low, y), (high, y)])
    for place in range(8):
        x = low + 6.0 + 12.0 * place
        sketch.path([(x, y), (x - 7.0, y - 9.0)], "soft")
    return y


def rough_road(sketch: Sketch, y: float) -> float:
    """Uneven ground."""
    heights = (0, 3, 1, 5, 2, 4, 0, 3, 5, 1, 2, 0, 4, 1, 3, 0, 2)
    low = AXIS - 48.0
    sketch.path([(low + 6.0 * place, y + height) for place, height in enumerate(heights)])
    for place in range(8):
        sketch.path([(low + 6.0 + 12.0 * place, y - 2.0), (low - 1.0 + 12.0 * place, y - 11.0)], "soft")
    return y


def drum(sketch: Sketch, y: float) -> float:
    """The top of a drum."""
    radius = 90.0
    sketch.path([(AXIS + x, y - radius + math.sqrt(radius**2 - x**2)) for x in map(float, range(-48, 49, 4))])
    return y


def shaken(sketch: Sketch, y: float) -> float:
    """A floor that moves up and down."""
    sketch.box(AXIS - 48.0, y, AXIS + 48.0, y + 8.0, "soft")
    _both_ways(sketch, (AXIS - 54.0, y - 12.0), (AXIS - 54.0, y + 20.0))
    return y + 8.0


def shaken_along(sketch: Sketch, y: float) -> float:
    """A floor that moves to and fro."""
    sketch.box(AXIS - 48.0, y, AXIS + 48.0, y + 8.0, "soft")
    _both_ways(sketch, (AXIS - 20.0, y - 10.0), (AXIS + 20.0, y - 10.0))
    return y + 8.0


def tire(sketch: Sketch, y: float) -> float:
    """A wheel with its tire, flattened on the ground."""
    sketch.circle(AXIS, y + 30.0, 31.0)
    sketch.circle(AXIS, y + 30.0, 17.0, "line")
    sketch.path([(AXIS - 16.0, y), (AXIS + 16.0, y)], "move")
    return y + 62.0


def spring_and_damper(sketch: Sketch, y: float) -> float:
    """A spring beside a damper."""
    top, x = y + 46.0, AXIS - 13.0
    sketch.path([(x, y), (x, y + 8.0), *((x + (8.0 if place % 2 else -8.0), y + 12.0 + 4.0 * place) for place in range(6)),
                 (x, y + 37.0), (x, top)])  # fmt: skip
    x = AXIS + 13.0
    sketch.path([(x, y), (x, y + 16.0)])
    sketch.path([(x - 7.0, y + 30.0), (x - 7.0, y + 16.0), (x + 7.0, y + 16.0), (x + 7.0, y + 30.0)])
    sketch.path([(x - 5.0, y + 24.0), (x + 5.0, y + 24.0)])
    sketch.path([(x, y + 24.0), (x, top)])
    return top


def mass(sketch: Sketch, y: float) -> float:
    """A rigid mass."""
    sketch.box(AXIS - 36.0, y, AXIS + 36.0, y + 30.0)
    return y + 30.0


def foam(sketch: Sketch, y: float) -> float:
    """A cushion."""
    sketch.box(AXIS - 44.0, y, AXIS + 44.0, y + 22.0, "soft")
    for place in range(7):
        for row in range(2):
            sketch.circle(AXIS - 37.0 + 12.0 * place + 6.0 * row, y + 7.0 + 9.0 * row, 2.0, "line")
    return y + 22.0


def sitter(sketch: Sketch, y: float) -> float:
    """An occupant who sits."""
    back = AXIS - 20.0
    sketch.path([(back, y + 8.0), (back, y + 52.0)], "limb")
    sketch.path([(back, y + 8.0), (AXIS + 26.0, y + 8.0)], "limb")
    sketch.circle(back + 2.0, y + 72.0, 11.0)
    return y + 84.0


def leaning(sketch: Sketch, y: float) -> float:
    """A seat back, its foam, and the back that leans on it."""
    sketch.path([(AXIS - 34.0, y), (AXIS - 46.0, y + 74.0)], "limb")
    sketch.path([(AXIS - 16.0, y + 4.0), (AXIS - 26.0, y + 60.0)], "limb")
    sketch.circle(AXIS - 22.0, y + 78.0, 10.0)
    sketch.path([(AXIS - 16.0, y + 4.0), (AXIS + 26.0, y + 4.0)], "limb")
    return y + 90.0


def ball(sketch: Sketch, y: float) -> float:
    """A sphere."""
    sketch.circle(AXIS, y + 26.0, 26.0)
    return y + 52.0


def pushed(sketch: Sketch, y: float) -> float:
    """An arrow downwards."""
    sketch.path([(AXIS, y + 36.0), (AXIS, y + 5.0)], "move")
    sketch.path([(AXIS - 5.0, y + 13.0), (AXIS, y + 5.0), (AXIS + 5.0, y + 13.0)], "move")
    return y + 36.0


def _both_ways(sketch: Sketch, first: tuple[float, float], last: tuple[float, float]) -> None:
    """An arrow with two heads, upright or level."""
    sketch.path([first, last], "move")
    for (x, y), sign in ((first, 1.0), (last, -1.0)):
        ends = (
            [(x - 4.0, y + 6.0 * sign), (x + 4.0, y + 6.0 * sign)]
            if first[0] == last[0]
            else [(x + 6.0 * sign, y - 4.0), (x + 6.0 * sign, y + 4.0)]
        )
        sketch.path([ends[0], (x, y), ends[1]], "move")


def at(scene: Mapping[str, Any], keys: str, text: str = "{:g}", scale: float = 1.0) -> str:
    """The value at dotted ``keys`` times ``scale`` as ``text``; empty where the scene has none."""
    value: Any = scene
    for key in keys.split("."):
        value = value.get(key) if isinstance(value, Mapping) else None
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return value if isinstance(value, str) else ""
    return text.format(scale * value)


def listed(*texts: str) -> str:
    """Those that are not empty, with commas."""
    return ", ".join(filter(None, texts))


def parts_of_scene(scene: Mapping[str, Any]) -> list[Part]:
    """Parts of a rig that lists none: its excitation, its contacts and every mass."""
    parts = [*road_parts(scene), *floor_part(scene)] or [Part("ground", "", ground)]
    contacts = scene.get("effects")
    parts += [Part(f"{name} contact", "", spring_and_damper) for name in contacts] if isinstance(contacts, dict) else []
    for key, values in scene.items():
        found = values if isinstance(values, dict) else {}
        parts += [Part(f"{key} {name}".replace("_", " "), f"{value:g} kg", mass) for name, value in found.items()
                  if "mass" in name and isinstance(value, (int, float))]  # fmt: skip
    return parts


def road_parts(scene: Mapping[str, Any]) -> list[Part]:
    """The road and the speed on it; none where the scene has no road."""
    road = scene.get("road")
    if not isinstance(road, Mapping):
        return []
    known: RoadKind | None = kind_known("road", road)
    condition = str(road.get("kind", "")) if known is None else known.condition
    file = str(road.get("file") or "").rpartition("/")[2]
    value = listed(condition, file, at(road, "height", "{:g} mm high", 1e3))
    return [Part("road", value, ground if condition == "flat" else rough_road), *_speed(scene)]


def floor_part(scene: Mapping[str, Any]) -> list[Part]:
    """The floor with its vibration; none where the scene has no vibration."""
    given = scene.get("vibration")
    if not isinstance(given, Mapping):
        return []
    file = str(given.get("file") or "").rpartition("/")[2]
    kind = str(given.get("kind", "")).replace("_", " ")
    axis = str(given.get("axis", ""))
    value = listed(kind, file, at(given, "frequency", "{:g} Hz"), at(given, "amplitude", "{:g} m/s²"), axis)
    return [Part("floor", value, shaken if "z" in axis or not axis else shaken_along)]


def _speed(scene: Mapping[str, Any]) -> list[Part]:
    """The speed of travel; none where nothing travels."""
    travel = scene.get("travel")
    if not isinstance(travel, Mapping):
        return []
    speeds = (
        [travel["speed"]] if travel.get("speed") is not None else [speed for _time, speed in travel.get("points") or []]
    )
    if not speeds:
        return []
    first, last, low, high = speeds[0], speeds[-1], min(speeds), max(speeds)
    if {first, last} == {low, high}:  # rises or falls all along
        return [Part("speed", f"{first:g} m/s" if low == high else f"{first:g} → {last:g} m/s")]
    return [Part("speed", f"{low:g} to {high:g} m/s")]


def _folded(text: str) -> list[str]:
    """Lines of at most `LETTERS` letters."""
    lines: list[str] = []
    for word in text.split():
        if lines and len(lines[-1]) + len(word) < LETTERS:
            lines[-1] += f" {word}"
        else:
            lines.append(word if len(word) <= LETTERS else f"{word[: LETTERS - 1]}…")
    return lines
