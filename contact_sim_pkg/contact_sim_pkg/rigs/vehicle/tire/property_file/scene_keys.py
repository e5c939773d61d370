"""From a tire property file to the keys of a scene: an inflated tire, its rigid ring, bristles and
sidewall compliance.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from contact_sim_pkg.rigs.vehicle.contact_field import FieldError
from contact_sim_pkg.rigs.vehicle.tire.inflated_belt import NOMINAL_PRESSURE, ring_stiffness
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import allowed, angles, fitted, standing_on_belt
from contact_sim_pkg.rigs.vehicle.tire.property_file.magic_formula import StandingTire, standing_tire
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile
from contact_sim_pkg.rigs.vehicle.tire.property_file.slip_keys import slip_keys
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.rigs.vehicle.tire.size import INCH, read_size

__all__ = ["Comparison", "SceneTire", "scene_tire"]

USUAL = Inflation()
DIGITS = 6
USUAL_RANGE = (1.2e5, 3e5, 0.04)  # inflations [Pa] and deflection [m] that the belt is valid for
MORE = 1.1  # inflation, over that of the file, at which the effect of the pressure is compared


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


def scene_tire(tire: PropertyFile) -> SceneTire:
    """Size, inflation, ring stiffness, belt mass and damping from the file; sidewall angle and tread
    modulus fitted (`fit.py`) where it has FNOMIN and VERTICAL_STIFFNESS; bristles and sidewall
    compliance (`slip_keys.py`) where it has PKX1.

    Ring: ``K_b = m_b (2 pi f)^2`` at the nominal pressure, ``c_b = 2 zeta sqrt(K_b m_b)``.

    Raises PropertyFileError without a size, for an inflation or a ring that a scene does not take,
    and where no inflated tire carries the load.
    """
    notes: list[str] = []
    size = _size(tire, notes)
    pressure, nominal = _pressures(tire, notes)
    ring = _ring(tire, nominal, notes)
    radius = _radius(tire, size, notes)
    aim = standing_tire(tire, radius, pressure, nominal)
    inflation = Inflation(size=size, pressure=pressure, ring_stiffness=ring)
    if aim is None:
        notes.append("not fitted: FNOMIN and VERTICAL_STIFFNESS are needed; sidewall_angle and tread_modulus are usual")
        comparisons: tuple[Comparison, ...] = ()
    else:
        inflation, comparisons = _fit(tire, inflation, aim, (radius, nominal), notes)
    given = inflation.model_dump(include={"size", "pressure", "sidewall_angle", "tread_modulus", "ring_stiffness"})
    effects = {"inflation": {key: _rounded(value) for key, value in given.items()}, **_rigid_ring(tire, inflation)}
    contact = None if aim is None or not (aim.length and aim.width) else (aim.length, aim.width)
    slip = slip_keys(tire, contact, notes)
    if slip.brush:
        rounded = [{key: _rounded(value) for key, value in keys.items()} for keys in (slip.brush, slip.compliance)]
        effects |= {"contact_field": {}, "brush": rounded[0], "sidewall_compliance": rounded[1]}
    if slip.cornering is not None:
        comparisons += (Comparison("cornering stiffness (not fitted)", "N/rad", *slip.cornering),)
    return SceneTire(effects, comparisons, tuple(notes))


def _size(tire: PropertyFile, notes: list[str]) -> str:
    """Size text: section width to 1 mm, aspect to 1 %, rim to an inch."""
    width, rim, aspect = tire.get("WIDTH"), tire.get("RIM_RADIUS"), tire.get("ASPECT_RATIO")
    radius = tire.get("UNLOADED_RADIUS")
    if aspect is None and radius is not None and width is not None and rim is not None:
        aspect = (radius - rim) / width
        notes.append(f"ASPECT_RATIO {aspect:.3g} follows from UNLOADED_RADIUS, RIM_RADIUS and WIDTH")
    if width is None or rim is None or aspect is None:
        raise PropertyFileError(f"{tire.file}: WIDTH, ASPECT_RATIO and RIM_RADIUS are needed for the size of the tire")
    inches = 2.0 * rim / INCH
    text = f"{1e3 * width:.0f}/{1e2 * aspect:.0f} R{inches:.0f}"
    try:
        size = read_size(text)
    except ValueError as error:
        raise PropertyFileError(f"{tire.file}: WIDTH, ASPECT_RATIO and RIM_RADIUS make the {error}") from None
    if abs(size.width - width) > 1e-4 or abs(size.aspect - aspect) > 1e-3 or abs(inches - round(inches)) > 0.05:
        notes.append(f"the size is rounded: {1e3 * width:.1f} mm, {1e2 * aspect:.1f} % and {inches:.2f} in to {text}")
    return text


def _radius(tire: PropertyFile, size: str, notes: list[str]) -> float:
    """Free radius [m] of the file; that of the size, which the scene has, where there is none."""
    of_size, radius = read_size(size).radius, tire.get("UNLOADED_RADIUS")
    if radius is None:
        notes.append(f"no UNLOADED_RADIUS; that of the size, {of_size:.4g} m")
        return of_size
    if abs(radius - of_size) > 1e-3:
        notes.append(f"UNLOADED_RADIUS is {radius:.4g} m, the size has {of_size:.4g} m, with which the scene runs")
    return radius


def _pressures(tire: PropertyFile, notes: list[str]) -> tuple[float, float]:
    """Inflation of the scene, and that at which the coefficients hold [Pa]."""
    pressure, nominal = tire.get("INFLPRES"), tire.get("NOMPRES")
    if pressure is None and nominal is None:
        notes.append(f"no INFLPRES; inflation {USUAL.pressure:g} Pa is assumed, in the stiffnesses too")
    pressure = pressure or nominal or USUAL.pressure
    low, high = allowed("pressure")
    if not low <= pressure <= high:
        raise PropertyFileError(
            f"{tire.file}: inflation {pressure:g} Pa; the inflated tire of a scene takes {low:g} to {high:g} Pa"
        )
    return pressure, nominal or pressure


def _ring(tire: PropertyFile, nominal: float, notes: list[str]) -> float:
    """Stiffness [N/m] of the rigid ring at 220 kPa."""
    mass, frequency = tire.get("BELT_MASS"), tire.get("FREQ_LONG")
    if mass is None or frequency is None:
        notes.append(f"no BELT_MASS and FREQ_LONG; ring_stiffness {USUAL.ring_stiffness:g} N/m is the usual one")
        return USUAL.ring_stiffness
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
    tire: PropertyFile, inflation: Inflation, aim: StandingTire, reference: tuple[float, float], notes: list[str]
) -> tuple[Inflation, tuple[Comparison, ...]]:
    """The fitted tire, and what it has beside the file. reference: R_0 [m] and p_0 [Pa]."""
    try:
        inflation = fitted(inflation, aim)
        found = standing_on_belt(inflation, aim.load)
    except FieldError:
        raise PropertyFileError(
            f"{tire.file}: no inflated tire {inflation.size} at {inflation.pressure:g} Pa carries FNOMIN {aim.load:g} N"
        ) from None
    rows = [Comparison("stiffness", "N/m", aim.stiffness, found.stiffness)]
    for name, wanted, have in (("length", aim.length, found.length), ("width", aim.width, found.width)):
        if wanted is not None and have is not None:
            rows.append(Comparison(f"{name} of the contact", "m", wanted, have))
    rows.append(Comparison("deflection (not fitted)", "m", aim.deflection, found.deflection))
    effect = _pressure_effect(tire, inflation, aim, found, reference)
    if effect is not None:
        rows.append(effect)
    if min(abs(inflation.sidewall_angle - end) for end in angles(inflation)) < 1e-3:
        notes.append("sidewall_angle is at the end of its range: no tire of this kind is nearer to the file")
    if aim.length is None or aim.width is None:
        notes.append("no Q_RA or Q_RB: angle and modulus follow from the stiffness alone, with the least change")
    low, high, deepest = USUAL_RANGE
    if not (low <= inflation.pressure <= high and found.deflection <= deepest):
        notes.append(
            f"inflation {inflation.pressure:g} Pa and deflection {found.deflection:.3g} m: the tire is valid for "
            f"{low:g} to {high:g} Pa and up to {deepest:g} m"
        )
    return inflation, tuple(rows)


def _pressure_effect(
    tire: PropertyFile, inflation: Inflation, aim: StandingTire, found: StandingTire, reference: tuple[float, float]
) -> Comparison | None:
    """d ln K / d ln p at the load, where the file has PFZ1 and the tire carries the load there too."""
    if not tire.get("PFZ1"):
        return None
    stiffer = standing_tire(tire, reference[0], MORE * inflation.pressure, reference[1])
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
