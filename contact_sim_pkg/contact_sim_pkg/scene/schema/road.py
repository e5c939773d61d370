"""Roads of a scene: flat, ISO 8608, self-affine, single obstacles, OpenCRG files, profiles; and the speed
programme on them.
"""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.scene.schema.fields import Section, choice, number, numbers, text

SpeedPoint: TypeAlias = Annotated[list[float], Field(min_length=2, max_length=2)]
SlipPoint: TypeAlias = Annotated[list[float], Field(min_length=3, max_length=3)]
MissingCells: TypeAlias = Literal["refuse", "fill", "hole"]
Border: TypeAlias = Literal["refuse", "zero", "keep", "repeat", "reflect"]
FileSettings: TypeAlias = Literal["refuse", "apply", "ignore"]
RoughnessClass: TypeAlias = Literal["A", "B", "C", "D", "E", "F", "G", "H"]

POSITION_HELP = "middle of the obstacle along the road"
BORDER_HELP = "after the end of the road, and before its beginning where start is negative"
PERIOD_HELP = "distance to the next equal obstacle; without it there is one"


class TravelSection(Section):
    """How fast the wheel rolls: `speed`, or `points` of a piecewise linear speed; one of the
    two.
    """

    speed: float | None = number(0.0, 100.0, "m/s", "constant speed", default=None)
    points: list[SpeedPoint] | None = numbers(
        "s, m/s",
        "speed over time, straight between the points, constant after the last",
        "pairs [time, speed], first time 0, times increasing to at most 3600 s, speeds 0 to 100 m/s",
        default=None,
        shortest=1,
        longest=1000,
    )


class Slip(Section):
    """Slip of the rolling tire over time, for the effect `brush`: constant values, or `points`
    straight between them.
    """

    longitudinal: float | None = number(
        -1.0,
        10.0,
        "",
        "(wheel speed times radius - v) / v: braking is negative, -1 is locked; 0 if absent",
        default=None,
    )
    angle: float | None = number(
        -1.5, 1.5, "rad", "slip angle; positive makes the lateral force negative (ISO 8855); 0 if absent", default=None
    )
    points: list[SlipPoint] | None = numbers(
        "s, -, rad",
        "longitudinal slip and slip angle over time, constant after the last point",
        "triples [time, longitudinal, angle], first time 0, times increasing to at most 3600 s, slips as above",
        default=None,
        shortest=1,
        longest=1000,
    )


class FlatRoadSection(Section):
    """An even road at height 0."""

    kind: Literal["flat"]


class TextureSection(Section):
    """Fine surface below the shortest wavelength of an ISO 8608 profile, equal in all
    directions.
    """

    shortest_wavelength: float = number(
        0.001,
        1.0,
        "m",
        "shortest wavelength of the texture; at least two cells of the contact field are resolved",
        default=0.02,
    )


