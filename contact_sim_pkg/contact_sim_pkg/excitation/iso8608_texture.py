"""Isotropic fine road surface that continues a road's spectrum down to the length of single stones.

Spectrum over the plane, q = sqrt(nx^2 + ny^2) in cycles a metre, within 1/longest <= q <=
1/shortest:

    S(q) = C q^-(w + 1),   C = scale gamma((w + 1) / 2) / (2 sqrt(pi) gamma(w / 2))

Along any straight line an unlimited surface of this kind has the one-sided spectrum scale n^-w; the
band limits leave the share I(1 - (n shortest)^2) - I(1 - (n longest)^2) of it (second term only for
n < 1/longest), with I(z) the regularised incomplete beta function of (1/2, w/2). The share falls to
0 at the shortest wavelength. The surface repeats after 8 m along the road and 4 m across.
"""

from math import gamma, pi, sqrt

import numpy
import scipy  # its parts are imported on use: they take 0.1 to 0.3 s
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.periodic import PeriodicTable, synthesise

STRIP_LENGTH = 8.0  # [m]
STRIP_WIDTH = 4.0  # [m]
# Shortest wave 1.2e-5 of its own amplitude; below 1e-6 of the road's rms, as short waves are low
POINTS_PER_WAVE = 24
LARGEST_TABLE = 1 << 25  # numbers in values and slopes of one strip, 256 MiB


class Texture:
    """One periodic strip of isotropic random surface; immutable but for the table of the track that
    was requested last.
    """

    def __init__(
        self, scale: float, exponent: float, longest: float, shortest: float, seed: int,
        strip: tuple[float, float] = (STRIP_LENGTH, STRIP_WIDTH),
    ) -> None:  # fmt: skip
        """Draw the waves.

        Args:
            scale: of the one-sided spectrum along a line, scale n^-exponent, [m^(3 - w)].
            exponent: w, 1 to 4.
            longest: longest wavelength in [m], where the profile ends; at most the strip's width.
            shortest: shortest wavelength in [m].
            seed: of the phases; shared with the profile, which draws from another stream.
            strip: length along the road and width across it after which the surface repeats, [m].

        Raises:
            ExcitationError: waves longer than the strip is wide.
        """
        self.length, self.width = strip
        if longest > self.width:
            raise ExcitationError(
                f"a texture with waves up to {longest:g} m does not fit its strip of {self.width:g} m; let the "
                f"profile go down to {self.width:g} m or less"
            )
        # Waves of the plane: half the spectrum along the track, both signs across it
        self.longest, self.shortest, self.exponent = longest, shortest, exponent
        along = numpy.arange(int(self.length / shortest) + 1)
        half = int(self.width / shortest)
        self._across = numpy.arange(-half, half + 1)
        self._waves = self._draw(scale, along, seed)
        self.rms = sqrt(0.5 * float(numpy.sum(numpy.abs(self._waves) ** 2)))
        self._track: tuple[bytes, PeriodicTable] | None = None

    def scale_to(self, rms: float) -> None:
        """Scale the heights to a root mean square [m]."""
        self._waves *= rms / self.rms
        self.rms, self._track = rms, None

    def _draw(self, scale: float, along: NDArray[numpy.int64], seed: int) -> NDArray[numpy.complex128]:
        """Complex amplitudes over the half plane of wave vectors, [along, across]."""
        q = numpy.hypot(along[:, None] / self.length, self._across[None, :] / self.width)
        inside = (q >= 1.0 / self.longest) & (q <= 1.0 / self.shortest)
        inside[0, self._across <= 0] = False  # the half plane counts a wave along y once
        w = self.exponent
        constant = scale * gamma(0.5 * (w + 1.0)) / (2.0 * sqrt(pi) * gamma(0.5 * w))
        density = numpy.zeros_like(q)
        density[inside] = constant * q[inside] ** -(w + 1.0)
        generator = numpy.random.Generator(numpy.random.PCG64(numpy.random.SeedSequence(seed, spawn_key=(1,))))
        phase = 2.0 * pi * generator.random(q.shape)
        amplitude = 2.0 * numpy.sqrt(density / (self.length * self.width))
        return numpy.asarray(amplitude * numpy.exp(1j * phase), dtype=numpy.complex128)

    def share(self, n: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Share of the spectrum scale n^-w along a line that the texture holds at wave numbers n in
        [cycles/m], 0 to 1."""
        upper = numpy.clip(1.0 - (n * self.shortest) ** 2, 0.0, 1.0)
        lower = numpy.clip(1.0 - (n * self.longest) ** 2, 0.0, 1.0)
        if self.exponent == 2.0:  # ISO 8608: the function is a root
            return numpy.asarray(numpy.sqrt(upper) - numpy.sqrt(lower))
        share, power = scipy.special.betainc, 0.5 * self.exponent
        return numpy.asarray(share(0.5, power, upper) - share(0.5, power, lower))

    def heights(self, x: NDArray[numpy.float64], y: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Heights in [m], [len(x), len(y)]; ExcitationError for a track wider than the strip."""
        key = y.tobytes()
        if self._track is None or self._track[0] != key:
            self._track = (key, self._tabulate(y))
        return self._track[1].at(x)

    def _tabulate(self, y: NDArray[numpy.float64]) -> PeriodicTable:
        """The strip's lines at these y: exact across the track, a fine lattice along it."""
        if float(numpy.ptp(y)) > self.width:
            raise ExcitationError(f"a track of {numpy.ptp(y):g} m is wider than the strip of texture, {self.width:g} m")
        points = 64 * (int(POINTS_PER_WAVE * self.length / self.shortest / 64) + 1)
        if 2 * points * len(y) > LARGEST_TABLE:
            raise ExcitationError(
                f"a texture down to {self.shortest:g} m on {len(y)} lines needs {2 * points * len(y)} numbers, limit "
                f"{LARGEST_TABLE}; use a longer texture wavelength or fewer lines"
            )
        # Waves of both signs across together: (A+ + A-) cos + i (A+ - A-) sin
        half = len(self._across) // 2
        right, left = self._waves[:, half + 1 :], self._waves[:, half - 1 :: -1]
        phase = 2.0 * pi / self.width * self._across[half + 1 :, None] * y
        even, odd = right + left, 1j * (right - left)
        lines = numpy.empty((len(even), len(y)), dtype=numpy.complex128)
        lines.real = _sums(even.real, numpy.cos(phase)) + _sums(odd.real, numpy.sin(phase))
        lines.imag = _sums(even.imag, numpy.cos(phase)) + _sums(odd.imag, numpy.sin(phase))
        return synthesise(lines + self._waves[:, half, None], points, self.length)

    def note(self) -> str:
        """What the texture is, for a person."""
        return (
            f"Below {self.longest:g} m the spectrum goes on as an isotropic surface down to {self.shortest:g} m; it "
            f"repeats after {self.length:g} m along the road, and its spectrum along a line falls to 0 at the "
            "shortest wavelength."
        )


def _sums(waves: NDArray[numpy.float64], across: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    """Product of [along, across] and [across, lines]: einsum, not the matrix product, for the sums must
    not depend on how many threads the linear algebra library has.
    """
    return numpy.asarray(numpy.einsum("pq,qj->pj", numpy.ascontiguousarray(waves), across))
