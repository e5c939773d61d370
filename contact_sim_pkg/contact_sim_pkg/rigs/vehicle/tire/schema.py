"""The quarter car on its tire, and the effects between tire and road."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.scene.schema.fields import Section, choice, number, numbers
from contact_sim_pkg.scene.schema.laws import HuntCrossley
from contact_sim_pkg.scene.schema.pressure_field import GridSection, PressureFieldSection

Branch: TypeAlias = Annotated[list[float], Field(min_length=2, max_length=2)]


class TireSection(Section):
    """Quarter car on a tire. The static load follows from the masses: 3335 N with the defaults."""

    wheel_mass: float = number(0.1, 2000.0, "kg", "wheel, brake and share of the axle; medium car", default=40.0)
    body_mass: float = number(
        1.0, 20000.0, "kg", "body above the suspension, without the occupant; medium car", default=300.0
    )
    suspension_stiffness: float = number(
        100.0, 1e7, "N/m", "spring between wheel and body; medium car", default=20000.0
    )
    suspension_damping: float = number(0.0, 1e6, "N s/m", "damper between wheel and body; medium car", default=1500.0)
    radius_rolling: float = number(0.02, 3.0, "m", "radius in the plane of the wheel", default=0.30)
    radius_lateral: float = number(0.02, 30.0, "m", "radius of the crown across the tread", default=1.0)
    young_modulus: float = number(
        1e4,
        1e12,
        "Pa",
        "modulus of the half-space for tread and sidewalls together, fitted to the footprint",
        default=3.0e6,
    )
    poisson_ratio: float = number(0.0, 0.5, "", "Poisson's ratio of that half-space; rubber is 0.5", default=0.5)


class HertzElastic(Section):
    """Elastic force of the tire: elliptic Hertz contact, from the radii and the modulus of
    `tire`.
    """


class TireLoss(HuntCrossley):
    """Hunt-Crossley loss: elastic force · (1 + damping · approach rate), never pulling; or
    `restitution` at a speed.
    """

    usual_damping = 0.06

    damping: float | None = number(
        0.0, 100.0, "s/m", "λ; 0.06 by default: 200 N s/m at 3335 N, ζ about 3 %", default=None
    )


class TireField(PressureFieldSection):
    """Pressure field of the tire on a half-space; it is the contact, its integral drives
    the wheel.
    """

    levels = (GridSection(48, 64, 1e-2, 1), GridSection(96, 128, 1e-3, 2), GridSection(192, 256, 1e-6, 4))

    length: float = number(0.01, 2.0, "m", "extent along the road (forward)", default=0.28)
    width: float = number(0.01, 2.0, "m", "extent across the track (left); 0.22 m are loaded at 4 kN", default=0.44)


class RigidRingSection(Section):
    """Sidewalls and a rigid belt ring: spring and damper in series with the tread's contact."""

    stiffness: float = number(
        1e3,
        1e9,
        "N/m",
        "stiffness of the sidewalls; with the default tread 200 kN/m at 3335 N in all (fitted)",
        default=3.1e5,
    )
    damping: float = number(
        0.0, 1e6, "N s/m", "damping of the sidewalls; about 130 N s/m of the whole tire", default=300.0
    )
    belt_mass: float = number(0.1, 1000.0, "kg", "belt and tread, a part of tire.wheel_mass", default=7.0)


class Envelopment(Section):
    """A belt under tension on an elastic foundation yields under the pressure beside the tread, and
    bends over obstacles.
    """

    tension: float = number(
        1.0, 1e6, "N", "tension of the belt over its width; 220 kPa on 0.3 m by 0.15 m give 9900 N", default=9900.0
    )
    foundation: float = number(
        1e3, 1e9, "N/m^2", "radial stiffness of the sidewalls per length of circumference (choice)", default=6.3e5
    )


class TreadViscoelasticitySection(Section):
    """Memory of the tread rubber: a Kelvin-Voigt element and Maxwell branches beside the modulus of
    `tire`, cell by cell.
    """

    retardation_time: float = number(
        0.0, 10.0, "s", "viscosity over the long-time modulus (Kelvin-Voigt); 0: none", default=0.0
    )
    branches: list[Branch] = numbers(
        "",
        "Maxwell branches: [modulus over the long-time modulus, relaxation time in s] each",
        "0 to 8 pairs [ratio from 0 to 100, time from 1e-6 to 1e4 s]",
        default=[[0.15, 0.1], [0.15, 0.01], [0.15, 0.001]],
        shortest=0,
        longest=8,
    )


class BrushSection(Section):
    """Bristles that stick to the road and slip, cell by cell: longitudinal and lateral force,
    aligning moment.
    """

    stiffness_x: float = number(
        1e3, 1e12, "N/m^3", "shear stiffness of the tread per area, along the road (choice)", default=6e7
    )
    stiffness_y: float = number(1e3, 1e12, "N/m^3", "the same across the track; less work where equal", default=6e7)
    coefficient_static: float = number(
        0.0, 5.0, "", "static friction; dry asphalt 0.9 to 1.1", above=True,
        default=1.0,
    )  # fmt: skip
    coefficient_kinetic: float = number(
        0.0, 5.0, "", "kinetic friction, at most coefficient_static; dry asphalt 0.7 to 0.8", above=True, default=0.75
    )


class AsperityImpulsesSection(Section):
    """Push of the road's asperities on the rolling tire, site by site; they act while the tire is
    in contact.
    """

    spacing: float = number(1e-4, 10.0, "m", "distance of two asperities along the road", default=0.02)
    share: float = number(
        0.0, 10.0, "", "share of the standing load on the asperities under the tire (choice)", default=0.1
    )
    window: Literal["rectangular", "raised_cosine"] = choice(
        "time function of an asperity under the tire; raised_cosine is smooth", default="rectangular"
    )
