"""The roller pressed on a rotating shaft of the rig roller, and the effects of their contact
(Rolling Contact).
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.records.fields import Section, choice, number, numbers

MOST_ROWS = 10000

Instant: TypeAlias = Annotated[float, Field(ge=0.0, le=3600.0)]
Length: TypeAlias = Annotated[float, Field(ge=0.0, le=100.0)]
Newton: TypeAlias = Annotated[float, Field(gt=0.0, le=1e7)]
Bend: TypeAlias = Annotated[float, Field(ge=-1e7, le=1e7)]
Hardness: TypeAlias = Annotated[float, Field(ge=0.1, le=10.0)]
Metre: TypeAlias = Annotated[float, Field(ge=-1e-3, le=1e-3)]


def _radii(of: str) -> list[float] | None:
    found: list[float] | None = numbers(
        "m", f"{of} at the times, in place of its key", f"2 to {MOST_ROWS} numbers, each 0 to 100 m; 0: straight",
        default=None, shortest=2, longest=MOST_ROWS,
    )  # fmt: skip
    return found


class RollerProgramme(Section):
    """Loads and radii over time; before the first time and behind the last they stay."""

    fixed: ClassVar[str] = "the roller runs by its programme, on the track that it has worn"

    time: list[Instant] = numbers(
        "s", "time of each row, increasing", f"2 to {MOST_ROWS} numbers, each 0 to 3600 s", shortest=2, longest=MOST_ROWS,
        example=[0.0, 1.0],
    )  # fmt: skip
    between: Literal["straight", "steps"] = choice("linear from row to row, or steps", default="straight")
    load: list[Newton] | None = numbers(
        "N", "normal load, in place of `load`", f"2 to {MOST_ROWS} numbers, each above 0 to 1e7 N", default=None,
        shortest=2, longest=MOST_ROWS,
    )  # fmt: skip
    bending_load: list[Bend] | None = numbers(
        "N", "load Q of the bent shaft, in place of `effects.roller.shaft_bending.load`",
        f"2 to {MOST_ROWS} numbers, each -1e7 to 1e7 N", default=None, shortest=2, longest=MOST_ROWS,
    )  # fmt: skip
    profile_radius: list[Length] | None = _radii("profile radius of the roller")
    rolling_radius: list[Length] | None = _radii("radius of the roller along rolling, of the contact alone")
    shaft_radius: list[Length] | None = _radii("radius of the shaft along rolling, of the contact alone")
    shaft_profile_radius: list[Length] | None = _radii("profile radius of the shaft")


class RollerRig(Section):
    """Roller in its suspension, on a shaft. x along the shaft, y along rolling, z from the roller
    into the shaft.
    """

    fixed: ClassVar[str] = "the roller runs by its programme, on the track that it has worn"

    load: float = number(0.0, 1e7, "N", "normal load F_N", default=100.0, above=True)
    speed: float = number(0.0, 10000.0, "1/s", "turns of the roller per second", default=50.0)
    radius: float = number(1e-4, 100.0, "m", "radius R of the roller", default=0.02)
    profile_radius: float = number(
        0.0, 100.0, "m", "profile radius of the roller along the shaft; 0: straight", default=0.01
    )
    shaft_radius: float = number(1e-4, 100.0, "m", "radius r of the shaft", default=0.005)
    shaft_profile_radius: float = number(
        0.0, 100.0, "m", "profile radius of the shaft along itself; 0: straight", default=0.0
    )
    young_modulus: float = number(1.0, 1e13, "Pa", "of both bodies", default=2.1e11)
    poisson_ratio: float = number(0.0, 0.5, "", "of both bodies", default=0.3)
    yield_strength: float | None = number(
        1.0, 1e13, "Pa", "of the softer body: a pressure above 1.60 times it is warned of; by default nothing is",
        default=None,
    )  # fmt: skip
    mass: float = number(1e-9, 1e6, "kg", "mass of the roller", default=0.175)
    inertia_tilt: float = number(1e-15, 1e6, "kg m^2", "moment of inertia I_y", default=2e-5)
    inertia_yaw: float = number(1e-15, 1e6, "kg m^2", "moment of inertia I_z", default=2e-5)
    inertia_product: float = number(
        -1e6, 1e6, "kg m^2", "product of inertia I_yz; its square below I_y I_z", default=0.0
    )
    stiffness_tilt: float = number(0.0, 1e12, "N m/rad", "tilt stiffness of the suspension", default=60.0)
    stiffness_yaw: float = number(0.0, 1e12, "N m/rad", "yaw stiffness of the suspension", default=50.0)
    damping_tilt: float = number(0.0, 1e9, "N m s/rad", "tilt damping of the suspension", default=2e-5)
    damping_yaw: float = number(0.0, 1e9, "N m s/rad", "yaw damping of the suspension", default=2e-5)
    tilt: float = number(-0.1, 0.1, "rad", "tilt at the start, from the static tilt", default=0.0)
    yaw: float = number(-1.6, 1.6, "rad", "yaw at the start, from the static yaw", default=0.0)
    acceleration: float = number(
        1.0, 1e9, "", "time acceleration: turns of the rig that one simulated turn stands for in cycles and damage",
        default=1.0,
    )  # fmt: skip
    programme: RollerProgramme | None = choice("loads and radii over time", default=None)


class RollerElastic(Section):
    """Contact of an ellipse that follows load, curvatures and yaw."""

    fixed: ClassVar[str] = "the roller runs by its programme, on the track that it has worn"

    ellipse: Literal["exact", "polynomial"] = choice(
        "shape of the ellipse by elliptic integrals, or by the polynomial of eq 10, valid up to Omega 0.85; "
        "exact beyond it, and in the moments",
        default="exact",
    )
    split: Literal["series", "parallel"] = choice(
        "all of the load goes through the contact, or part of it on a second path that bends the shaft",
        default="series",
    )


class TiltYawSection(Section):
    """The roller tilts and yaws; without it both angles are fixed."""

    fixed: ClassVar[str] = "the roller runs by its programme, on the track that it has worn"


class Gyroscope(Section):
    """Moments of the spinning roller."""

    fixed: ClassVar[str] = "the roller runs by its programme, on the track that it has worn"

    inertia_spin: float = number(0.0, 1e6, "kg m^2", "i about the spin axis", default=3.5e-5)


class RollingFrictionSection(Section):
    """Rolling friction turns a tilted roller."""

    fixed: ClassVar[str] = "the roller runs by its programme, on the track that it has worn"

    coefficient: float = number(-1.0, 1.0, "", "rolling resistance f_r; its sign is that of the rolling", default=0.01)


class ShaftBending(Section):
    """The shaft is bent: compliance of the contact, friction of the stretched surface, stress."""

    fixed: ClassVar[str] = "the roller runs by its programme, on the track that it has worn"

    load: float = number(-1e7, 1e7, "N", "load Q of the shaft", default=225.0)
    contact_distance: float = number(0.0, 100.0, "m", "A, from the clamped end to the contact", default=0.060)
    load_distance: float = number(0.0, 100.0, "m", "l, from the clamped end to Q", default=0.158)
    friction: float = number(0.0, 2.0, "", "f0: traction over bending stress", default=0.1)


class TrackWaves(Section):
    """The roller rides over the heights of the track: heave, load that changes, separation and
    impact.
    """

    fixed: ClassVar[str] = "the roller runs by its programme, on the track that it has worn"

    track: Literal["shaft", "roller", "both"] = choice("body with the heights and the wear", default="shaft")
    damping_ratio: float = number(0.0, 10.0, "", "damping ratio ζ of the heave", default=0.05)
    cells: int = number(16, 65536, "", "cells round the track; with both, round the smaller body", default=256)
    local_curvature: Literal["off", "on"] = choice(
        "contact stiffness with the curvature of the track itself, k21 - W''", default="off"
    )
    roughness: float = number(0.0, 1e-3, "m", "half range of the random heights at the start", default=1e-9)
    cosines: list[Metre] = numbers(
        "m", "heights added at the start, one amplitude for each number of waves from 1; with both, on the shaft",
        "0 to 1000 numbers, each -0.001 to 0.001 m", default=[], shortest=0, longest=1000,
    )  # fmt: skip
    sines: list[Metre] = numbers(
        "m", "as cosines", "0 to 1000 numbers, each -0.001 to 0.001 m", default=[], shortest=0, longest=1000
    )


class Subsurface(Section):
    """Stress below the surface, and the volumes where it passes a limit."""

    fixed: ClassVar[str] = "the roller runs by its programme, on the track that it has worn"

    normal_limit: float = number(1.0, 1e13, "Pa", "limit of normal stresses", default=2.6e8)
    shear_limit: float = number(1.0, 1e13, "Pa", "limit of shear stresses", default=1.5e8)
    roller_normal_limit: float = number(
        1.0, 1e13, "Pa", "normal limit of the roller, where its track wears", default=5.7e8
    )
    roller_shear_limit: float = number(1.0, 1e13, "Pa", "shear limit of the roller", default=3.3e8)
    traction_x: float = number(-2.0, 2.0, "", "traction over pressure, along the shaft", default=0.0)
    traction_y: float | None = number(
        -2.0, 2.0, "", "along rolling; where none is given, the coefficient of rolling_friction", default=None
    )
    cells_x: int = number(2, 512, "", "cells of the box under the contact, along the shaft", default=48)
    cells_y: int = number(2, 512, "", "cells of the box, along rolling", default=60)
    cells_z: int = number(2, 512, "", "cells of the box, in depth", default=12)
    instants: list[Instant] = numbers(
        "s",
        "instants of the volumes",
        "1 to 1000 numbers, each 0 to 3600 s",
        default=[0.0],
        shortest=1,
        longest=1000,
    )


def _hardness(of: str) -> list[float]:
    found: list[float] = numbers(
        "", f"limits of {of} over those of subsurface, at places evenly round its track, straight between; none: 1",
        "0 to 4096 numbers, each 0.1 to 10", default=[], shortest=0, longest=4096,
    )  # fmt: skip
    return found


class Damage(Section):
    """The track wears where its dangerous volume is large; waves may grow."""

    fixed: ClassVar[str] = "the roller runs by its programme, on the track that it has worn"

    gain: float = number(0.0, 1000.0, "", "wear factor γ", default=0.05)
    table_rows: int = number(2, 1000, "", "loads of the table of dangerous volumes", default=16)
    largest_load: float = number(1.0, 100.0, "", "largest of them, over F_N; linear beyond", default=3.0)
    hardness: list[Hardness] = _hardness("the shaft")
    roller_hardness: list[Hardness] = _hardness("the roller")
    checks: int = number(
        0, 1000, "",
        "intervals also simulated turn by turn with a time acceleration above 1: its error", default=10,
    )  # fmt: skip
