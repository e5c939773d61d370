"""Where the frames of a scene are at rest, and the sizes that its bodies are drawn with.

Motion is measured from the rest places. Only the radius of the tire, the travel and the frames of
the contacts follow from the scene; heights and sizes of seat and occupant are for the picture alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.travel import Travel
from contact_sim_pkg.rigs.vehicle.tire.size import read_size
from contact_sim_pkg.run.sources import make_travel
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.standard.messages import BASE

Point = tuple[float, float, float]

FLOOR = ("body", "floor")
"""Frames of the floor: of a car, and of a seat on a platform."""
FLOOR_HEIGHT = 0.25  # [m] above the wheel centre
SEAT_HEIGHT = 0.3  # [m] above the floor
OCCUPANT_STEP = 0.25  # [m] from one mass of the occupant up to the next
BACK = 0.25  # [m] from the middle of the seat back to its back
EDGE = 0.35  # [m] from the lower edge of a cushioned seat back up to its middle, where the median back presses

BACKREST_TURN = (0.5**0.5, 0.0, 0.5**0.5, 0.0)
"""Quaternion x, y, z, w of a backrest's frame: x up, y to the right, z forward."""
LEVEL = (0.0, 0.0, 0.0, 1.0)


class Places(NamedTuple):
    """Rest places [m] of the bodies' frames in `base_link`, and what is drawn of them."""

    radius: float = 0.0  # [m] of the tire, free; 0 without a tire
    width: float = 0.0  # [m] of the tire
    travel: Travel | None = None
    edge: float = 0.0  # [m] from the origin of the backrest's contact up to the middle of the seat back

    def travelled(self, stamp: int) -> float:
        """Way [m] of the rig along the road at a stamp [ns]."""
        return 0.0 if self.travel is None else self.travel.position(stamp * 1e-9)

    def of_body(self, body: str) -> Point:
        """Rest place of a body's frame."""
        if body in ("wheel", "belt"):
            return (0.0, 0.0, self.radius)
        floor = self.radius + FLOOR_HEIGHT if self.radius else 0.0
        if body in FLOOR:
            return (0.0, 0.0, floor)
        seat = floor + SEAT_HEIGHT
        if body == "seat_back":
            return (-BACK, 0.0, seat + OCCUPANT_STEP)
        number = body.removeprefix("occupant") or "1"
        if number.isdecimal():  # of a mass of the occupant, from the lowest up
            return (0.0, 0.0, seat + OCCUPANT_STEP * int(number))
        return (0.0, 0.0, seat) if body == "seat_frame" else (0.0, 0.0, 0.0)

    def of_contact(self, contact: str, bodies: Mapping[str, Point]) -> tuple[str, Point, tuple[float, ...]]:
        """Parent frame, place in it and rotation of the frame of a contact; `bodies` are those that move."""
        floor = next((body for body in FLOOR if body in bodies), BASE)
        if contact == "seat":
            return floor, (0.0, 0.0, SEAT_HEIGHT), LEVEL
        if contact == "backrest":
            return floor, (-BACK, 0.0, SEAT_HEIGHT + OCCUPANT_STEP - self.edge), BACKREST_TURN
        return BASE, bodies.get(contact, (0.0, 0.0, 0.0)), LEVEL


def places_of(scene: Mapping[str, Any]) -> Places:
    """The places of a resolved scene, as plain data; without a scene all bodies rest at the origin.

    Raises BagError where the data are no scene.
    """
    try:
        return _places_of(scene) if scene else Places()
    except (AttributeError, ExcitationError, KeyError, TypeError, ValueError) as error:
        reason = f"{type(error).__name__}: {error}"
        raise BagError(f"the scene does not say where its bodies are ({reason:.200}); is it a resolved one?") from None


def _places_of(scene: Mapping[str, Any]) -> Places:
    resolved = ResolvedScene(dict(scene))
    travel = None if resolved.travel is None else make_travel(resolved)
    contacts = scene.get("effects") or {}
    edge = EDGE if "cushion" in (contacts.get("backrest") or {}) else 0.0  # its map counts from there
    effects = contacts.get("tire")
    if effects is None:
        return Places(travel=travel, edge=edge)
    inflation = effects.get("inflation")
    if inflation:
        size = read_size(str(inflation["size"]), inflation.get("radius"))
        return Places(size.radius, size.width, travel, edge)
    tire = scene.get("tire") or {}
    return Places(float(tire.get("radius_rolling", 0.3)), 0.2, travel, edge)
