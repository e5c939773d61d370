"""A road of sine waves across the whole track."""

from collections.abc import Iterator
from typing import Any, Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.blocks import Surface
from contact_sim_pkg.excitation.kinds import RoadKind, Setting, Wave
from contact_sim_pkg.records.breach import Breach
from contact_sim_pkg.records.fields import number

STEEPEST = 0.5


class Washboard(RoadKind):
    """Waves across the track: amplitude · sin(2π x / wavelength)."""

    kind: Literal["washboard"]
    amplitude: float = number(0.0, 0.1, "m", "half the height from trough to crest", default=0.005)
    wavelength: float = number(0.05, 100.0, "m", "distance of two crests", default=0.8)

    def surface(self, setting: Setting) -> Surface:
        """The section is its own surface."""
        return self

    def heights(self, x: NDArray[numpy.float64], y: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Heights [m], [len(x), len(y)], at x along the road and y to the left [m]."""
        wave = self.amplitude * numpy.sin(2.0 * numpy.pi * x / self.wavelength)
        return numpy.repeat(wave[:, None], len(y), axis=1)

    def describe(self) -> dict[str, Any]:
        """For the report."""
        return {"kind": self.kind, "amplitude_m": self.amplitude, "wavelength_m": self.wavelength, "notes": []}

    def shortest_wave(self, limit: float) -> Wave:
        """Whether the tire needs a pressure field follows from it."""
        return Wave(self.wavelength, self.amplitude, f"the road has waves of {self.wavelength:g} m, shorter than")

    def breaches(self, duration: float) -> Iterator[Breach]:
        """Rules between keys."""
        slope = 2.0 * numpy.pi * self.amplitude / self.wavelength
        if slope > STEEPEST:
            sentence = (
                f"{self.amplitude:g} m make slopes of {slope:.2g}, at most {STEEPEST:g} is allowed; take longer waves"
            )
            yield Breach("road.amplitude", sentence, ("road.wavelength",))


KIND = Washboard
