"""The occupant on the seat, and the effects between occupant and cushion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.report.signal.spectrum import segment_samples
from contact_sim_pkg.rigs.vehicle.seat.occupants import OCCUPANTS, SEATED_MASS, Link, OccupantModel, scaled, stiffened
from contact_sim_pkg.scene.schema.fields import Section, choice, number, numbers
from contact_sim_pkg.scene.schema.laws import (
    USUAL_PERCENTILE,
    USUAL_REVERSAL,
    CushionSection,
    FoamHysteresisSection,
    HuntCrossley,
    PowerLaw,
)
from contact_sim_pkg.scene.schema.pressure_field import GridSection, PressureFieldSection

OWN = "own"
PAN_TILT = 0.21  # [rad], 12 degrees
LONGEST_SEGMENT = 1000.0  # [s]
NAMES = (*OCCUPANTS, OWN)

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene

    ModelName: TypeAlias = str
else:
    ModelName = Literal[NAMES]

TISSUE_DEPTH = 0.01
"""[m] c0 of soft tissue, where a scene names none."""

REFERENCE_MASS = 50.8  # [kg] under which a reversal takes 1 J

Mass: TypeAlias = Annotated[float, Field(ge=0.05, le=1000.0)]
Stiffness: TypeAlias = Annotated[float, Field(ge=100.0, le=1e8)]
Damping: TypeAlias = Annotated[float, Field(ge=0.0, le=1e6)]
Ends: TypeAlias = Annotated[list[Annotated[int, Field(ge=0, le=8)]], Field(min_length=2, max_length=2)]


class OccupantSection(Section):
    """Masses on springs and dampers, the first of them in contact with the cushion: an occupant of
    the literature by name, scaled and stiffened, or your own; a value that is given replaces that
    of the model.
    """

    fixed: ClassVar[str] = "an occupant is one model as a whole"

    model: ModelName = choice(
        f"occupant of the literature, or {OWN}: masses, stiffness and damping are given", default="wei_griffin_2"
    )
    percentile: Literal[5, 50, 95] | None = choice(
        "body whose mass the model is scaled to, 73 % of it on the cushion: 36.5 (woman), 57 or 74.5 kg", default=None
    )
    mass: float | None = number(
        1.0, 1000.0, "kg", "mass on the cushion that the model is scaled to; its own by default", default=None
    )
    posture: float = number(
        0.25, 4.0, "", "factor on the springs, damping ratios kept; erect or tense 1.1 to 1.25", default=1.0
    )
    frame_mass: float | None = number(
        0.0,
        1000.0,
        "kg",
        "mass in contact with the cushion, 0: massless; that of the model by default",
        default=None,
        live="law",
    )
    masses: list[Mass] | None = numbers(
        "kg",
        "masses on springs; an empty list is a rigid occupant; those of the model by default",
        "0 to 8 numbers, each 0.05 to 1000 kg",
        default=None,
        shortest=0,
        longest=8,
    )
    links: list[Ends] | None = numbers(
        "",
        "ends of each link: 0 the frame, 1 the first of masses; each mass on the frame by default, or as in the model",
        "0 to 16 pairs [lower, upper]",
        default=None,
        shortest=0,
        longest=16,
    )
    stiffness: list[Stiffness] | None = numbers(
        "N/m",
        "spring of each link; that of the model by default",
        "one number a link, each 100 to 1e8 N/m",
        default=None,
        shortest=0,
        longest=16,
    )
    damping: list[Damping] | None = numbers(
        "N s/m",
        "damper of each link; that of the model by default",
        "one number a link, each 0 to 1e6 N s/m",
        default=None,
        shortest=0,
        longest=16,
    )
    head: int | None = number(
        1, 8, "", "number of the mass that is the head; that of the model by default, if it has one", default=None
    )

    def open_values(self, scene: Scene) -> dict[str, Any]:
        return self.following()

    def following(self) -> dict[str, Any]:
        """Values that follow from name, mass and posture; none for one's own."""
        named = self.named()
        if named is None:
            return {}
        values: dict[str, Any] = {
            "frame_mass": named.masses[0],
            "masses": list(named.masses[1:]),
            "stiffness": [link.stiffness for link in named.links],
            "damping": [link.damping for link in named.links],
        }
        # What an earlier version resolved has neither links nor a head.
        links = [list(link[:2]) for link in named.links]
        if links != _on_frame(len(links)):
            values["links"] = links
        if named.head is not None:
            values["head"] = named.head
        return values

    def named(self) -> OccupantModel | None:
        """The model of the name with mass and posture, before any other value; None for one's
        own.
        """
        if self.model == OWN:
            return None
        found = OCCUPANTS[self.model]
        mass = self.mass if self.percentile is None else SEATED_MASS[self.percentile]
        found = found if mass is None else scaled(found, mass)
        return found if self.posture == 1.0 else stiffened(found, self.posture)

    def model_of(self) -> OccupantModel:
        """The occupant, whose values `occupant_breaches` has found to belong together."""
        values = {**self.following(), **self.model_dump(exclude_none=True)}
        ends = values.get("links", _on_frame(len(values["masses"])))
        links = zip(ends, values["stiffness"], values["damping"], strict=True)
        return OccupantModel(
            masses=(values["frame_mass"], *values["masses"]),
            links=tuple(Link(lower, upper, k, c) for (lower, upper), k, c in links),
            head=values.get("head"),
            source=self.model if self.model == OWN else OCCUPANTS[self.model].source,
        )


