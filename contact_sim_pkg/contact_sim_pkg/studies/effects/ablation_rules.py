"""When an effect is needed: rules of thumb of the field, with what a run shows put in.

* pressure field: road wavelengths below about three patch lengths (0.4 m), steps, cleats, stones; or pressure is asked for;
* friction: fore-aft input, and a tangential demand above about 0.3 of mu N;
* loss: the contact opens (an impact needs a restitution); otherwise there is no rule;
* carcass: content above 30 Hz at the axle;
* envelopment: as the pressure field, for obstacles shorter than the footprint bend the belt;
* friction of a back on its seat back: the scene asks for sliding;
* brush: the scene asks for slip;
* impact of a sphere: loss, for the contact opens; shift, where the sample's temperature changes.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.messages import ContactForce
from contact_sim_pkg.scene.resolve import ResolvedScene

__all__ = ["Observed", "is_needed", "observe"]

SHORT_WAVE = 0.4  # [m], three patch lengths
FOOTPRINT = 0.13  # [m], one patch length
DEMAND = 0.3  # of mu N
AXLE_FREQUENCY, AXLE_SHARE = 30.0, 0.05  # [Hz], and the part of the force's variance above it that counts as content
LOSSES = ("normal_dissipative", "general_dissipative")
SHARP_ROADS = ("step", "cleat", "pothole", "ramp", "bump")


class Observed(NamedTuple):
    """What a run shows: normal forces [N], samples without contact, largest fore-aft acceleration [m/s^2]."""

    forces: dict[str, Vector]
    opens: dict[str, bool]
    forward: float


def observe(messages: list[tuple[str, int, bytes]], inputs: list[dict[str, Any]]) -> Observed:
    """Read a run's messages and its input blocks."""
    parts: dict[str, list[Vector]] = {}
    for topic, _stamp, data in messages:
        contact, _, kind = topic.partition("/")
        if kind == "force":
            parts.setdefault(contact, []).append(decode(ContactForce, data).normal)
    forces = {contact: numpy.concatenate(found) for contact, found in parts.items()}
    shaken = [
        numpy.abs(given["platform/vibration"].acceleration_x).max() for given in inputs if "platform/vibration" in given
    ]
    opens = {contact: bool((force <= 0.0).any()) for contact, force in forces.items()}
    return Observed(forces, opens, float(max(shaken, default=0.0)))


def is_needed(effect: str, contact: str, scene: ResolvedScene, observed: Observed) -> tuple[bool | None, str]:
    """Whether the effect is needed (None: there is no rule), and the figures behind it."""
    if effect == "contact_field":
        return _field(contact, scene)
    if effect == "pressure_mat":
        return None, "needed where a map of the pressure is asked for"
    if effect == "friction":
        return _friction(scene, observed, contact)
    if effect in ("shell_modes", "contact_search"):
        return None, "whether the back bends, and where it touches then, is a choice of the model"
    if contact == "block":
        return None, "rigid or compliant is a choice of the model: stiffer is nearer to rigid, and dearer"
    if contact == "roller":
        return None, "what the roller does is the question of the scene"
    if contact == "impact":
        return _of_impact(effect, scene)
    if effect in RULES_OF_TIRE:
        return RULES_OF_TIRE[effect](scene, observed)
    if effect in LOSSES:
        return _loss(observed.opens[contact])
    return None, "which law carries the load, and what it loses without rate, is a choice of the model"


def _loss(opens: bool) -> tuple[bool | None, str]:
    if opens:
        return True, "the contact opens: an impact needs a loss to have a restitution"
    return None, "the contact stays closed; how much it damps is a choice of the model"


def _field(contact: str, scene: ResolvedScene) -> tuple[bool | None, str]:
    if contact == "seat":
        return None, "needed where the pressure under the occupant is asked for"
    short, why = _short_waves(scene, SHORT_WAVE, "three patch lengths")
    return short, f"{why}, unless the pressure itself is asked for" if short is False else why


