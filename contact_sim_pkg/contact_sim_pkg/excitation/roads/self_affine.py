"""Self-affine road: an isotropic random surface of spectrum `S(q) ~ q^-(2 + 2 H)` between two
wavelengths, H Hurst's exponent, scaled to its root mean square height.

The irregular road of Tire/Road Contact (section 3), which gives no numbers: H 0.8, waves of 5 to
200 mm and 0.5 mm rms are a choice. Source of the spectrum: Persson et al., J. Phys.: Condens.
Matter 17 (2005) R1, eq 6.
"""

from collections.abc import Iterator
from math import isfinite
from typing import Any, Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.iso8608_texture import Texture
from contact_sim_pkg.excitation.kinds import RoadKind, Setting, Wave
from contact_sim_pkg.records.breach import Breach, rising
from contact_sim_pkg.records.fields import number

__all__ = ["KIND", "SelfAffineRoad", "SelfAffineRoadSection"]

STRIP = (2.0, 1.0)  # [m] along the road and across it


class SelfAffineRoad:
    """The surface repeats after 2 m along the road and is 1 m wide."""

    def __init__(
        self, hurst: float, rms: float, longest: float, shortest: float, seed: int, lattice_cell: float = 0.0
    ) -> None:
        """Draw the waves.

        Args:
            hurst: H, 0 to 1. rms: of the heights, [m], 0 to 0.05. longest, shortest: wavelengths,
            [m]; the longest at most 1 m. seed: of the phases.
            lattice_cell: cell of the lattice that will carry the road, [m]; waves below two cells
            are left out.

        Raises:
            ExcitationError: a value out of range, or no wave between both wavelengths.
        """
        for name, value, low, high in (("hurst", hurst, 0.0, 1.0), ("rms", rms, 0.0, 0.05)):
            if not (isfinite(value) and low <= value <= high):
                raise ExcitationError(f"{name} of the self-affine road is {value}; allowed: {low:g} to {high:g}")
        self.hurst, self.seed, self._notes = hurst, seed, list[str]()
        resolved = max(shortest, 2.0 * lattice_cell)
        if resolved > shortest:
            self._notes.append(
                f"Waves of the road below {resolved:g} m (two cells) are left out; {shortest:g} m was requested."
            )
        if not 1e-3 <= resolved < longest:
            raise ExcitationError(
                f"the self-affine road has no wave: its shortest wavelength is {resolved:g} m, its longest {longest:g} m"
            )
        self._surface = Texture(1.0, 1.0 + 2.0 * hurst, longest, resolved, seed, STRIP)
        if self._surface.rms == 0.0:
            raise ExcitationError(
                f"the self-affine road of {STRIP[0]:g} by {STRIP[1]:g} m has no wave between {resolved:g} and {longest:g} m; take "
                "a wider range"
            )
        self._surface.scale_to(rms)

    def heights(self, x: NDArray[numpy.float64], y: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Heights in [m], [len(x), len(y)]. See blocks.Surface."""
        return self._surface.heights(x, y)

    def describe(self) -> dict[str, Any]:
        """See blocks.Surface."""
        surface = self._surface
        return {
            "kind": "self_affine",
            "hurst": self.hurst,
            "seed": self.seed,
            "shortest_wavelength_m": surface.shortest,
            "longest_wavelength_m": surface.longest,
            "rms_m": surface.rms,
            "notes": [*self._notes, f"The road repeats after {STRIP[0]:g} m."],
        }


class SelfAffineRoadSection(RoadKind):
    """Random surface, equal in all directions, of spectrum q^-(2 + 2 hurst) between two wavelengths
    (the irregular road of Tire/Road Contact).
    """

    kind: Literal["self_affine"]
    hurst: float = number(0.0, 1.0, "", "Hurst's exponent; 0.8 for road surfaces", default=0.8)
    rms: float = number(0.0, 0.05, "m", "root mean square of the heights", default=5e-4, live="excitation")
    shortest_wavelength: float = number(
        0.001, 1.0, "m", "shortest wavelength; at least two cells of the contact field are resolved", default=0.005
    )
    longest_wavelength: float = number(0.001, 1.0, "m", "longest wavelength", default=0.2)

    def surface(self, setting: Setting) -> SelfAffineRoad:
        """See RoadKind."""
        waves = (self.longest_wavelength, self.shortest_wavelength)
        return SelfAffineRoad(self.hurst, self.rms, *waves, setting.seed, lattice_cell=setting.cell)

    def shortest_wave(self, limit: float) -> Wave:
        """See RoadKind."""
        return Wave(
            self.shortest_wavelength, self.rms, f"the road has waves of {self.shortest_wavelength:g} m, shorter than"
        )

    def breaches(self, duration: float) -> Iterator[Breach]:
        """See Kind."""
        waves = (self.shortest_wavelength, "longest_wavelength", self.longest_wavelength)
        yield from rising("road", "shortest_wavelength", *waves, "m")


KIND = SelfAffineRoadSection
