"""Bodies of the rigs: the quarter car on its tire, the occupant on the seat."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.scene.schema.fields import Section, choice, number, numbers

Mass: TypeAlias = Annotated[float, Field(ge=0.05, le=1000.0)]
Stiffness: TypeAlias = Annotated[float, Field(ge=100.0, le=1e8)]
Damping: TypeAlias = Annotated[float, Field(ge=0.0, le=1e6)]


class Tire(Section):
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


class Occupant(Section):
    """Masses that hang in parallel on the frame mass, which sits on the cushion; Wei and Griffin 1998, two masses."""

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
    """Form of the body that presses into the cushion: two spheres (buttocks), two cylinders before them (thighs)."""

    buttock_spacing: float = number(0.02, 0.5, "m", "distance between the two lowest points", default=0.13)
    buttock_radius: float = number(0.02, 0.5, "m", "radius of each sphere", default=0.12)
    thigh_radius: float = number(0.02, 0.5, "m", "radius of each cylinder", default=0.09)
    thigh_length: float = number(
        0.0, 1.0, "m", "length of each cylinder, forward from the centre of the sphere; 0: none", default=0.30
    )
    thigh_rise: float = number(
        0.0, 0.2, "m", "height of the lowest line of the thighs above the lowest points", default=0.02
    )


class Seat(Section):
    """Occupant on a cushion that stands on the floor."""

    occupant: Occupant = Field(default_factory=Occupant, description="masses on the cushion")
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
