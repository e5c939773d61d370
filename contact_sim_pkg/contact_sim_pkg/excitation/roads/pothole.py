"""A hole across the road."""

from typing import Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.kinds import Obstacle
from contact_sim_pkg.excitation.obstacle import (
    ObstacleRoad,
    edge_key,
    length_key,
    period_key,
    position_key,
    profile_with_flanks,
)
from contact_sim_pkg.records.fields import number


class PotholeRoad(ObstacleRoad):
    """A hole across the road. A wheel of radius r drops at most r - √(r² - (length/2)²), whatever
    the depth.
    """

    kind: Literal["pothole"]
    position: float = position_key()
    depth: float = number(0.0, 0.5, "m", "depth of the bottom", above=True, example=0.05)
    length: float = length_key(0.3)
    edge: float = edge_key()
    period: float | None = period_key()

    def obstacle(self) -> Obstacle:
        """See RoadKind."""
        return Obstacle(self.position, self.length, -self.depth, self.edge, flank_key="edge", period=self.period)

    def profile(self, s: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See ObstacleRoad."""
        return profile_with_flanks(s, -self.depth, self.length, self.edge)


KIND = PotholeRoad
