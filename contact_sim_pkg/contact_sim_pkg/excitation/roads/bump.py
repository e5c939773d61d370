"""A raised cosine across the road."""

import math
from typing import Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.kinds import Obstacle
from contact_sim_pkg.excitation.obstacle import ObstacleRoad, height_key, period_key, position_key
from contact_sim_pkg.records.fields import choice, number


class BumpRoad(ObstacleRoad):
    """One bump, or a row of them, on an even road: height/2 (1 + cos(2π s / length))."""

    kind: Literal["bump"]
    position: float = position_key()
    height: float = height_key("height of the crest; negative is a dip", 0.05)
    length: float = number(0.001, 100.0, "m", "length along the road", example=0.5)
    shape: Literal["raised_cosine"] = choice("form of the bump", default="raised_cosine")
    period: float | None = period_key()

    def obstacle(self) -> Obstacle:
        """See RoadKind."""
        flank = 0.5 * self.length
        return Obstacle(self.position, self.length, self.height, flank, has_corners=False, period=self.period)

    def profile(self, s: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See ObstacleRoad."""
        crest = 0.5 * self.height * (1.0 + numpy.cos(2.0 * math.pi * s / self.length))
        return numpy.where(numpy.abs(s) < 0.5 * self.length, crest, 0.0)

    @property
    def curvature(self) -> float:
        """See ObstacleRoad."""
        return 0.5 * abs(self.height) * (2.0 * math.pi / self.length) ** 2


KIND = BumpRoad
