"""From a tire property file to the keys of a scene: an inflated tire, its rigid ring, bristles and
sidewall compliance.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldError
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import NOMINAL_PRESSURE, ring_stiffness
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import (
    ROLLING,
    STANDING,
    UNKNOWNS,
    Target,
    allowed,
    angles,
    fitted,
    found_where,
    squashed,
)
from contact_sim_pkg.rigs.vehicle.tire.property_file.inflation import BeyondInflationError, stated_inflation
from contact_sim_pkg.rigs.vehicle.tire.property_file.magic_formula import contradiction, law_tire, standing_tire
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile
from contact_sim_pkg.rigs.vehicle.tire.property_file.slip_keys import slip_keys
from contact_sim_pkg.rigs.vehicle.tire.property_file.targets import (
    Measured,
    few,
    rolling_targets,
    standing_targets,
    usual_contact,
)
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.rigs.vehicle.tire.size import INCH, TireSize, read_size

__all__ = ["Comparison", "SceneTire", "measured_tire", "scene_tire"]

USUAL = Inflation()
DIGITS = 6
USUAL_RANGE = (1.2e5, 3e5, 0.04)  # inflations [Pa] and deflection [m] that the belt is valid for
USABLE = 0.06  # relative difference of radius, stiffness and deflection up to which a scene stands for the file
SQUASHED = 0.15  # of the section height: deflection of the fit where the file has no nominal load
WRITTEN = ("size", "radius", "pressure", "ring_stiffness")
JUDGED = ("radius", "stiffness", "deflection")
NAMES = {
    "stiffness": ("stiffness", "N/m"), "deflection": ("deflection", "m"), "length": ("length of the contact", "m"),
    "width": ("width of the contact", "m"), "braking": ("braking stiffness", "N"), "cornering": ("cornering stiffness", "N/rad"),
    "trail": ("trail", "m"),
}  # fmt: skip
"""Quantity of a comparison and its unit."""


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
        """Radius, stiffness and deflection at the nominal load; empty where the file states none of the tire."""
        return tuple(each for each in self.fit if each.quantity in JUDGED)

    @property
    def usable(self) -> bool:
        """Whether these meet the file within 6 %."""
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
    try:
        pressure, nominal = stated_inflation(tire, notes)
    except BeyondInflationError as error:
        raise PropertyFileError(f"{error}{_figures_beyond(tire, error, size, radius)}") from None
    ring = _ring(tire, nominal)
    inflation = Inflation(size=size, radius=radius, pressure=pressure, ring_stiffness=ring or USUAL.ring_stiffness)
    form = read_size(size, radius)
    load = _load(tire, form, notes)
    standing = standing_targets(tire, form, pressure, nominal, load)
    if ring is None:
        how = "is fitted too" if standing else f"{USUAL.ring_stiffness:g} N/m is the usual one"
        notes.append(f"no BELT_MASS and FREQ_LONG; ring_stiffness {how}")
    if not standing:
        notes.append("not fitted: the file has no VERTICAL_STIFFNESS, Q_FZ1 or [DEFLECTION_LOAD_CURVE] up to the load")
        return _scene(tire, inflation, (), notes)
    by_law = law_tire(tire, form.radius, pressure, nominal, load)
    aim = standing_tire(tire, form.radius, pressure, nominal, load)
    if tire.curve is not None and by_law is not None and aim is not None:
        said = contradiction(tire, by_law, aim)
        if said is not None:
            notes.append(said)
    usual = usual_contact(standing[0], form)
    inflation, comparisons = _fit(tire, inflation, standing, [] if usual is None else [usual], ring is None, notes)
    if usual is not None:
        notes.append(
            "no Q_RA or Q_RB: the fit aims weakly at a usual contact; do not trust its length and width before its force"
        )
    rolling = rolling_targets(tire, form, pressure) if usual is None else []
    if tire.get("PKX1") and not rolling:
        notes.append("PKX1 is not used: it needs FNOMIN, VERTICAL_STIFFNESS, Q_RA and Q_RB for the contact")
    return _scene(tire, inflation, comparisons, notes, rolling)


def measured_tire(measured: Measured, size: str, radius: float | None = None) -> SceneTire:
    """The tire of a table of measurements, of a ``size`` as on the sidewall and a free ``radius`` [m]: all of the inflated tire
    fitted to a few rows, and compared with all. A scene has the middle inflation; the middle load there is the nominal one.

    Raises PropertyFileError for a size that is none, an inflation that a scene does not take, and where no inflated tire carries
    the loads.
    """
    file, notes = measured.file, list[str]()
    try:
        read_size(size, radius)
    except ValueError as error:
        raise PropertyFileError(str(error)) from None
    low, high = allowed("pressure")
    pressures = sorted({each.pressure for each in measured.targets})
    for pressure in pressures:
        if not low <= pressure <= high:
            raise PropertyFileError(
                f"{file.file}: an inflation of {pressure:g} Pa; the inflated tire of a scene takes {low:g} to {high:g} Pa"
            )
    middle = pressures[len(pressures) // 2]
    there = sorted((each for each in measured.targets if each.pressure == middle), key=lambda each: each.load)
    first = there[len(there) // 2]
    inflation = Inflation(size=size, radius=radius, pressure=middle)
    ordered = [first, *(each for each in measured.targets if each is not first)]
    chosen = few(measured.targets)
    if len(chosen) < len(ordered):
        notes.append(f"fitted to {len(chosen)} of {len(ordered)} rows, compared with all")
    inflation, comparisons = _fit(file, inflation, ordered, [], True, notes, chosen)
    rolling = [each for each in ordered if any(not math.isnan(getattr(each, name)) for name in ROLLING)]
    return _scene(file, inflation, comparisons, notes, rolling)


def _scene(
    tire: PropertyFile, inflation: Inflation, comparisons: tuple[Comparison, ...], notes: list[str],
    rolling: Sequence[Target] = (),
) -> SceneTire:  # fmt: skip
    """The effects of a tire that is fitted where there are comparisons, and of how it rolls."""
    written = WRITTEN if not comparisons else (*WRITTEN, "sidewall_angle", *(each.key for each in UNKNOWNS))
    given = inflation.model_dump(include=set(written), exclude_none=True)
    effects = {"inflation": {key: _rounded(value) for key, value in given.items()}, **_rigid_ring(tire, inflation)}
    carried = found_where(inflation, rolling)
    lines = [have[1] for have in carried if have is not None]
    rolling = [target for target, have in zip(rolling, carried, strict=True) if have is not None]
    slip = slip_keys(tire, rolling, lines, notes)
    if slip.brush:
        rounded = [{key: _rounded(value) for key, value in keys.items()} for keys in (slip.brush, slip.compliance)]
        effects |= {"contact_field": {}, "brush": rounded[0], "sidewall_compliance": rounded[1]}
    for target, have in zip(rolling, slip.have, strict=True):
        comparisons += _beside(target, have, ROLLING, f", {target.load:.0f} N")
    return SceneTire(effects, comparisons, tuple(notes))


def _beside(target: Target, have: Target, names: Sequence[str], where: str = "") -> tuple[Comparison, ...]:
    """What is known of a target beside what the tire has there."""
    return tuple(
        Comparison(f"{NAMES[name][0]}{where}", NAMES[name][1], getattr(target, name), getattr(have, name))
        for name in names
        if not math.isnan(getattr(target, name))
    )


def _figures_beyond(tire: PropertyFile, beyond: BeyondInflationError, size: str, radius: float | None) -> str:
    """What the inflated tire of a ``size`` misses of the file at the nearest inflation that a scene takes; empty where the
    file states no stiffness.
    """
    form, inflation = read_size(size, radius), Inflation(size=size, radius=radius, pressure=beyond.nearest)
    stated = standing_tire(tire, form.radius, beyond.stated, beyond.nominal, _load(tire, form, []))
    if stated is None:
        return ""
    return _figures(inflation, Target(beyond.stated, stated.load, stated.stiffness, stated.deflection))


def _figures(inflation: Inflation, stated: Target) -> str:
    """What an inflated tire misses of a ``stated`` one at its deflection."""
    low, _high = angles(inflation)
    inflation = inflation.model_copy(update={"sidewall_angle": max(inflation.sidewall_angle, low)})
    at = (
        f"; at {inflation.pressure:g} Pa and the file's deflection of {1e3 * stated.deflection:.3g} mm the usual tire "
        f"{inflation.size} "
    )
    try:
        load, stiffness = squashed(inflation, stated.deflection)
    except (FieldError, ValueError):  # sidewalls that carry all
        return f"{at}carries nothing that its grid holds"
    return (
        f"{at}carries {load:.4g} of {stated.load:.4g} N (ratio {load / stated.load:.2g}) with {stiffness:.4g} of "
        f"{stated.stiffness:.4g} N/m (ratio {stiffness / stated.stiffness:.2g})"
    )


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
    tire: PropertyFile, inflation: Inflation, targets: Sequence[Target], usual: list[Target], ring: bool, notes: list[str],
    chosen: Sequence[Target] = (),
) -> tuple[Inflation, tuple[Comparison, ...]]:  # fmt: skip
    """The fitted tire, and what it has beside the targets: radius and the first of them, the nominal one, in front.
    ring: whether the rigid ring is fitted; chosen: of the targets, for the fit, all without.
    """
    stated, first = inflation.ring_stiffness, targets[0]
    try:
        inflation = fitted(inflation, [*(chosen or targets), *usual], ring)
        carried = found_where(inflation, targets)
        if carried[0] is None:
            raise FieldError(f"tire: it does not carry {first.load:g} N")
    except FieldError:
        known = not (math.isnan(first.stiffness) or math.isnan(first.deflection))
        figures = _figures(inflation, first) if known else ""
        raise PropertyFileError(
            f"{tire.file}{_lines(tire, 'FNOMIN')}: no inflated tire {inflation.size} at {inflation.pressure:g} Pa carries "
            f"{'FNOMIN' if tire.get('FNOMIN') else 'its loads,'} {first.load:g} N{figures}"
        ) from None
    radius = read_size(inflation.size, inflation.radius).radius
    rows = [
        Comparison("radius", "m", tire.get("UNLOADED_RADIUS") or radius, radius), *_beside(first, carried[0][0], STANDING),
    ]  # fmt: skip
    if not ring:
        rows.append(Comparison("ring stiffness", "N/m", stated, inflation.ring_stiffness))
    for target, have in zip(targets[1:], carried[1:], strict=True):
        if have is None:
            notes.append(f"the fitted tire does not carry {target.load:.4g} N at {1e-3 * target.pressure:.4g} kPa")
            continue
        rows += _beside(target, have[0], STANDING, f", {target.load:.0f} N, {1e-3 * target.pressure:.0f} kPa")
    if min(abs(inflation.sidewall_angle - end) for end in angles(inflation)) < 1e-3:
        notes.append("sidewall_angle is at the end of its range: no tire of this kind is nearer to the file")
    low, high, deepest = USUAL_RANGE
    sunk = carried[0][0].deflection
    if not (low <= inflation.pressure <= high and sunk <= deepest):
        notes.append(
            f"inflation {inflation.pressure:g} Pa and deflection {sunk:.3g} m: the tire is valid for "
            f"{low:g} to {high:g} Pa and up to {deepest:g} m"
        )
    return inflation, tuple(rows)


def _rounded(value: Any) -> Any:
    """A number with as many digits as a fit deserves."""
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value
