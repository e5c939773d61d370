"""Effects of each contact. An effect acts when the scene names it; `{}` takes all defaults."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from contact_sim_pkg.rigs.body.schema import BlockEffects
from contact_sim_pkg.rigs.impact.schema_effects import ImpactEffects
from contact_sim_pkg.rigs.roller.schema import RollerEffects
from contact_sim_pkg.scene.schema.fields import Section, choice, number, numbers

Branch: TypeAlias = Annotated[list[float], Field(min_length=2, max_length=2)]

MOST_CELLS_A_SIDE = 65536
ROWS_HELP = "cells along the field (forward); taken from accuracy when absent"
COLS_HELP = "cells across the field (left); taken from accuracy when absent"


def _cells(meaning: str) -> int | None:
    cells: int | None = number(4, MOST_CELLS_A_SIDE, "", meaning, default=None)
    return cells


def _tolerance() -> float | None:
    tolerance: float | None = number(
        1e-12,
        0.1,
        "",
        "relative error of the pressure; taken from accuracy when absent",
        default=None,
    )
    return tolerance


def _corrector_passes() -> int | None:
    passes: int | None = number(
        0,
        8,
        "",
        "most repetitions of a coupling step with the field at its end; taken from accuracy when absent",
        default=None,
    )
    return passes


def _restitution() -> float | None:
    ratio: float | None = number(
        0.01, 1.0, "", "ratio of the speeds after and before a free impact, instead of damping", default=None
    )
    return ratio


def _reference_speed() -> float | None:
    speed: float | None = number(0.001, 100.0, "m/s", "impact speed at which the restitution holds", default=None)
    return speed


class HertzElastic(Section):
    """Elastic force of the tire: elliptic Hertz contact, from the radii and the modulus of `tire`."""


class PowerElastic(Section):
    """Elastic force of the cushion: coefficient · approach^exponent. `contact_field` takes its place where both act."""

    coefficient: float = number(
        1.0,
        1e12,
        "N/m^exponent",
        "A; by default 50 kN/m under 50.8 kg: 498 N at 14.95 mm",
        default=2.73e5,
    )
    exponent: float = number(1.0, 3.0, "", "n; 1 is linear, 1.5 is Hertz", default=1.5)


class TireLoss(Section):
    """Hunt-Crossley loss: elastic force · (1 + damping · approach rate), never pulling; or `restitution` at a speed."""

    damping: float | None = number(
        0.0, 100.0, "s/m", "λ; 0.06 by default: 200 N s/m at 3335 N, ζ about 3 %", default=None
    )
    restitution: float | None = _restitution()
    reference_speed: float | None = _reference_speed()


class SeatLoss(Section):
    """Hunt-Crossley loss: elastic force · (1 + damping · approach rate), never pulling; or `restitution` at a speed."""

    damping: float | None = number(0.0, 100.0, "s/m", "λ; 1.0 by default: 500 N s/m at 498 N", default=None)
    restitution: float | None = _restitution()
    reference_speed: float | None = _reference_speed()


class Foam(Section):
    """Foam block under an even load, with plateau and densification; its force takes the place of that of normal_elastic."""

    area: float = number(1e-3, 10.0, "m^2", "loaded area; under an occupant 0.10 to 0.15", default=0.12)
    thickness: float = number(0.005, 2.0, "m", "thickness of the unloaded block", default=0.08)
    modulus: float = number(
        100.0, 1e9, "Pa", "Young's modulus at first contact, above plateau; 20 to 100 kPa", default=4.0e4
    )
    plateau: float = number(
        10.0, 1e8, "Pa", "stress of the plateau; with the other defaults 5.9 kPa at 40 % strain", default=3.0e3
    )
    densification: float = number(0.0, 1e8, "Pa", "stress scale of the densification (choice)", default=150.0)
    densification_exponent: float = number(
        0.1, 20.0, "", "r: stress grows as l^(-r-1), l = 1 - strain; 3 bends up near 65 % strain (choice)", default=3.0
    )


class FoamHysteresis(Section):
    """Loss without rate: the force is the elastic one times 1 + share · z, z between -1 and 1 follows the loading."""

    share: float = number(0.0, 0.9, "", "s; a long loading dissipates 2 s/(1 + s): 21 % by default", default=0.12)
    energy: float = number(1e-6, 1e6, "J", "u₀, stored energy of a reversal (choice)", above=True, default=1.0)


class GeneralLoss(Section):
    """General law: elastic force + coefficient · approach^approach_exponent · sgn(rate) |rate|^rate_exponent; in place of
    normal_dissipative. Exponents 0 and 1 are a plain damper, the elastic exponent and 1 Hunt-Crossley, 0.5 and 1 Kuwabara-Kono."""

    coefficient: float | None = number(
        0.0, 1e12, "N/m^p/(m/s)^q", "B; 2.73e5 by default: with the default exponents 500 N s/m at 498 N",
        default=None,
    )  # fmt: skip
    approach_exponent: float = number(0.0, 4.0, "", "p, power of the approach", default=1.5)
    rate_exponent: float = number(
        0.0, 3.0, "", "q, power of the approach rate; below 1 smoothed over 1e-6 of reference_speed", default=1.0
    )
    restitution: float | None = number(
        0.01, 1.0, "", "ratio of the speeds after and before a free impact of the whole occupant, instead of coefficient",
        default=None,
    )  # fmt: skip
    reference_speed: float | None = number(
        0.001, 100.0, "m/s", "impact speed at which the restitution holds; 0.5 where only rate_exponent below 1 needs it",
        default=None,
    )  # fmt: skip
    end: Literal["force", "gap"] = choice(
        "contact ends at zero force (never tensile), or at zero gap (tensile before)",
        default="force",
    )


class Friction(Section):
    """Friction between occupant and cushion: a spring and damper that sticks, up to the Coulomb limit."""

    coefficient_static: float = number(0.0, 5.0, "", "static friction; cloth 0.3 to 0.6", above=True, default=0.4)
    coefficient_kinetic: float = number(
        0.0, 5.0, "", "kinetic friction, at most coefficient_static", above=True, default=0.35
    )
    stiffness: float = number(1.0, 1e9, "N/m", "shear spring of the cushion while it sticks (choice)", default=2.0e4)
    damping: float = number(0.0, 1e6, "N s/m", "shear damper of the cushion while it sticks (choice)", default=200.0)


class TireField(Section):
    """Pressure field of the tire on a half-space; it is the contact, its integral drives the wheel."""

    length: float = number(0.01, 2.0, "m", "extent along the road (forward)", default=0.28)
    width: float = number(0.01, 2.0, "m", "extent across the track (left); 0.22 m are loaded at 4 kN", default=0.44)
    rows: int | None = _cells(ROWS_HELP)
    cols: int | None = _cells(COLS_HELP)
    tolerance: float | None = _tolerance()
    corrector_passes: int | None = _corrector_passes()


class SeatField(Section):
    """Pressure field of the cushion on a half-space; it is the contact, its integral carries the occupant."""

    length: float = number(0.05, 5.0, "m", "extent forward", default=0.6)
    width: float = number(0.05, 5.0, "m", "extent to the left", default=0.5)
    rows: int | None = _cells(ROWS_HELP)
    cols: int | None = _cells(COLS_HELP)
    tolerance: float | None = _tolerance()
    corrector_passes: int | None = _corrector_passes()


class PressureMat(Section):
    """Pressure under the occupant of the point contact's force: spread over the cells as a bed of springs under the body would."""

    length: float = number(0.05, 5.0, "m", "extent forward", default=0.6)
    width: float = number(0.05, 5.0, "m", "extent to the left", default=0.5)
    rows: int = number(4, 256, "", "cells forward", default=36)
    cols: int = number(4, 256, "", "cells to the left", default=30)


