"""Random road with the displacement spectrum of ISO 8608.

One-sided spectrum along the road, n in cycles a metre:  G(n) = roughness (n / n0)^-exponent,  n0 = 0.1 cycle/m.
Every harmonic of the road's length gets the variance of its own bin, integral of G, and a uniform random phase, so the
variance of the band is exact: roughness n0^2 (1/n_low - 1/n_high) for exponent 2.

Source: ISO 8608:2016 (classes by their geometric mean); random phases and inverse FFT instead of a
few sines.
"""

from collections.abc import Iterator
from math import ceil, floor, isfinite, sqrt
from typing import Any, ClassVar, Literal, TypeAlias

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require, require_not_negative, require_values
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.iso8608_texture import Texture
from contact_sim_pkg.excitation.kinds import RoadKind, Setting, Wave
from contact_sim_pkg.excitation.periodic import synthesise
from contact_sim_pkg.records.breach import Breach, one_of, rising
from contact_sim_pkg.records.fields import Section, choice, number

REFERENCE_WAVE_NUMBER = 0.1  # [cycles/m] n0 of ISO 8608
CLASS_ROUGHNESS = {  # [m^3] geometric mean of Gd(n0), ISO 8608:2016
    "A": 16e-6, "B": 64e-6, "C": 256e-6, "D": 1024e-6, "E": 4096e-6, "F": 16384e-6, "G": 65536e-6, "H": 262144e-6,
}  # fmt: skip
# Error of the shortest wave 7.6e-7 of its amplitude, see excitation/periodic.py
POINTS_PER_WAVE = 48
MOST_POINTS = 1 << 24  # 256 MiB of values and slopes
BYTES_PER_POINT = 16


def roughness_of_class(name: str) -> float:
    """Gd(n0) in [m^3] of an ISO 8608 class A to H, its geometric mean; ExcitationError for another
    name.
    """
    if name not in CLASS_ROUGHNESS:
        raise ExcitationError(f"road class '{name}' is unknown; allowed: {', '.join(CLASS_ROUGHNESS)}")
    return CLASS_ROUGHNESS[name]


def band_variance(roughness: float, exponent: float, low: NDArray[Any] | float, high: NDArray[Any] | float) -> Any:
    """Variance [m^2] of the wave numbers from low to high [1/m]: the integral of G(n).

    roughness: >= 0 [m^3]; exponent: finite; 0 < low <= high: numbers, or arrays [bands] of one
    shape, which is that of the result. ExcitationError otherwise.
    """
    require_not_negative("roughness", roughness, "m^3", error=ExcitationError)
    require("exponent", exponent, error=ExcitationError)
    low = require_values("lowest wave number", low, "cycles/m", above=0.0, error=ExcitationError)
    high = require_values("highest wave number", high, "cycles/m", above=0.0, error=ExcitationError)
    if (low > high).any():
        raise ExcitationError(f"wave numbers from {low.max()} to {high.min()} cycles/m: the lowest must come first")
    scale = roughness * REFERENCE_WAVE_NUMBER**exponent
    if abs(exponent - 1.0) < 1e-9:
        return scale * numpy.log(numpy.divide(high, low))
    power = 1.0 - exponent
    return scale * (numpy.power(low, power) - numpy.power(high, power)) / (exponent - 1.0)