def _on_frame(count: int) -> list[list[int]]:
    """Ends of links side by side between the frame and each mass."""
    return [[0, number] for number in range(1, count + 1)]


class Body(Section):
    """Form of the body that presses into the cushion: two spheres (buttocks), two cylinders before
    them (thighs).
    """

    fixed: ClassVar[str] = "the form of a body is that of its cells"

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

    fixed: ClassVar[str] = "the seat is built once"

    occupant: OccupantSection = Field(default_factory=OccupantSection, description="masses on the cushion")
    body: Body = Field(default_factory=Body, description="shape of the body; acts in half_space_field")
    pan_tilt: float | None = number(
        0.0, 0.6, "rad", f"tilt of the pan, front edge up; rig occupant alone, {PAN_TILT:g} by default", default=None
    )
    backrest: Literal["none"] = choice("occupant without backrest", default="none")
    cushion_modulus: float = number(
        1e3,
        1e9,
        "Pa",
        "Young's modulus of the half-space for the foam (20 to 100 kPa); acts in half_space_field",
        default=4.0e4,
    )
    cushion_poisson: float = number(0.0, 0.5, "", "Poisson's ratio of the foam; acts in half_space_field", default=0.3)

    response_segment: float | None = number(
        0.0,
        LONGEST_SEGMENT,
        "s",
        "segment of Welch's method in seat/response, half overlapping; 0: none; by default 4 s, less in a run of less than 18 s",
        default=None,
    )

    def open_values(self, scene: Scene) -> dict[str, Any]:
        rate = scene.outputs.force_rate
        shortest, longest = segment_range(rate)
        segment = segment_samples(round(scene.duration * rate), rate) / rate
        segment = min(max(segment, shortest), longest)
        return {"response_segment": segment, **({"pan_tilt": PAN_TILT} if scene.rig == "occupant" else {})}


def segment_range(rate: float) -> tuple[float, float]:
    """Shortest and longest segment [s] of the responses at a ``rate`` [Hz] of samples: frequencies of
    10 Hz and its multiples, four samples; 2^18 samples, a memory of 40 MB, at most `LONGEST_SEGMENT`.
    """
    return max(0.1, 4.0 / rate), min(2.0**18 / rate, LONGEST_SEGMENT)


class PowerElastic(PowerLaw):
    """Elastic force of the cushion: coefficient · approach^exponent. `half_space_field` takes its
    place where both act.
    """

    coefficient: float = number(
        1.0, 1e12, "N/m^exponent", "A; by default 50 kN/m under 50.8 kg: 498 N at 14.95 mm", default=2.73e5, live="law"
    )