class Carcass(Section):
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


class TreadViscoelasticity(Section):
    """Memory of the tread rubber: a Kelvin-Voigt element and Maxwell branches beside the modulus of `tire`, cell by cell."""

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


class Envelopment(Section):
    """A belt under tension on an elastic foundation yields under the pressure beside the tread, and bends over obstacles."""

    tension: float = number(
        1.0, 1e6, "N", "tension of the belt over its width; 220 kPa on 0.3 m by 0.15 m give 9900 N", default=9900.0
    )
    foundation: float = number(
        1e3, 1e9, "N/m^2", "radial stiffness of the sidewalls per length of circumference (choice)", default=6.3e5
    )


class Brush(Section):
    """Bristles that stick to the road and slip, cell by cell: longitudinal and lateral force, aligning moment."""

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


class AsperityImpulses(Section):
    """Push of the road's asperities on the rolling tire, site by site; they act while the tire is in contact."""

    spacing: float = number(1e-4, 10.0, "m", "distance of two asperities along the road", default=0.02)
    share: float = number(
        0.0, 10.0, "", "share of the standing load on the asperities under the tire (choice)", default=0.1
    )
    window: Literal["rectangular", "raised_cosine"] = choice(
        "time function of an asperity under the tire; raised_cosine is smooth", default="rectangular"
    )


class TireEffects(Section):
    """Effects of the contact between tire and road."""

    normal_elastic: HertzElastic | None = choice("elastic force", default=None)
    normal_dissipative: TireLoss | None = choice("loss", default=None)
    contact_field: TireField | None = choice("pressure field", default=None)
    carcass: Carcass | None = choice("rigid ring on sidewalls", default=None)
    envelopment: Envelopment | None = choice("belt that bends over obstacles", default=None)
    tread_viscoelasticity: TreadViscoelasticity | None = choice("viscoelasticity of the tread rubber", default=None)
    brush: Brush | None = choice("brush friction of a rolling tire, stick and slip of each cell", default=None)
    asperity_impulses: AsperityImpulses | None = choice("impulses of road asperities", default=None)


