"""One shock of the floor, half a sine."""

from math import pi
from typing import ClassVar, Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.shocks import Shock, ShockSection


class HalfSine(Shock):
    """Half a sine: peak sin(pi (t - start) / duration) from start to start + duration, else 0."""

    kind: ClassVar[str] = "half_sine"
    area: ClassVar[float] = 2.0 / pi

    @staticmethod
    def shape(part: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See Shock."""
        return numpy.asarray(numpy.sin(pi * part))


class HalfSineSection(ShockSection):
    """One shock: half a sine of acceleration."""

    kind: Literal["half_sine"]
    pulse: ClassVar[type[Shock]] = HalfSine


KIND = HalfSineSection
