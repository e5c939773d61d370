"""Effects of the contact between sphere and sample. An effect acts when the scene names it; `{}`
takes all defaults.
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.records.fields import Section, choice, number, numbers

TableRow: TypeAlias = Annotated[list[float], Field(min_length=3, max_length=3)]


class SphereElastic(Section):
    """Elastic force 4/3 k_p E' √R x^(3/2), from the sphere and the sample of `impact`."""

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"


class SphereLoss(Section):
    """Viscous force 4 k_p √R (E' tan β/ω) x^(1/2) x', ω the angular frequency π/τ of the impact
    itself.
    """

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"

    end: Literal["force", "gap"] = choice(
        "contact ends at zero force (never tensile), or at zero gap (tensile before)",
        default="force",
    )


class Shift(Section):
    """Time-temperature shift: E' and tan β of each impact from a table over temperature, measured
    at one impact speed.
    """

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"

    law: Literal["wlf", "arrhenius"] = choice("Williams-Landel-Ferry, or one activation energy", default="wlf")
    glass_temperature: float = number(1.0, 2000.0, "K", "glass temperature Tg", default=223.0)
    c1: float = number(1e-6, 1000.0, "", "constant of wlf", default=17.44)
    c2: float = number(1e-6, 1000.0, "K", "constant of wlf", default=51.6)
    activation_energy: float = number(1.0, 1e7, "J/mol", "activation energy of arrhenius", default=1.0e5)
    table_speed: float = number(1e-6, 1000.0, "m/s", "impact speed at which the table was measured", default=2.0)
    table: list[TableRow] = numbers(
        "", "rows [T in K, E' in Pa, tan β], T increasing; ln E' and tan β linear between them",
        "2 to 1000 rows [T in K, E' in Pa, tan β]",
        default=[
            [200.0, 2.0e9, 0.02], [220.0, 1.8e9, 0.04], [235.0, 1.3e9, 0.12], [245.0, 6.0e8, 0.4], [252.0, 2.0e8, 0.85],
            [260.0, 7.0e7, 1.0], [270.0, 2.6e7, 0.6], [280.0, 1.3e7, 0.32], [293.15, 8.0e6, 0.2], [310.0, 6.2e6, 0.13],
            [340.0, 5.0e6, 0.08], [400.0, 4.6e6, 0.06],
        ],
        shortest=2, longest=1000,
    )  # fmt: skip
    beyond: Literal["refuse", "keep"] = choice(
        "beyond the table: end the run, or keep its first or last row", default="refuse"
    )
    rate: Literal["speed", "frequency"] = choice(
        "rate of the shift: impact speed (Contact Area), or frequency π/τ", default="speed"
    )
    table_frequency: float = number(
        1e-6, 1e12, "rad/s", "frequency of the table; acts with rate: frequency", default=1750.0
    )


class ContactStress(Section):
    """Stress over the contact radius in time, elastic and viscous, as `impact/stress`."""

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"

    shape: Literal["parabola", "hertz", "printed"] = choice(
        "over the radius: 1 − ρ², √(1 − ρ²), or as printed with 3/4 of the force", default="parabola"
    )
    places: int = number(3, 1001, "", "places from the centre to the border", default=41)
    instants: int = number(3, 1001, "", "instants of each impact", default=101)


class SurfaceWaves(Section):
    """Ring and circular wave around each impact, as `impact/wave`."""

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"

    spread: Literal["none", "cylindrical"] = choice("decay of the amplitude with the radius", default="none")
    lengths: float = number(0.5, 1000.0, "", "recorded distance around the contact, in wave lengths", default=3.0)
    times: float = number(1.0, 1000.0, "", "recorded time, in contact times", default=6.0)
    places: int = number(3, 4001, "", "radii", default=161)
    instants: int = number(3, 4001, "", "instants of each impact", default=121)


class MicroFront(Section):
    """Speed of the contact's border and of the wave front, time at which the front falls to the
    shear wave, as `impact/front`.
    """

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"

    instants: int = number(3, 1001, "", "instants of each impact", default=101)


class ThermalVolume(Section):
    """Position of the contact surface: depth, volumes, heating, as `impact/position`."""

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"

    variant: int = number(1, 2, "", "1: the border sinks (static), 2: it stays on the surface (impact)", default=2)
    border_factor: Literal["equal", "consistent"] = choice("k_c of variant 1", default="equal")
    expansion: float = number(0.0, 1.0, "1/K", "volume thermal expansion; rubber 6e-4", default=6.0e-4)
    heating: float = number(0.0, 1000.0, "K", "rise of temperature in the contact", default=0.0)
    instants: int = number(3, 1001, "", "instants of each impact", default=101)


class History(Section):
    """Depth by the hereditary integral under the recorded force, for comparison, as
    `impact/history`; flagged where the contact shrinks and the integral no longer holds."""

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"

    model: Literal["kelvin_voigt", "maxwell", "standard_solid"] = choice(
        "model with the complex modulus of the sample at the frequency of the impact", default="kelvin_voigt"
    )
    instant_ratio: float = number(
        1.0, 1e6, "", "instantaneous modulus of standard_solid over that of maxwell, which a large ratio makes kelvin_voigt",
        default=2.0, above=True,
    )  # fmt: skip


class GaugeNoise(Section):
    """Noise of the gauges: relative errors of the measured values in `impact/events`, normal, from
    the scene's seed.
    """

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"

    speed: float = number(0.0, 0.5, "", "standard deviation", default=0.01)
    duration: float = number(0.0, 0.5, "", "standard deviation", default=0.01)
    restitution: float = number(0.0, 0.5, "", "standard deviation", default=0.01)