def _short_waves(scene: ResolvedScene, limit: float, lengths: str) -> tuple[bool | None, str]:
    """Whether the road holds waves or edges shorter than ``limit`` [m]."""
    road = scene.data["road"]
    kind = road["kind"]
    if kind == "flat":
        return False, "the road is flat: the point contact is exact"
    if kind == "iso8608":
        texture = road.get("texture") or {}
        shortest = float(texture.get("shortest_wavelength") or road["shortest_wavelength"])
        return (
            shortest < limit,
            f"shortest wave of the road {shortest:g} m, limit {limit:g} m ({lengths})",
        )
    if kind == "opencrg":
        return True, f"a measured road holds waves down to its grid, below {lengths}"
    edge, length = road.get("edge"), float(road.get("edge") or road["length"])
    sharp = kind in SHARP_ROADS and (kind != "bump" or length < limit)
    return sharp, f"{kind} with {'edges' if edge else 'a length'} of {length:g} m, limit {limit:g} m ({lengths})"


def _friction(scene: ResolvedScene, observed: Observed, contact: str) -> tuple[bool | None, str]:
    if contact == "backrest":
        return _friction_of_back(scene)
    if observed.forward == 0.0:
        return False, "no fore-aft input"
    occupant = scene.data["seat"]["occupant"]
    mass = float(occupant["frame_mass"] + sum(occupant["masses"]))
    friction = (scene.data["effects"].get(contact) or {}).get("friction") or {}
    limit = float(friction.get("coefficient_static", 0.4)) * float(observed.forces[contact].min())
    demand = mass * observed.forward
    share = demand / limit if limit > 0.0 else float("inf")
    return share > DEMAND, f"fore-aft demand up to {share:.2g} of mu N, limit {DEMAND:g}"


def _friction_of_back(scene: ResolvedScene) -> tuple[bool | None, str]:
    slides = float(scene.data["backrest"]["sliding"]["amplitude"])
    return slides > 0.0, f"the back slides {slides:g} m along the seat back"


def _of_impact(effect: str, scene: ResolvedScene) -> tuple[bool | None, str]:
    if effect == "normal_dissipative":
        return True, "the contact opens: an impact needs a loss to have a restitution"
    if effect == "shift":
        temperatures = scene.data["impact"]["temperatures"]
        return min(temperatures) < max(
            temperatures
        ), f"the sample is {min(temperatures):g} to {max(temperatures):g} K warm"
    if effect == "gauge_noise":
        return None, "whether the gauges are noisy is a choice of the scene"
    return None, "says more of the same impact, and changes no force"


def _carcass(scene: ResolvedScene, observed: Observed) -> tuple[bool | None, str]:
    force = observed.forces["tire"] - observed.forces["tire"].mean()
    power = numpy.abs(numpy.fft.rfft(force)) ** 2
    fast = numpy.fft.rfftfreq(len(force), 1.0 / float(scene.data["outputs"]["force_rate"])) > AXLE_FREQUENCY
    share = float(power[fast].sum() / power.sum()) if power.sum() > 0.0 else 0.0
    why = f"{100.0 * share:.2g} % of the force's variance above {AXLE_FREQUENCY:g} Hz, limit {100.0 * AXLE_SHARE:g} %"
    return share > AXLE_SHARE, why


def _envelopment(scene: ResolvedScene, _observed: Observed) -> tuple[bool | None, str]:
    return _short_waves(scene, FOOTPRINT, "one patch length")


def _brush(scene: ResolvedScene, _observed: Observed) -> tuple[bool | None, str]:
    slip = scene.data.get("slip") or {}
    points = slip.get("points") or [[0.0, slip.get("longitudinal", 0.0), slip.get("angle", 0.0)]]
    largest = max(abs(float(value)) for point in points for value in point[1:])
    return largest > 0.0, f"largest slip that the scene asks for: {largest:g}"


def _no_rule(_scene: ResolvedScene, _observed: Observed) -> tuple[bool | None, str]:
    return None, "whether it acts is a choice of the model"


RULES_OF_TIRE = {
    "carcass": _carcass,
    "envelopment": _envelopment,
    "brush": _brush,
    "tread_viscoelasticity": _no_rule,
    "asperity_impulses": _no_rule,
}