class Iso8608RoadSection(Section):
    """Random road with the spectrum G(n) = roughness (n / 0.1 c/m)^-exponent; `roughness_class` or
    `roughness`.
    """

    kind: Literal["iso8608"]
    roughness_class: RoughnessClass | None = choice("ISO 8608 class, taken at its geometric mean", default=None)
    roughness: float | None = number(
        0.0, 1.0, "m³", "spectral density at 0.1 cycles/m; class A is 16e-6, C is 256e-6", default=None
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


class SelfAffineRoadSection(Section):
    """Random surface, equal in all directions, of spectrum q^-(2 + 2 hurst) between two wavelengths
    (the irregular road of Tire/Road Contact).
    """

    kind: Literal["self_affine"]
    hurst: float = number(0.0, 1.0, "", "Hurst's exponent; 0.8 for road surfaces", default=0.8)
    rms: float = number(0.0, 0.05, "m", "root mean square of the heights", default=5e-4)
    shortest_wavelength: float = number(
        0.001, 1.0, "m", "shortest wavelength; at least two cells of the contact field are resolved", default=0.005
    )
    longest_wavelength: float = number(0.001, 1.0, "m", "longest wavelength", default=0.2)


class BumpRoad(Section):
    """One bump, or a row of them, on an even road: height/2 (1 + cos(2π s / length))."""

    kind: Literal["bump"]
    position: float = number(-1e6, 1e6, "m", POSITION_HELP, example=3.0)
    height: float = number(-0.5, 0.5, "m", "height of the crest; negative is a dip", example=0.05)
    length: float = number(0.001, 100.0, "m", "length along the road", example=0.5)
    shape: Literal["raised_cosine"] = choice("form of the bump", default="raised_cosine")
    period: float | None = number(0.001, 1e6, "m", PERIOD_HELP, default=None)


class CleatRoad(Section):
    """A bar across the road, such as 10 mm × 50 mm; sharp edges unless it has flanks."""

    kind: Literal["cleat"]
    position: float = number(-1e6, 1e6, "m", POSITION_HELP, example=3.0)
    height: float = number(-0.5, 0.5, "m", "height of the bar; negative is a slot", example=0.01)
    length: float = number(0.001, 100.0, "m", "length along the road, flanks included", example=0.05)
    edge: float = number(0.0, 50.0, "m", "length of each straight flank; 0 is a sharp edge", default=0.0)
    period: float | None = number(0.001, 1e6, "m", PERIOD_HELP, default=None)


class StepRoad(Section):
    """An even road that goes on at another height."""

    kind: Literal["step"]
    position: float = number(-1e6, 1e6, "m", "middle of the step along the road", example=3.0)
    height: float = number(-0.5, 0.5, "m", "height behind the step; negative goes down", example=0.02)
    length: float = number(0.0, 100.0, "m", "length of the straight ramp; 0 is a sharp edge", default=0.0)


class PotholeRoad(Section):
    """A hole across the road. A wheel of radius r drops at most r - √(r² - (length/2)²), whatever
    the depth.
    """

    kind: Literal["pothole"]
    position: float = number(-1e6, 1e6, "m", POSITION_HELP, example=3.0)
    depth: float = number(0.0, 0.5, "m", "depth of the bottom", above=True, example=0.05)
    length: float = number(0.001, 100.0, "m", "length along the road, flanks included", example=0.3)
    edge: float = number(0.0, 50.0, "m", "length of each straight flank; 0 is a sharp edge", default=0.0)
    period: float | None = number(0.001, 1e6, "m", PERIOD_HELP, default=None)


class OpenCrgRoadSection(Section):
    """A road from an ASAM OpenCRG file (text or binary)."""

    kind: Literal["opencrg"]
    file: str = text(
        "file name, from the scene file's folder; data/… also finds the files of the package",
        longest=500,
        example="road.crg",
    )
    sha256: str | None = text("checksum of the file; other content is refused", default=None, pattern="^[0-9a-f]{64}$")
    track_offset: float = number(
        -100.0, 100.0, "m", "line of travel, to the left of the reference line (v)", default=0.0
    )
    start: float = number(-1e6, 1e6, "m", "start of the wheel, from the beginning of the road (u)", default=0.0)
    missing_cells: MissingCells = choice(
        "cells without height: refuse the file, fill from their neighbours, or a hole", default="refuse"
    )
    hole_depth: float = number(0.0, 0.5, "m", "depth of a hole (missing_cells: hole)", default=0.05)
    border_u: Border = choice(BORDER_HELP, default="refuse")
    border_v: Border = choice("beyond the left and right side of the road", default="keep")
    remove_mean: bool = choice("shift the mean height to 0, else the height at the start", default=True)
    file_settings: FileSettings = choice(
        "options and modifiers of the file: refuse the file, apply, or ignore", default="refuse"
    )


class ProfileRoadSection(Section):
    """A longitudinal profile: pairs of distance x and height z, or x, z_left, z_right; a table, UMTRI
    ERD, or RDF.
    """

    kind: Literal["profile"]
    file: str = text(
        "file name, from the scene file's folder; straight between its points", longest=500, example="x_z.csv"
    )
    sha256: str | None = text("checksum of the file; other content is refused", default=None, pattern="^[0-9a-f]{64}$")
    header_line: int | None = number(
        1, 100000, "", "line that names the columns; without it the first that is no comment", default=None
    )
    track_width: float = number(
        0.1, 10.0, "m", "distance of two tracks; straight across between them, level beyond", default=1.5
    )
    track_offset: float | None = number(
        -100.0, 100.0, "m", "line of travel, to the left of the middle; without it the left of two tracks", default=None
    )
    start: float = number(-1e6, 1e6, "m", "start of the wheel, from the first point of the road", default=0.0)
    border_u: Border = choice(BORDER_HELP, default="refuse")
    remove_mean: bool = choice("shift the mean height to 0, else the height at the first point", default=True)


Road: TypeAlias = Annotated[
    FlatRoadSection
    | Iso8608RoadSection
    | SelfAffineRoadSection
    | BumpRoad
    | CleatRoad
    | StepRoad
    | PotholeRoad
    | OpenCrgRoadSection
    | ProfileRoadSection,
    Field(discriminator="kind"),
]
