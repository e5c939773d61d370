"""The quarter car on its tire, and the effects between tire and road."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.rigs.vehicle.field.inflated_belt import ring_stiffness
from contact_sim_pkg.rigs.vehicle.tire.mount_section import MountSection
from contact_sim_pkg.rigs.vehicle.tire.programme import TireProgramme
from contact_sim_pkg.rigs.vehicle.tire.size import PATTERN, read_size
from contact_sim_pkg.scene.schema.fields import Section, choice, number, numbers, text
from contact_sim_pkg.scene.schema.laws import HuntCrossley
from contact_sim_pkg.scene.schema.pressure_field import GridSection, PressureFieldSection, WithEffects

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene

RING_DAMPING = 0.045
"""Damping ratio of the belt on its sidewalls."""

TREAD_MEMORY, FALL, BELT_MEMORY = 0.125, 0.25, 3.8
"""Branches of a tread: modulus of that of 1 ms over the long-time modulus, the power with which it falls
with the relaxation time; memory of the rubber in belt and sidewalls over that of the tread (fitted to rolling resistance).
"""

RELAXATION_TIMES = (0.01, 0.003, 0.001, 0.0003, 0.0001)  # [s]

Branch: TypeAlias = Annotated[list[float], Field(min_length=2, max_length=2)]
TorquePoint: TypeAlias = Annotated[list[float], Field(min_length=3, max_length=3)]


class TireSection(Section):
    """Quarter car on a tire. The static load follows from the masses: 3335 N with the defaults."""

    wheel_mass: float = number(
        0.1, 2000.0, "kg", "wheel, brake and share of the axle; medium car", default=40.0, live="law"
    )
    body_mass: float = number(
        1.0, 20000.0, "kg", "body above the suspension, without the occupant; medium car", default=300.0, live="law"
    )
    suspension_stiffness: float = number(
        100.0, 1e7, "N/m", "spring between wheel and body; medium car", default=20000.0, live="law"
    )
    suspension_damping: float = number(
        0.0, 1e6, "N s/m", "damper between wheel and body; medium car", default=1500.0, live="law"
    )
    mount: MountSection | None = choice("what the axle is mounted on; the quarter car by default", default=None)
    programme: TireProgramme | None = choice("what a test machine runs over time", default=None)


class HertzElastic(Section):
    """The tire of the paper: a half-space of rubber with two radii; elliptic Hertz contact."""

    fixed: ClassVar[str] = "form and rubber of a tire are made once"

    radius_rolling: float = number(0.02, 3.0, "m", "radius in the plane of the wheel", default=0.30)
    radius_lateral: float = number(0.02, 30.0, "m", "radius of the crown across the tread", default=1.0)
    young_modulus: float | None = number(
        1e4, 1e12, "Pa",
        "modulus of the half-space for tread and sidewalls together; 6.8e5 by default, 3.0e6 with rigid_ring: as stiff "
        "as the inflated default at 3335 N",
        default=None,
    )  # fmt: skip
    poisson_ratio: float = number(0.0, 0.5, "", "Poisson's ratio of that half-space; rubber is 0.5", default=0.5)

    def open_values(self, scene: Scene) -> dict[str, Any]:
        # Hertz: K = 1.5 A^(2/3) F^(1/3), A in proportion to the modulus; a ring is a spring of 3.1e5 N/m in series.
        return {"young_modulus": 6.8e5 if scene.effect("tire", RigidRingSection) is None else 3.0e6}


class Inflation(Section):
    """Inflated tire: a belt under tension of the inflation on membrane sidewalls, tread on top.
    Stiffness and footprint follow from size, inflation and load.
    """

    fixed: ClassVar[str] = "size and structure of a tire are made once"

    size: str = text(
        "size on the sidewall: width in mm, height in per cent, rim in inches", default="205/55 R16", pattern=PATTERN
    )
    radius: float | None = number(0.15, 0.8, "m", "free radius; that of the size by default", default=None)
    pressure: float = number(
        1e5, 4e5, "Pa", "inflation above the air outside; the model is for 120 to 300 kPa", default=220e3, live="law"
    )
    sidewall_angle: float = number(
        0.6, 1.57, "rad", "half angle of the inflated sidewall's arc; 0.79 to 0.94 of car tires (fitted)", default=0.863
    )
    sidewall_chord: float | None = number(
        0.02, 0.6, "m", "chord of that arc; 0.887 of the section height by default", default=None
    )
    belt_width: float | None = number(
        0.05, 0.4, "m", "belt under pressure; 0.839 of the section width by default", default=None
    )
    structure: float = number(0.0, 1e7, "N/m^2", "radial stiffness of the sidewalls without inflation", default=1.02e5)
    tangential: float = number(1e4, 1e8, "N/m^2", "tangential stiffness of the sidewalls", default=1.07e5)
    bending: float = number(0.0, 1e3, "N m^2", "bending stiffness of the belt along; 1 to 10", default=2.0)
    tread_modulus: float = number(
        1e5, 1e9, "Pa", "modulus of the half-space for tread and cross bending of the belt (fitted)", default=7.9e6
    )
    tread_poisson: float = number(0.0, 0.5, "", "Poisson's ratio of that half-space; rubber is 0.5", default=0.5)
    crown_radius: float = number(0.1, 30.0, "m", "radius of the inflated crown across the tread", default=2.29)
    shoulder: float = number(
        0.0, 0.02, "m", "fall of the shoulder's round, with the 6th power, at half the belt's width", default=1.5e-3
    )
    ring_stiffness: float = number(
        1e5, 1e8, "N/m", "rigid ring against the rim at 220 kPa; a quarter of it is there without inflation",
        default=1.19e6,
    )  # fmt: skip

    def open_values(self, scene: Scene) -> dict[str, Any]:
        size = read_size(self.size, self.radius)
        return {"sidewall_chord": size.sidewall_chord, "belt_width": size.belt_width}


class TireLoss(HuntCrossley):
    """Hunt-Crossley loss: elastic force · (1 + damping · approach rate), never pulling; or
    `restitution` at a speed.
    """

    usual_damping = 0.015

    damping: float | None = number(
        0.0, 100.0, "s/m", "λ; 0.015 by default: 50 N s/m at 3335 N, ζ about 1 %", default=None, live="law"
    )


class TireField(PressureFieldSection):
    """Pressure field of the tire; it is the contact, its integral drives the wheel."""

    # The residual is over all that yields; of a belt and a ring that is ten times the tread
    levels = (GridSection(72, 48, 1e-3, 1), GridSection(90, 60, 1e-4, 1), GridSection(144, 96, 1e-6, 2))
    half_space_levels: ClassVar = (
        GridSection(48, 64, 1e-3, 1), GridSection(96, 128, 1e-4, 1), GridSection(144, 192, 1e-6, 2),
    )  # fmt: skip

    length: float | None = number(
        0.01, 2.0, "m", "extent along the road (forward); 0.27 by default, 0.28 with normal_elastic", default=None
    )
    width: float | None = number(
        0.01, 2.0, "m", "extent across the track (left); 0.18 by default, 0.44 with normal_elastic", default=None
    )

    @classmethod
    def levels_of(cls, scene: WithEffects) -> tuple[GridSection, ...]:
        return cls.half_space_levels if scene.effect("tire", Inflation) is None else cls.levels

    def open_values(self, scene: Scene) -> dict[str, Any]:
        inflation = scene.effect("tire", Inflation)
        length, width = (0.28, 0.44) if inflation is None else read_size(inflation.size, inflation.radius).grid
        return {**super().open_values(scene), "length": length, "width": width}


class RigidRingSection(Section):
    """Sidewalls and a rigid belt ring: spring and damper in series with the tread's contact."""

    fixed: ClassVar[str] = "the belt is part of the wheel from the start"

    stiffness: float | None = number(
        1e3, 1e9, "N/m", "stiffness of the sidewalls; that of the inflation by default, 3.1e5 with normal_elastic",
        default=None, live="law")  # fmt: skip
    damping: float | None = number(
        0.0,
        1e6,
        "N s/m",
        "damping of the sidewalls; 4.5 % of critical by default, 300 with normal_elastic",
        default=None,
        live="law",
    )
    belt_mass: float = number(0.1, 1000.0, "kg", "belt and tread, a part of tire.wheel_mass", default=7.0)

    def open_values(self, scene: Scene) -> dict[str, Any]:
        inflation = scene.effect("tire", Inflation)
        if inflation is None:
            return {"stiffness": 3.1e5, "damping": 300.0}
        stiffness = (
            ring_stiffness(inflation.ring_stiffness, inflation.pressure) if self.stiffness is None else self.stiffness
        )
        return {"stiffness": stiffness, "damping": 2.0 * RING_DAMPING * math.sqrt(stiffness * self.belt_mass)}


