"""One shock of the floor, a symmetric triangle."""

from typing import ClassVar, Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.shocks import Shock, ShockSection


class Triangle(Shock):
    """Triangle: peak (1 - |2 (t - start) / duration - 1|) from start to start + duration, else 0."""

    kind: ClassVar[str] = "triangle"
    area: ClassVar[float] = 0.5

    @staticmethod
    def shape(part: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See Shock."""
        return 1.0 - numpy.abs(2.0 * part - 1.0)


class TriangleSection(ShockSection):
    """One shock: a symmetric triangle of acceleration."""

    kind: Literal["triangle"]
    pulse: ClassVar[type[Shock]] = Triangle


KIND = TriangleSection
