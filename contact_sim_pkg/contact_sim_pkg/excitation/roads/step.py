"""A kerb."""

from typing import Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.kinds import Obstacle
from contact_sim_pkg.excitation.obstacle import ObstacleRoad, height_key, position_key, ramp
from contact_sim_pkg.records.fields import number


class StepRoad(ObstacleRoad):
    """An even road that goes on at another height."""

    kind: Literal["step"]
    position: float = position_key("middle of the step along the road")
    height: float = height_key("height behind the step; negative goes down", 0.02)
    length: float = number(0.0, 100.0, "m", "length of the straight ramp; 0 is a sharp edge", default=0.0)

    def obstacle(self) -> Obstacle:
        """See RoadKind."""
        return Obstacle(self.position, self.length, self.height, self.length, ends=False)

    def profile(self, s: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See ObstacleRoad."""
        return self.height * ramp(s + 0.5 * self.length, self.length)


KIND = StepRoad