class Envelopment(Section):
    """A belt under tension on an elastic foundation yields under the pressure beside the tread, and
    bends over obstacles.
    """

    fixed: ClassVar[str] = "the belt's influence on the cells is made once"

    tension: float = number(
        1.0, 1e6, "N", "tension of the belt over its width; 220 kPa on 0.3 m by 0.15 m give 9900 N", default=9900.0
    )
    foundation: float = number(
        1e3, 1e9, "N/m^2", "radial stiffness of the sidewalls per length of circumference (choice)", default=6.3e5
    )


class _Rubber(Section):
    """Memory of the tread rubber, and of that in belt and sidewalls of an inflated tire."""

    fixed: ClassVar[str] = "the rubber's memory is kept branch by branch"

    retardation_time: float = number(
        0.0, 10.0, "s", "viscosity over the long-time modulus (Kelvin-Voigt); 0: none", default=0.0
    )
    branches: list[Branch] | None = numbers(
        "",
        "Maxwell branches: [modulus over the long-time modulus, relaxation time in s] each; by default five from 10 to "
        "0.1 ms with inflation, 0.125 at 1 ms (a loss factor of about 0.12), three of 0.15 with normal_elastic",
        "0 to 8 pairs [ratio from 0 to 100, time from 1e-6 to 1e4 s]",
        default=None,
        shortest=0,
        longest=8,
    )
    belt: float = number(
        0.0, 10.0, "", "the same of belt and sidewalls of an inflated tire, over that of the tread (fitted to rolling resistance)",
        default=BELT_MEMORY,
    )  # fmt: skip

    def open_values(self, scene: Scene) -> dict[str, Any]:
        if scene.effect("tire", Inflation) is None:
            return {"branches": [[0.15, time] for time in (0.1, 0.01, 0.001)]}
        return {"branches": [[round(TREAD_MEMORY * (1e-3 / time) ** FALL, 4), time] for time in RELAXATION_TIMES]}


