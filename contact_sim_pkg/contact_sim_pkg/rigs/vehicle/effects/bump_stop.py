"""Keys of the stops between wheel and body."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from contact_sim_pkg.rigs.vehicle.effects.travel_stops import StopKeys
from contact_sim_pkg.rigs.vehicle.tire.schema import TireSection
from contact_sim_pkg.run.integrator_work import Link
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.fields import number

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene
    from contact_sim_pkg.scene.schema.scene import Scene

__all__ = ["BumpStopSection", "bump_stop_breaches"]


class BumpStopSection(StopKeys):
    """Progressive stops of the wheel's travel against the body, in both directions."""

    bump: float = number(
        -0.05,
        1.0,
        "m",
        "travel upwards from the height of rest on the spring alone; below 0 engaged at rest",
        default=0.08,
    )
    rebound: float = number(-0.05, 1.0, "m", "travel downwards from there; above -bump", default=0.09)
    stop_force: float = number(1.0, 1e6, "N", "of a stop at stop_depth", default=6000.0)
    stop_depth: float = number(1e-3, 0.2, "m", "pressed into a stop under stop_force", default=0.03)

    def links(self, scene: ResolvedScene) -> Iterator[Link]:
        """For the estimate of work."""
        tire = scene.section(TireSection)
        yield self.stop_link("bump_stop", min(tire.wheel_mass, tire.body_mass))


def bump_stop_breaches(scene: Scene) -> Iterator[Breach]:
    """Stops that leave no travel."""
    keys = scene.effect("tire", BumpStopSection)
    if keys is not None and keys.bump + keys.rebound <= 0.0:
        yield Breach(
            "effects.tire.bump_stop.rebound", f"{keys.rebound:g} m leaves no travel below bump ({keys.bump:g} m)"
        )
