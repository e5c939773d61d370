"""Effects of each contact. An effect acts when the scene names it; `{}` takes all defaults."""

from __future__ import annotations

from typing import TypeAlias

from contact_sim_pkg.scene.schema_fields import Section, choice, number

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
        "relative error of the pressure at which the solver stops; taken from accuracy when absent",
        default=None,
    )
    return tolerance


def _corrector_passes() -> int | None:
    passes: int | None = number(
        0,
        8,
        "",
        "repetitions of an interval with the field found at its end; taken from accuracy when absent",
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
        "chosen so that 50.8 kg sit at 50 kN/m: 498 N at 14.95 mm",
        default=2.73e5,
    )
    exponent: float = number(1.0, 3.0, "", "1 is linear, 1.5 is Hertz", default=1.5)


class TireLoss(Section):
    """Hunt-Crossley loss: elastic force · (1 + damping · approach rate), never pulling; or `restitution` at a speed."""

    damping: float | None = number(
        0.0, 100.0, "s/m", "0.06 where none is given: 200 N s/m at 3335 N, ζ about 3 %", default=None
    )
    restitution: float | None = _restitution()
    reference_speed: float | None = _reference_speed()


class SeatLoss(Section):
    """Hunt-Crossley loss: elastic force · (1 + damping · approach rate), never pulling; or `restitution` at a speed."""

    damping: float | None = number(0.0, 100.0, "s/m", "1.0 where none is given: 500 N s/m at 498 N", default=None)
    restitution: float | None = _restitution()
    reference_speed: float | None = _reference_speed()


class Friction(Section):
    """Friction between occupant and cushion: a spring and damper that sticks, up to the Coulomb limit."""

    coefficient_static: float = number(
        0.0, 5.0, "", "ratio at which sticking ends; cloth 0.3 to 0.6", above=True, default=0.4
    )
    coefficient_kinetic: float = number(
        0.0, 5.0, "", "ratio while slipping, at most coefficient_static", above=True, default=0.35
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


class TireEffects(Section):
    """Effects of the contact between tire and road."""

    normal_elastic: HertzElastic | None = choice("elastic force", default=None)
    normal_dissipative: TireLoss | None = choice("loss", default=None)
    contact_field: TireField | None = choice("pressure field", default=None)


class SeatEffects(Section):
    """Effects of the contact between occupant and cushion."""

    normal_elastic: PowerElastic | None = choice("elastic force", default=None)
    normal_dissipative: SeatLoss | None = choice("loss", default=None)
    friction: Friction | None = choice("friction with true stick", default=None)
    contact_field: SeatField | None = choice("pressure field", default=None)


class Effects(Section):
    """Contact → effects."""

    tire: TireEffects | None = choice("contact between tire and road", default=None)
    seat: SeatEffects | None = choice("contact between occupant and cushion", default=None)


ContactField: TypeAlias = TireField | SeatField