class TreadViscoelasticitySection(_Rubber):
    """Memory of the tread rubber, and of that in belt and sidewalls of an inflated tire: a Kelvin-Voigt
    element and Maxwell branches beside the modulus at long times. The tire's rolling resistance.
    """


class RollingLossSection(_Rubber):
    """Rolling resistance of an inflated tire by the same memory, as a sum over the waves of its standing
    footprint: the pressure field stays elastic, or there is none.
    """


class BrushSection(Section):
    """Bristles that stick to the road and slip, cell by cell: longitudinal and lateral force,
    aligning moment.
    """

    fixed: ClassVar[str] = "the bristles hold their deflection by it"

    stiffness_x: float = number(
        1e3, 1e12, "N/m^3", "shear stiffness of the tread per area, along the road (fitted)", default=9.6e7
    )
    stiffness_y: float = number(1e3, 1e12, "N/m^3", "the same across the track; less work where equal", default=9.6e7)
    coefficient_static: float = number(
        0.0,
        5.0,
        "",
        "static friction; the peak of a dry road, 0.9 to 1.1, lies below it",
        above=True,
        default=1.15,
        live="law",
    )
    coefficient_kinetic: float = number(
        0.0,
        5.0,
        "",
        "sliding fast, at most coefficient_static; dry asphalt 0.7 to 0.8",
        above=True,
        default=0.8,
        live="law",
    )
    sliding_speed: float = number(
        0.0,
        1e3,
        "m/s",
        "of the fall from static to kinetic, exp(-v / sliding_speed); 0: at once",
        default=4.0,
        live="law",
    )
    nominal_load: float = number(
        1.0, 1e6, "N", "load at which the coefficients hold; heavier loaded tires have less friction", default=4000.0
    )
    load_exponent: float = number(
        0.0,
        1.0,
        "",
        "friction along falls with the load over the nominal one to this power; 0: it does not",
        default=0.10,
    )
    load_exponent_across: float = number(
        0.0, 1.0, "", "the same sideways; 7 and 10 % a doubling measured", default=0.15
    )


