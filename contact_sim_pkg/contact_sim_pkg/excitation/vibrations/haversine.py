"""One shock of the floor that begins and ends without a corner."""

from math import pi
from typing import ClassVar, Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.shocks import Shock, ShockSection


class Haversine(Shock):
    """Haversine: peak sin^2(pi (t - start) / duration) from start to start + duration, else 0."""

    kind: ClassVar[str] = "haversine"
    area: ClassVar[float] = 0.5

    @staticmethod
    def shape(part: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See Shock."""
        return numpy.asarray(numpy.sin(pi * part) ** 2)


class HaversineSection(ShockSection):
    """One shock: a squared sine of acceleration, which begins and ends without a corner."""

    kind: Literal["haversine"]
    pulse: ClassVar[type[Shock]] = Haversine


KIND = HaversineSection