class SeatLoss(HuntCrossley):
    """Hunt-Crossley loss: elastic force · (1 + damping · approach rate), never pulling; or
    `restitution` at a speed.
    """

    usual_damping = 1.0

    damping: float | None = number(0.0, 100.0, "s/m", "λ; 1.0 by default: 500 N s/m at 498 N", default=None, live="law")


class SeatCushion(CushionSection):
    """Foam cushion of finite thickness under buttocks and thighs, in place of normal_elastic: its
    force is the integral of its pressure. With tissue the body spreads on a harder seat: its form is
    that on the default foam under its own weight.
    """

    carrier: Literal["foam", "plate"] = choice(
        "foam on a rigid base, or a rigid plate, which needs tissue", default="foam"
    )
    tissue: float | None = number(
        100.0, 1e5, "Pa",
        "A of the soft tissue, p = A (exp(c/c₀) − 1) at the compression c; 2000 by measured thickness; none: the body is rigid",
        default=None,
    )  # fmt: skip
    tissue_depth: float | None = number(0.002, 0.05, "m", "c₀ of the tissue; 0.01 beside tissue", default=None)
    thigh_tilt: float = number(
        -0.2,
        0.2,
        "rad",
        "angle of the pan against the thighs, front up positive: more load under them",
        default=0.0,
    )

    def open_values(self, scene: Scene) -> dict[str, Any]:
        percentile = scene.section(SeatSection).occupant.percentile or USUAL_PERCENTILE
        depth = {} if self.tissue is None else {"tissue_depth": TISSUE_DEPTH}
        return {**super().open_values(scene), "percentile": percentile, **depth}


class SeatHysteresis(FoamHysteresisSection):
    """Dissipation of the foam without rate. On a cushion the energy of a reversal grows with the
    load at rest: 1 J under 50.8 kg, so that the dynamic stiffness grows with the load and not with
    its square.
    """

    def open_values(self, scene: Scene) -> dict[str, Any]:
        usual = super().open_values(scene)
        if scene.effect("seat", SeatCushion) is None:
            return usual
        mass = sum(scene.section(SeatSection).occupant.model_of().masses)
        return {**usual, "energy": USUAL_REVERSAL * mass / REFERENCE_MASS}


class CushionMap(Section):
    """Pressure map of the cushion at the field rate: that of the force law, so the motion is the
    same with and without it.
    """

    fixed: ClassVar[str] = "its cells are those of the run's maps"


class HalfSpaceField(PressureFieldSection):
    """Pressure field of the cushion as a half-space; it is the contact, its integral carries the
    occupant. A layer of foam is stiffer: use cushion.
    """

    levels = (GridSection(40, 40, 1e-3, 0), GridSection(64, 64, 1e-4, 1), GridSection(96, 96, 1e-7, 3))
    """The light frame of an occupant feels a tenth of the error that a wheel feels; the cushion
    does not move under the body, so it needs one corrector pass fewer."""

    length: float = number(0.05, 5.0, "m", "extent forward", default=0.6)
    width: float = number(0.05, 5.0, "m", "extent to the left", default=0.5)


class SofteningSection(Section):
    """Links of the occupant that soften with vibration: stiffness by r^(-2 exponent), damping by
    r^(-exponent), r the running rms of the seat's vertical acceleration over 1 m/s².
    """

    fixed: ClassVar[str] = "the links have softened by it so far"

    exponent: float = number(
        0.0, 0.5, "", "0.195: apparent-mass peak from 6 Hz at 0.25 to 4 Hz at 2 m/s² rms; 0.11: from 5.4 to 4.2 Hz",
        default=0.195,
    )  # fmt: skip
    time_constant: float = number(0.1, 60.0, "s", "of the running mean square", default=5.0)
    least: float = number(0.01, 10.0, "m/s^2", "rms below which nothing changes", default=0.25)
    most: float = number(0.01, 100.0, "m/s^2", "rms above which nothing changes, above least", default=2.5)
