"""A bar across the road."""

from typing import Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.kinds import Obstacle
from contact_sim_pkg.excitation.obstacle import (
    ObstacleRoad,
    edge_key,
    height_key,
    length_key,
    period_key,
    position_key,
    profile_with_flanks,
)


class CleatRoad(ObstacleRoad):
    """A bar across the road, such as 10 mm × 50 mm; sharp edges unless it has flanks."""

    kind: Literal["cleat"]
    position: float = position_key()
    height: float = height_key("height of the bar; negative is a slot", 0.01)
    length: float = length_key(0.05)
    edge: float = edge_key()
    period: float | None = period_key()

    def obstacle(self) -> Obstacle:
        """See RoadKind."""
        return Obstacle(self.position, self.length, self.height, self.edge, flank_key="edge", period=self.period)

    def profile(self, s: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See ObstacleRoad."""
        return profile_with_flanks(s, self.height, self.length, self.edge)


KIND = CleatRoad