class SidewallComplianceSection(Section):
    """Belt that yields on the sidewalls along, across, in rotation and in yaw: relaxation of the slip
    forces, force over a cleat with its modes at 33 and 80 Hz.
    """

    fixed: ClassVar[str] = "the belt holds its deflection by it, and tire/work books its energy part by part"

    longitudinal: float | None = number(
        1e3, 1e9, "N/m", "belt against rim along the road; that of rigid_ring by default", default=None
    )
    lateral: float = number(
        1e3, 1e9, "N/m", "across; with the bristles in series 158 kN/m, a standing tire's", default=1.75e5
    )
    rotational: float = number(10.0, 1e8, "N m/rad", "about the axle", default=8.2e4)
    yaw: float = number(10.0, 1e8, "N m/rad", "about the vertical (fitted)", default=5200.0)
    bending: float = number(
        0.0, 1.0, "1/(m N)", "curvature of the belt in the plane of the road per side force (fitted); 0: rigid",
        default=1.3e-4,
    )  # fmt: skip
    extension: float = number(
        0.0,
        1.0,
        "1/(m N)",
        "strain of the belt along, per metre of contact and force along (fitted); 0: none",
        default=6e-5,
    )
    damping_ratio: float = number(0.0, 1.0, "", "of critical, of each motion alone", default=0.045)
    belt_mass: float | None = number(
        0.1, 1000.0, "kg", "belt and tread; that of rigid_ring by default, 7 without", default=None
    )
    belt_inertia: float = number(1e-4, 1e4, "kg m^2", "about the axle; half of it about the vertical", default=0.6)

    def open_values(self, scene: Scene) -> dict[str, Any]:
        ring = scene.effect("tire", RigidRingSection)
        found = (ring or RigidRingSection()).open_values(scene)
        stiffness = ring.stiffness if ring is not None and ring.stiffness is not None else found["stiffness"]
        return {"longitudinal": stiffness, "belt_mass": (ring or RigidRingSection()).belt_mass}


class WheelSpinSection(Section):
    """Rotation of the wheel as a state: free rolling, or `drive` and `brake` on the rim, constant or
    as `points` straight between them.
    """

    fixed: ClassVar[str] = "the energy of the rotation is booked with it in tire/work"

    inertia: float = number(1e-3, 1e4, "kg m^2", "rim, hub and what turns with them; 0.4 to 0.9", default=0.5)
    drive: float | None = number(
        -1e5, 1e5, "N m", "moment that drives the rim forward; 0 if absent", default=None, live="excitation"
    )
    brake: float | None = number(
        0.0, 1e5, "N m", "moment against its rotation; 0 if absent", default=None, live="excitation"
    )
    points: list[TorquePoint] | None = numbers(
        "s, N m, N m",
        "drive and brake over time, constant after the last point",
        "triples [time, drive, brake], first time 0, times increasing to at most 3600 s, moments as above",
        default=None,
        shortest=1,
        longest=1000,
    )


class AsperityImpulsesSection(Section):
    """Push of the road's asperities on the rolling tire, site by site; they act while the tire is
    in contact.
    """

    fixed: ClassVar[str] = "the asperities under the tire were given their push by it"

    spacing: float = number(1e-4, 10.0, "m", "distance of two asperities along the road", default=0.02)
    share: float = number(
        0.0, 10.0, "", "share of the standing load on the asperities under the tire (choice)", default=0.1
    )
    window: Literal["rectangular", "raised_cosine"] = choice(
        "time function of an asperity under the tire; raised_cosine is smooth", default="rectangular"
    )
