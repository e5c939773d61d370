"""Keys of the stops at both ends of a travel."""

from __future__ import annotations

from typing import ClassVar

from contact_sim_pkg.run.integrator_work import Link
from contact_sim_pkg.scene.schema.fields import Section, number

__all__ = ["StopKeys"]


class StopKeys(Section):
    """Two stops of one law: stop_force · (depth / stop_depth)^stop_exponent, times 1 + stop_damping · rate, never pulling."""

    fixed: ClassVar[str] = "a stop is built in once"

    stop_force: float = number(1.0, 1e6, "N", "of a stop at stop_depth", default=2000.0)
    stop_depth: float = number(1e-3, 0.2, "m", "pressed into a stop under stop_force", default=0.01)
    stop_exponent: float = number(1.0, 3.0, "", "1 is linear; rubber bumpers grow with 2 to 3", default=2.0)
    stop_damping: float = number(0.0, 10.0, "s/m", "loss of a stop, Hunt-Crossley", default=0.5)

    def stop_link(self, name: str, mass: float) -> Link:
        """The tangent of a stop at stop_force under a ``mass`` [kg]."""
        stiffness = self.stop_exponent * self.stop_force / self.stop_depth
        return Link(name, mass, stiffness, self.stop_damping * self.stop_force)
