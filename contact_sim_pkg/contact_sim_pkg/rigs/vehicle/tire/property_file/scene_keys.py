"""From a tire property file to the keys of a scene: an inflated tire, its rigid ring, bristles and
sidewall compliance.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldError
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import NOMINAL_PRESSURE, ring_stiffness
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import allowed, angles, fitted, standing_on_belt
from contact_sim_pkg.rigs.vehicle.tire.property_file.inflation import stated_inflation
from contact_sim_pkg.rigs.vehicle.tire.property_file.magic_formula import (
    StandingTire,
    contradiction,
    law_tire,
    standing_tire,
)
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile
from contact_sim_pkg.rigs.vehicle.tire.property_file.slip_keys import slip_keys
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.rigs.vehicle.tire.size import INCH, TireSize, read_size

__all__ = ["Comparison", "SceneTire", "scene_tire"]

USUAL = Inflation()
DIGITS = 6
USUAL_RANGE = (1.2e5, 3e5, 0.04)  # inflations [Pa] and deflection [m] that the belt is valid for
USABLE = 0.1  # relative difference of radius, stiffness and deflection up to which a scene stands for the file
SQUASHED = 0.15  # of the section height: deflection of the fit where the file has no nominal load
MORE = 1.1  # inflation, over that of the file, at which the effect of the pressure is compared


WRITTEN = ("size", "radius", "pressure", "sidewall_angle", "tread_modulus", "ring_stiffness")


class Comparison(NamedTuple):
    """A quantity of the file beside that of the fitted tire."""

    quantity: str
    unit: str
    file: float
    tire: float

    @property
    def difference(self) -> float:
        """Relative [1]."""
        return self.tire / self.file - 1.0


class SceneTire(NamedTuple):
    """What a scene takes from a file."""

    effects: dict[str, dict[str, Any]]  # of the tire: effect -> keys
    fit: tuple[Comparison, ...]
    notes: tuple[str, ...]

    @property
    def judged(self) -> tuple[Comparison, ...]:
        """Radius, stiffness and deflection; empty where the file states no stiffness."""
        return self.fit[:3]

    @property
    def usable(self) -> bool:
        """Whether these meet the file within 10 %."""
        return bool(self.judged) and all(abs(each.difference) <= USABLE for each in self.judged)


def scene_tire(tire: PropertyFile) -> SceneTire:
    """Size, radius, inflation, ring stiffness, belt mass and damping from the file; the rest of the
    inflated tire fitted (`fit.py`) where it has a stiffness or a table of loads; bristles and
    sidewall compliance (`slip_keys.py`) where it has PKX1.

    Ring: ``K_b = m_b (2 pi f)^2`` at the nominal pressure, ``c_b = 2 zeta sqrt(K_b m_b)``.

    Raises PropertyFileError without a size, for an inflation or a ring that a scene does not take,
    and where no inflated tire carries the load.
    """
    notes: list[str] = []
    size, radius = _size(tire, notes)
    pressure, nominal = stated_inflation(tire, notes)
    ring = _ring(tire, nominal)
    inflation = Inflation(size=size, radius=radius, pressure=pressure, ring_stiffness=ring or USUAL.ring_stiffness)
    form = read_size(size, radius)
    load = _load(tire, form, notes)
    aim = standing_tire(tire, form.radius, pressure, nominal, load)
    if ring is None:
        how = "is fitted too" if aim else f"{USUAL.ring_stiffness:g} N/m is the usual one"
        notes.append(f"no BELT_MASS and FREQ_LONG; ring_stiffness {how}")
    if aim is None:
        notes.append("not fitted: the file has no VERTICAL_STIFFNESS, Q_FZ1 or [DEFLECTION_LOAD_CURVE] up to the load")
        comparisons: tuple[Comparison, ...] = ()
    else:
        by_law = law_tire(tire, form.radius, pressure, nominal, load)
        said = None if tire.curve is None or by_law is None else contradiction(tire, by_law, aim)
        if said is not None:
            notes.append(said)
        inflation, comparisons = _fit(tire, inflation, aim, (nominal, ring is None), notes)
    written = WRITTEN if aim is None else (*WRITTEN, "structure", "bending", "crown_radius")
    given = inflation.model_dump(include=set(written), exclude_none=True)
    effects = {"inflation": {key: _rounded(value) for key, value in given.items()}, **_rigid_ring(tire, inflation)}
    extents = [each.tire for each in comparisons if "of the contact" in each.quantity]
    contact = (extents[0], extents[1]) if len(extents) == 2 else None
    slip = slip_keys(tire, contact, notes)
    if slip.brush:
        rounded = [{key: _rounded(value) for key, value in keys.items()} for keys in (slip.brush, slip.compliance)]
        effects |= {"contact_field": {}, "brush": rounded[0], "sidewall_compliance": rounded[1]}
    if slip.cornering is not None:
        comparisons += (Comparison("cornering stiffness (not fitted)", "N/rad", *slip.cornering),)
    return SceneTire(effects, comparisons, tuple(notes))


def _size(tire: PropertyFile, notes: list[str]) -> tuple[str, float | None]:
    """Size text: section width to 1 mm, aspect to 1 %, rim to half an inch; and the free radius [m]
    where it is not that of the size.
    """
    width, rim, aspect = tire.get("WIDTH"), tire.get("RIM_RADIUS"), tire.get("ASPECT_RATIO")
    radius = tire.get("UNLOADED_RADIUS")
    if radius is not None and rim is not None and not radius > rim:
        raise PropertyFileError(
            f"{tire.file}, line {tire.values['UNLOADED_RADIUS'].line}: UNLOADED_RADIUS {radius:g} m is not above RIM_RADIUS "
            f"{rim:g} m in line {tire.values['RIM_RADIUS'].line}; one of the two is wrong"
        )
    if aspect is None and radius is not None and width is not None and rim is not None:
        aspect = (radius - rim) / width
        notes.append(f"ASPECT_RATIO {aspect:.3g} follows from UNLOADED_RADIUS, RIM_RADIUS and WIDTH")
    if rim is None and radius is not None and width is not None and aspect is not None:
        rim = radius - aspect * width
        notes.append(f"RIM_RADIUS {rim:.4g} m follows from UNLOADED_RADIUS, ASPECT_RATIO and WIDTH")
    if width is None or rim is None or aspect is None:
        raise PropertyFileError(
            f"{tire.file}: WIDTH and two of UNLOADED_RADIUS, ASPECT_RATIO and RIM_RADIUS are needed for the size of the tire; "
            f"{', '.join(name for name in SIZES if tire.get(name) is None)} are missing"
        )
    inches = 2.0 * rim / INCH
    text = f"{1e3 * width:.0f}/{1e2 * aspect:.0f} R{round(2.0 * inches) / 2.0:g}"
    try:
        size = read_size(text)
    except ValueError as error:
        raise PropertyFileError(
            f"{tire.file}{_lines(tire, 'WIDTH', 'ASPECT_RATIO', 'RIM_RADIUS')}: WIDTH, ASPECT_RATIO and RIM_RADIUS make the "
            f"{error}"
        ) from None
    if abs(size.width - width) > 1e-4 or abs(size.aspect - aspect) > 1e-3 or abs(size.rim - 2.0 * rim) > 0.05 * INCH:
        notes.append(f"the size is rounded: {1e3 * width:.1f} mm, {1e2 * aspect:.1f} % and {inches:.2f} in to {text}")
    if radius is None:
        notes.append(f"no UNLOADED_RADIUS; that of the size, {size.radius:.4g} m")
        return text, None
    if abs(radius - size.radius) <= SAME_RADIUS:
        return text, None
    low, high = allowed("radius")
    where = f"{tire.file}, line {tire.values['UNLOADED_RADIUS'].line}"
    if not low <= radius <= high:
        raise PropertyFileError(f"{where}: UNLOADED_RADIUS {radius:g} m; a scene takes {low:g} to {high:g} m")
    try:
        read_size(text, radius)
    except ValueError as error:
        raise PropertyFileError(f"{where}: UNLOADED_RADIUS: {error}") from None
    notes.append(f"UNLOADED_RADIUS {radius:.4g} m counts; the size alone would make {size.radius:.4g} m")
    return text, radius


SIZES = ("WIDTH", "UNLOADED_RADIUS", "ASPECT_RATIO", "RIM_RADIUS")
SAME_RADIUS = 1e-4  # [m]


def _lines(tire: PropertyFile, *keys: str) -> str:
    """The lines of those keys that the file has."""
    found = [str(tire.values[key].line) for key in keys if key in tire.values]
    return f", lines {' and '.join(found)}" if found else ""


def _load(tire: PropertyFile, size: TireSize, notes: list[str]) -> float | None:
    """Load [N] of the fit: FNOMIN, else that which squashes the tire by 15 % of its section height."""
    load, stiffness, deflection = tire.get("FNOMIN"), tire.get("VERTICAL_STIFFNESS"), SQUASHED * size.section_height
    if load is not None:
        return load
    load = None if tire.curve is None else tire.curve.load_at(deflection)
    if load is None and stiffness is not None:
        load = stiffness * deflection
    if load is not None:
        notes.append(
            f"no FNOMIN; the fit is under {load:.4g} N, a deflection of {100 * SQUASHED:g} % of the section height"
        )
    return load


def _ring(tire: PropertyFile, nominal: float) -> float | None:
    """Stiffness [N/m] of the rigid ring at 220 kPa; None where the file does not say."""
    mass, frequency = tire.get("BELT_MASS"), tire.get("FREQ_LONG")
    if mass is None or frequency is None:
        return None
    found = mass * (2.0 * math.pi * frequency) ** 2 / ring_stiffness(1.0, nominal)
    low, high = allowed("ring_stiffness")
    if not low <= found <= high:
        raise PropertyFileError(
            f"{tire.file}: BELT_MASS {mass:g} kg and FREQ_LONG {frequency:g} Hz make a ring stiffness of {found:.4g} "
            f"N/m at {NOMINAL_PRESSURE:g} Pa; {low:g} to {high:g} N/m is allowed"
        )
    return found


def _rigid_ring(tire: PropertyFile, inflation: Inflation) -> dict[str, dict[str, Any]]:
    """The effect `rigid_ring`, where the file has a belt mass; its stiffness is that of the inflation."""
    mass, ratio = tire.get("BELT_MASS"), tire.get("DAMP_LONG")
    if mass is None:
        return {}
    stiffness = ring_stiffness(inflation.ring_stiffness, inflation.pressure)
    damping = {} if ratio is None else {"damping": _rounded(2.0 * ratio * math.sqrt(stiffness * mass))}
    return {"rigid_ring": {"belt_mass": _rounded(mass), **damping}}


def _fit(
    tire: PropertyFile, inflation: Inflation, aim: StandingTire, reference: tuple[float, bool], notes: list[str]
) -> tuple[Inflation, tuple[Comparison, ...]]:
    """The fitted tire, and what it has beside the file: radius, stiffness, deflection first.
    reference: p_0 [Pa], and whether the rigid ring is fitted.
    """
    (nominal, ring), stated = reference, inflation.ring_stiffness
    try:
        inflation = fitted(inflation, aim, ring)
        found = standing_on_belt(inflation, aim.load)
    except FieldError:
        raise PropertyFileError(
            f"{tire.file}{_lines(tire, 'FNOMIN')}: no inflated tire {inflation.size} at {inflation.pressure:g} Pa carries "
            f"FNOMIN {aim.load:g} N"
        ) from None
    radius = read_size(inflation.size, inflation.radius).radius
    rows = [
        Comparison("radius", "m", tire.get("UNLOADED_RADIUS") or radius, radius),
        Comparison("stiffness", "N/m", aim.stiffness, found.stiffness),
        Comparison("deflection", "m", aim.deflection, found.deflection),
    ]
    for name, wanted, have in (("length", aim.length, found.length), ("width", aim.width, found.width)):
        if wanted is not None and have is not None:
            rows.append(Comparison(f"{name} of the contact", "m", wanted, have))
    if not ring:
        rows.append(Comparison("ring stiffness", "N/m", stated, inflation.ring_stiffness))
    effect = _pressure_effect(tire, inflation, aim, found, nominal)
    if effect is not None:
        rows.append(effect)
    if min(abs(inflation.sidewall_angle - end) for end in angles(inflation)) < 1e-3:
        notes.append("sidewall_angle is at the end of its range: no tire of this kind is nearer to the file")
    if aim.length is None or aim.width is None:
        notes.append(
            "no Q_RA or Q_RB: the fit aims weakly at a usual contact and has "
            f"{1e3 * (found.length or 0.0):.0f} x {1e3 * (found.width or 0.0):.0f} mm"
        )
    low, high, deepest = USUAL_RANGE
    if not (low <= inflation.pressure <= high and found.deflection <= deepest):
        notes.append(
            f"inflation {inflation.pressure:g} Pa and deflection {found.deflection:.3g} m: the tire is valid for "
            f"{low:g} to {high:g} Pa and up to {deepest:g} m"
        )
    return inflation, tuple(rows)


def _pressure_effect(
    tire: PropertyFile, inflation: Inflation, aim: StandingTire, found: StandingTire, nominal: float
) -> Comparison | None:
    """d ln K / d ln p at the load, where the file has PFZ1 and no table, and the tire carries the load
    there too.
    """
    if not tire.get("PFZ1") or tire.curve is not None:
        return None
    radius = read_size(inflation.size, inflation.radius).radius
    stiffer = standing_tire(tire, radius, MORE * inflation.pressure, nominal, aim.load)
    assert stiffer is not None
    try:
        have = standing_on_belt(inflation.model_copy(update={"pressure": MORE * inflation.pressure}), aim.load)
    except FieldError:
        return None
    exponents = [math.log(b.stiffness / a.stiffness) / math.log(MORE) for a, b in ((aim, stiffer), (found, have))]
    return Comparison("stiffness over inflation, exponent (not fitted)", "", *exponents)


def _rounded(value: Any) -> Any:
    """A number with as many digits as a fit deserves."""
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value
