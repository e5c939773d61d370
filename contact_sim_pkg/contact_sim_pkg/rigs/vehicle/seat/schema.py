"""The occupant on the seat, and the effects between occupant and cushion."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.scene.schema.fields import Section, choice, number, numbers
from contact_sim_pkg.scene.schema.laws import HuntCrossley, PowerLaw
from contact_sim_pkg.scene.schema.pressure_field import GridSection, PressureFieldSection

Mass: TypeAlias = Annotated[float, Field(ge=0.05, le=1000.0)]
Stiffness: TypeAlias = Annotated[float, Field(ge=100.0, le=1e8)]
Damping: TypeAlias = Annotated[float, Field(ge=0.0, le=1e6)]


class OccupantSection(Section):
    """Masses that hang in parallel on the frame mass, which sits on the cushion; Wei and Griffin
    1998, two masses.
    """

    frame_mass: float = number(0.1, 1000.0, "kg", "mass in contact with the cushion", default=6.7)
    masses: list[Mass] = numbers(
        "kg",
        "masses on springs; an empty list is a rigid occupant",
        "0 to 3 numbers, each 0.05 to 1000 kg",
        default=[33.4, 10.7],
        shortest=0,
        longest=3,
    )
    stiffness: list[Stiffness] = numbers(
        "N/m",
        "spring of each mass",
        "one number a mass, each 100 to 1e8 N/m",
        default=[35776.0, 38374.0],
        shortest=0,
        longest=3,
    )
    damping: list[Damping] = numbers(
        "N s/m",
        "damper of each mass",
        "one number a mass, each 0 to 1e6 N s/m",
        default=[761.0, 458.0],
        shortest=0,
        longest=3,
    )


class Body(Section):
    """Form of the body that presses into the cushion: two spheres (buttocks), two cylinders before
    them (thighs).
    """

    buttock_spacing: float = number(0.02, 0.5, "m", "distance between the two lowest points", default=0.13)
    buttock_radius: float = number(0.02, 0.5, "m", "radius of each sphere", default=0.12)
    thigh_radius: float = number(0.02, 0.5, "m", "radius of each cylinder", default=0.09)
    thigh_length: float = number(
        0.0, 1.0, "m", "length of each cylinder, forward from the centre of the sphere; 0: none", default=0.30
    )
    thigh_rise: float = number(
        0.0, 0.2, "m", "height of the lowest line of the thighs above the lowest points", default=0.02
    )


class SeatSection(Section):
    """Occupant on a cushion that stands on the floor."""

    occupant: OccupantSection = Field(default_factory=OccupantSection, description="masses on the cushion")
    body: Body = Field(default_factory=Body, description="shape of the body on the cushion; acts in contact_field")
    backrest: Literal["none"] = choice("occupant without backrest", default="none")
    cushion_modulus: float = number(
        1e3,
        1e9,
        "Pa",
        "Young's modulus of the half-space for the foam (20 to 100 kPa); acts in contact_field",
        default=4.0e4,
    )
    cushion_poisson: float = number(0.0, 0.5, "", "Poisson's ratio of the foam; acts in contact_field", default=0.3)


class PowerElastic(PowerLaw):
    """Elastic force of the cushion: coefficient · approach^exponent. `contact_field` takes its
    place where both act.
    """

    coefficient: float = number(
        1.0,
        1e12,
        "N/m^exponent",
        "A; by default 50 kN/m under 50.8 kg: 498 N at 14.95 mm",
        default=2.73e5,
    )


class SeatLoss(HuntCrossley):
    """Hunt-Crossley loss: elastic force · (1 + damping · approach rate), never pulling; or
    `restitution` at a speed.
    """

    usual_damping = 1.0

    damping: float | None = number(0.0, 100.0, "s/m", "λ; 1.0 by default: 500 N s/m at 498 N", default=None)


class SeatField(PressureFieldSection):
    """Pressure field of the cushion on a half-space; it is the contact, its integral carries the
    occupant.
    """

    levels = (GridSection(40, 40, 1e-3, 0), GridSection(64, 64, 1e-4, 1), GridSection(96, 96, 1e-7, 3))
    """The light frame of an occupant feels a tenth of the error that a wheel feels; the cushion
    does not move under the body, so it needs one corrector pass fewer."""

    length: float = number(0.05, 5.0, "m", "extent forward", default=0.6)
    width: float = number(0.05, 5.0, "m", "extent to the left", default=0.5)


class PressureMat(Section):
    """Pressure under the occupant of the point contact's force: spread over the cells as a bed of
    springs under the body would.
    """

    length: float = number(0.05, 5.0, "m", "extent forward", default=0.6)
    width: float = number(0.05, 5.0, "m", "extent to the left", default=0.5)
    rows: int = number(4, 256, "", "cells forward", default=36)
    cols: int = number(4, 256, "", "cells to the left", default=30)