class SeatEffects(Section):
    """Effects of the contact between occupant and cushion."""

    normal_elastic: PowerElastic | None = choice("elastic force", default=None)
    normal_dissipative: SeatLoss | None = choice("loss", default=None)
    foam: Foam | None = choice("foam with plateau and densification", default=None)
    foam_hysteresis: FoamHysteresis | None = choice("rate-independent loss of foam", default=None)
    general_dissipative: GeneralLoss | None = choice("loss by the general law", default=None)
    friction: Friction | None = choice("friction with stick and slip", default=None)
    contact_field: SeatField | None = choice("pressure field", default=None)
    pressure_mat: PressureMat | None = choice("pressure map of a point contact", default=None)


class BackElastic(Section):
    """Elastic force of the back in the seat back: coefficient · approach^exponent, for the whole back."""

    coefficient: float = number(
        1.0, 1e12, "N/m^exponent", "A; by default 447 N at 14.91 mm: 45.6 kg have 5 Hz", default=2.457e5
    )
    exponent: float = number(1.0, 3.0, "", "n; 1 is linear, 1.5 is Hertz", default=1.5)


class BackLoss(Section):
    """Hunt-Crossley loss: elastic force · (1 + damping · approach rate), never pulling; or `restitution` at a speed."""

    damping: float | None = number(0.0, 100.0, "s/m", "λ; 1.9497 by default: restitution 0.6 at 0.5 m/s", default=None)
    restitution: float | None = _restitution()
    reference_speed: float | None = _reference_speed()


class BackGeneralLoss(GeneralLoss):
    """General law of the back in the seat back: as that of the cushion, with a coefficient of its own."""

    coefficient: float | None = number(
        0.0, 1e12, "N/m^p/(m/s)^q", "B; 4.7905e5 by default: with the default exponents restitution 0.6 at 0.5 m/s",
        default=None,
    )  # fmt: skip


class BackFriction(Section):
    """Friction between back and seat back: a spring and damper that sticks, up to the Coulomb limit; for the whole back."""

    coefficient_static: float = number(0.0, 5.0, "", "static friction; cloth 0.3 to 0.6", above=True, default=0.4)
    coefficient_kinetic: float = number(
        0.0, 5.0, "", "kinetic friction, at most coefficient_static", above=True, default=0.4
    )
    stiffness: float = number(
        1.0, 1e9, "N/m", "shear spring while it sticks; Mindlin's ratio at ν 0.45", default=3.19e4
    )
    damping: float = number(
        0.0,
        1e6,
        "N s/m",
        "shear damper while it sticks; the ratio to the spring that the normal loss has",
        default=619.0,
    )


class ShellModes(Section):
    """The back as a doubly curved shallow shell in modal form with candidate contact points, in place of one mass."""

    modes: int = number(1, 25, "", "modes: 1, 4, 9 or 25 (m and n up to 1, 2, 3 or 5)", default=9)
    points_up: int = number(1, 64, "", "candidate contact points up the back", default=20)
    points_across: int = number(1, 64, "", "candidate contact points across the back", default=16)
    thickness: float = number(1e-4, 1.0, "m", "thickness of the shell, at most 0.1 of its shorter side", default=0.03)
    density: float = number(1.0, 1e5, "kg/m^3", "density of the shell", default=1050.0)
    young_modulus: float = number(
        1.0,
        1e12,
        "Pa",
        "Young's modulus of the shell; by default first mode 5.49 Hz, in the band of the spine",
        default=6.0e5,
    )
    poisson_ratio: float = number(0.0, 0.5, "", "Poisson's ratio of the shell", default=0.45)
    damping_ratio: float = number(0.0, 2.0, "", "damping ratio of every mode", default=0.1)
    shaken_across: float = number(
        0.0, 1.0, "", "place of the exciting force over the width, from the right edge", default=0.4
    )
    shaken_up: float = number(
        0.0, 1.0, "", "place of the exciting force over the height, from the lower edge", default=0.35
    )


class ContactSearch(Section):
    """One contact point that moves: where the bent shell comes nearest to the seat back, searched at every step; it carries the
    whole law, in place of candidate points with a share each."""


class BackrestEffects(Section):
    """Effects of the contact between back and seat back."""

    normal_elastic: BackElastic | None = choice("elastic force", default=None)
    normal_dissipative: BackLoss | None = choice("loss", default=None)
    foam: Foam | None = choice("foam with plateau and densification", default=None)
    foam_hysteresis: FoamHysteresis | None = choice("rate-independent loss of foam", default=None)
    general_dissipative: BackGeneralLoss | None = choice("loss by the general law", default=None)
    friction: BackFriction | None = choice("friction with stick and slip", default=None)
    shell_modes: ShellModes | None = choice("back as a shell with many contact points", default=None)
    contact_search: ContactSearch | None = choice("moving contact point of the shell", default=None)


class Effects(Section):
    """Contact → effects."""

    tire: TireEffects | None = choice("contact between tire and road", default=None)
    seat: SeatEffects | None = choice("contact between occupant and cushion", default=None)
    backrest: BackrestEffects | None = choice("contact between back and seat back", default=None)
    impact: ImpactEffects | None = choice("contact between sphere and sample", default=None)
    block: BlockEffects | None = choice("contact between a rigid body and the ground", default=None)
    roller: RollerEffects | None = choice("contact between roller and shaft", default=None)


ContactField: TypeAlias = TireField | SeatField
