"""The tire as a body on the road: its form, the modulus of its tread, and the belt under it. Knows
no kernels and no schema, so that the node that sends the road starts without them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from contact_sim_pkg.pressure.settings import BeltSettings, InflatedBelt
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import make_belt, ring_stiffness
from contact_sim_pkg.rigs.vehicle.tire.size import read_size
from contact_sim_pkg.scene.resolved_scene import plain

if TYPE_CHECKING:
    from contact_sim_pkg.rigs.vehicle.tire.schema import Envelopment, HertzElastic, Inflation, RigidRingSection
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["TireBody", "TireForm", "body_of", "tire_body"]


class TireForm(NamedTuple):
    """Form of the unloaded tire: its height over the lowest point is ``x^2 / (2 R) + y^2 / (2 R_y)``,
    or ``R - sqrt(R^2 - x^2) + y^2 / (2 R_y) + s (y / w)^6`` where it is circular; on a drum
    ``R_d - sqrt(R_d^2 - x^2)`` more.
    """

    radius_rolling: float  # R [m]
    radius_lateral: float  # R_y [m]
    shoulder: float = 0.0  # s [m]
    half_width: float = 1.0  # w [m]
    circular: bool = False
    drum: float = 0.0  # 1/R_d [1/m] of the drum that it stands on; 0: level


class TireBody(NamedTuple):
    """What presses on the road."""

    form: TireForm
    modulus: float  # [Pa] plane-strain contact modulus of the tread on a rigid road
    poisson_ratio: float  # of the tread
    belt: BeltSettings | InflatedBelt | None = None
    extent: tuple[float, float] | None = None  # [m] along and across that a usual contact lies in; None: see Hertz


def body_of(scene: ResolvedScene) -> TireBody:
    """The tire of a resolved scene; on a drum its curvature is part of the form."""
    body, mount = tire_body(scene.data["effects"]["tire"]), plain(scene.data["tire"]).mount
    if mount is None or mount.kind != "drum":
        return body
    return body._replace(form=body.form._replace(drum=1.0 / mount.radius))


def tire_body(effects: dict[str, Any]) -> TireBody:
    """The tire of the plain data of the effects at its contact."""
    inflation: Inflation | None = plain(effects.get("inflation"))
    if inflation is not None:
        return _inflated(inflation, plain(effects.get("rigid_ring")))
    elastic: HertzElastic = plain(effects["normal_elastic"])
    envelopment: Envelopment | None = plain(effects.get("envelopment"))
    belt = None if envelopment is None else BeltSettings(envelopment.tension, envelopment.foundation)
    young = effects["normal_elastic"].get("young_modulus")
    if young is None:
        raise ValueError("effects.tire.normal_elastic.young_modulus is open: the scene is not resolved")
    modulus = young / (1.0 - elastic.poisson_ratio**2)
    return TireBody(TireForm(elastic.radius_rolling, elastic.radius_lateral), modulus, elastic.poisson_ratio, belt)


def _inflated(keys: Inflation, ring: RigidRingSection | None) -> TireBody:
    """``ring``: the rigid ring where it is a body of its own."""
    size, chord, width = read_size(keys.size, keys.radius), keys.sidewall_chord, keys.belt_width
    assert chord is not None  # a resolved scene leaves neither open
    assert width is not None
    stiffness = ring_stiffness(keys.ring_stiffness, keys.pressure) if ring is None else ring.stiffness
    assert stiffness is not None
    belt = make_belt(
        keys.pressure, size.radius, keys.sidewall_angle, chord, width, keys.structure, keys.tangential, keys.bending,
        stiffness, ring is not None,
    )  # fmt: skip
    form = TireForm(size.radius, keys.crown_radius, keys.shoulder, 0.5 * width, circular=True)
    modulus = keys.tread_modulus / (1.0 - keys.tread_poisson**2)
    return TireBody(form, modulus, keys.tread_poisson, belt, size.grid)