class Iso8608Road:
    """A random road, the same across the track unless a texture is requested; it repeats after its
    length.

    The texture continues the spectrum below the shortest wavelength of the profile with an
    isotropic fine surface, see excitation/iso8608_texture.py. Its oblique waves also add to the
    spectrum of the longer waves along the road; the profile is lowered by just that, so that the
    spectrum along any line of travel is G(n).
    """

    def __init__(
        self,
        roughness: float,
        seed: int,
        length: float = 1000.0,
        exponent: float = 2.0,
        shortest_wavelength: float = 0.3,
        longest_wavelength: float = 100.0,
        texture_wavelength: float | None = None,
        lattice_cell: float = 0.0,
    ) -> None:
        """Make the road; some 10 ms a kilometre.

        Args:
            roughness: Gd(n0), [m^3], 0 (flat) to 1; see `roughness_of_class`. seed: whole number
            from 0; the same seed gives the same bits. length: the road repeats after this length,
            [m]. exponent: w of the spectrum, 1 to 4. shortest_wavelength: of the profile, [m].
            longest_wavelength: [m]; the length where that is shorter. texture_wavelength: shortest
            wavelength of the isotropic fine surface, [m], below shortest_wavelength; None:
                no texture.
            lattice_cell: cell of the lattice that will carry the road, [m]; waves below two cells
            are left out.

        Raises:
            ExcitationError: a value out of range, or a road of more than 16.7 million points.
        """
        _check(roughness, seed, length, exponent, shortest_wavelength, longest_wavelength)
        require_not_negative("lattice cell of the random road", lattice_cell, "m", error=ExcitationError)
        self.roughness, self.seed, self.length, self.exponent = roughness, seed, length, exponent
        self._notes: list[str] = []
        self.shortest = self._resolved(shortest_wavelength, lattice_cell, "profile")
        self.longest = min(longest_wavelength, length)
        # A periodic road holds no wave longer than itself
        if self.longest < longest_wavelength:
            self._notes.append(
                f"Waves longer than the road ({length:g} m) are left out; {longest_wavelength:g} m was requested."
            )
        if self.shortest >= self.longest:
            raise ExcitationError(
                f"the road has no wave: its shortest wavelength is {self.shortest:g} m, its longest {self.longest:g} m"
            )
        self.texture = self._make_texture(texture_wavelength, lattice_cell)
        self._profile = self._make_profile()
        self._notes.append(f"The road repeats after {length:g} m.")

    def _resolved(self, wavelength: float, cell: float, name: str) -> float:
        if wavelength < 2.0 * cell:
            self._notes.append(
                f"Waves of the {name} below {2.0 * cell:g} m (two cells) are left out; {wavelength:g} m was requested."
            )
        return max(wavelength, 2.0 * cell)

    def _make_texture(self, wavelength: float | None, cell: float) -> Texture | None:
        if wavelength is None:
            return None
        if not 1e-3 <= wavelength < self.shortest:
            raise ExcitationError(
                f"texture wavelength {wavelength} m is out of range; allowed: from 0.001 m to below the profile's "
                f"shortest wavelength {self.shortest:g} m"
            )
        wavelength = self._resolved(wavelength, cell, "texture")
        if wavelength >= self.shortest:
            return None
        scale = self.roughness * REFERENCE_WAVE_NUMBER**self.exponent
        return Texture(scale, self.exponent, self.shortest, wavelength, self.seed)

    def _make_profile(self) -> Any:
        points = 1024 * ceil(POINTS_PER_WAVE * self.length / self.shortest / 1024)
        if points > MOST_POINTS:
            raise ExcitationError(
                f"a road of {self.length:g} m with waves down to {self.shortest:g} m needs {points} points, limit "
                f"{MOST_POINTS}; use a shorter road (it repeats) or a longer shortest wavelength"
            )
        harmonics = floor(self.length / self.shortest * (1.0 + 1e-12)) + 1
        variance = numpy.zeros(harmonics + 1)
        variance[1:] = self._bin_variances(numpy.arange(1, harmonics + 1) / self.length)
        generator = numpy.random.Generator(numpy.random.PCG64(numpy.random.SeedSequence(self.seed, spawn_key=(0,))))
        phase = 2.0 * numpy.pi * generator.random(harmonics + 1)
        self.profile_rms = sqrt(float(variance.sum()))
        return synthesise(numpy.sqrt(2.0 * variance) * numpy.exp(1j * phase), points, self.length)

    def _bin_variances(self, n: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Variance in [m^2] of each harmonic: the integral of the profile's spectrum over its bin,
        cut to the band.
        """
        low = numpy.clip(n - 0.5 / self.length, 1.0 / self.longest, 1.0 / self.shortest)
        high = numpy.clip(n + 0.5 / self.length, 1.0 / self.longest, 1.0 / self.shortest)
        variance = band_variance(self.roughness, self.exponent, low, high)
        if self.texture is not None:
            variance = variance * (1.0 - self.texture.share(0.5 * (low + high)))
        return numpy.asarray(variance, dtype=numpy.float64)

    def heights(self, x: NDArray[numpy.float64], y: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Heights in [m], [len(x), len(y)]; any x, and any y within the texture's strip. See
        blocks.Surface.
        """
        profile = self._profile.at(x)
        if self.texture is None:
            return numpy.repeat(profile, len(y), axis=1)
        height = self.texture.heights(x, y)
        height += profile
        return height

    def describe(self) -> dict[str, Any]:
        """See blocks.Surface."""
        texture_rms = 0.0 if self.texture is None else self.texture.rms
        described = {
            "kind": "iso8608",
            "roughness_at_0.1_cycles_per_metre_m3": self.roughness,
            "exponent": self.exponent,
            "seed": self.seed,
            "length_m": self.length,
            "shortest_wavelength_m": self.shortest,
            "longest_wavelength_m": self.longest,
            "profile_rms_m": self.profile_rms,
            "texture_shortest_wavelength_m": None if self.texture is None else self.texture.shortest,
            "texture_rms_m": texture_rms,
            "rms_m": sqrt(self.profile_rms**2 + texture_rms**2),
            "interpolation_error_relative_to_rms": 1e-6,
        }
        # Notes last: they are text for a reader
        notes = list(self._notes)
        if self.texture is not None:
            notes.append(self.texture.note())
        return {**described, "notes": notes}


def _check(roughness: float, seed: int, length: float, exponent: float, shortest: float, longest: float) -> None:
    ranges = (
        ("roughness", roughness, 0.0, 1.0, "m^3"),
        ("length", length, 1.0, 1e6, "m"),
        ("exponent", exponent, 1.0, 4.0, ""),
        ("shortest wavelength", shortest, 1e-3, 1e3, "m"),
        ("longest wavelength", longest, 1e-3, 1e4, "m"),
    )
    for name, value, low, high, unit in ranges:
        if not (isfinite(value) and low <= value <= high):
            raise ExcitationError(
                f"{name} of the random road is {value} {unit}; allowed: {low:g} to {high:g} {unit}".rstrip()
            )
    if not isinstance(seed, int) or seed < 0:
        raise ExcitationError(f"seed of the random road is {seed!r}; allowed: a whole number from 0")


RoughnessClass: TypeAlias = Literal["A", "B", "C", "D", "E", "F", "G", "H"]


class TextureSection(Section):
    """Fine surface below the shortest wavelength of an ISO 8608 profile, equal in all
    directions.
    """

    fixed: ClassVar[str] = RoadKind.fixed

    shortest_wavelength: float = number(
        0.001,
        1.0,
        "m",
        "shortest wavelength of the texture; at least two cells of the contact field are resolved",
        default=0.02,
    )


class Iso8608RoadSection(RoadKind):
    """Random road with the spectrum G(n) = roughness (n / 0.1 c/m)^-exponent; `roughness_class` or
    `roughness`.
    """

    kind: Literal["iso8608"]
    roughness_class: RoughnessClass | None = choice("ISO 8608 class, taken at its geometric mean", default=None)
    roughness: float | None = number(
        0.0,
        1.0,
        "m³",
        "spectral density at 0.1 cycles/m; class A is 16e-6, C is 256e-6",
        default=None,
        live="excitation",
    )
    exponent: float = number(1.0, 4.0, "", "falling power of the spectrum; ISO 8608 takes 2", default=2.0)
    length: float = number(
        1.0, 1e6, "m", "the road repeats after this length; waves longer than it are left out", default=1000.0
    )
    shortest_wavelength: float = number(
        0.001, 1000.0, "m", "shortest wave of the profile; ISO 8608 ends at 0.35 m", default=0.3
    )
    longest_wavelength: float = number(
        0.001, 1e4, "m", "longest wave of the profile; ISO 8608 ends at 90.9 m", default=100.0
    )
    texture: TextureSection | None = choice(
        "isotropic surface that continues the spectrum; without it the road is even across", default=None
    )

    @property
    def spectrum(self) -> float:
        """Gd(n0) in [m^3], as given or of its class."""
        if self.roughness_class is not None:
            return roughness_of_class(self.roughness_class)
        assert self.roughness is not None
        return self.roughness

    def surface(self, setting: Setting) -> Iso8608Road:
        """See RoadKind."""
        return Iso8608Road(
            self.spectrum, setting.seed, self.length, self.exponent,
            shortest_wavelength=self.shortest_wavelength, longest_wavelength=self.longest_wavelength,
            texture_wavelength=None if self.texture is None else self.texture.shortest_wavelength,
            lattice_cell=setting.cell,
        )  # fmt: skip

    def shortest_wave(self, limit: float) -> Wave:
        """See RoadKind."""
        shortest = self.shortest_wavelength if self.texture is None else self.texture.shortest_wavelength
        height = 0.0
        if shortest < limit:
            height = sqrt(float(band_variance(self.spectrum, self.exponent, 1.0 / limit, 1.0 / shortest)))
        return Wave(shortest, height, f"the road has waves of {shortest:g} m, shorter than")

    @property
    def condition(self) -> str:
        """See RoadKind."""
        return f"class {self.roughness_class}"

    @property
    def _points(self) -> int:
        return 1024 * ceil(POINTS_PER_WAVE * self.length / self.shortest_wavelength / 1024)

    def memory(self) -> tuple[str, int]:
        """See Kind."""
        points = self._points
        return (
            (f"a random road of {points} points needs", points * BYTES_PER_POINT) if points <= MOST_POINTS else ("", 0)
        )

    def breaches(self, duration: float) -> Iterator[Breach]:
        """See Kind."""
        yield from one_of(
            "road", "roughness_class", self.roughness_class is not None, "roughness", self.roughness is not None
        )
        shortest = self.shortest_wavelength
        yield from rising("road", "shortest_wavelength", shortest, "longest_wavelength", self.longest_wavelength, "m")
        yield from rising("road", "shortest_wavelength", shortest, "length", self.length, "m")
        if self.texture is not None:  # which continues the profile to shorter waves
            finest = self.texture.shortest_wavelength
            yield from rising("road", "texture.shortest_wavelength", finest, "shortest_wavelength", shortest, "m")
        if self._points > MOST_POINTS:
            sentence = (
                f"a road of {self.length:g} m with waves down to {shortest:g} m needs {self._points} points, limit "
                f"{MOST_POINTS}; shorten it (it repeats) or raise shortest_wavelength"
            )
            yield Breach("road.length", sentence, ("road.shortest_wavelength",))


KIND = Iso8608RoadSection
