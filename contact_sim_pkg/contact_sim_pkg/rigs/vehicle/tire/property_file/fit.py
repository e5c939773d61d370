"""Inflated tire nearest to what is known of a tire over loads and inflations, by least squares in the logarithms of its
keys; what the tire cannot be is left as a difference.

Of the standing tire: stiffness, deflection, length and width of the contact, by sidewall angle, tread modulus, stiffness of
structure and ring, belt width and crown. Of the rolling one: stiffness in braking and cornering and the trail, in closed
form from the contact's lines of length 2a along the travel, by bristles k, yaw stiffness C, bending c_b and extension c_s:

    K_0 = sum 2 k a^2 dy,  m = sum 2/3 k a^3 dy
    K_x = K_0 / (1 + c_s m),  K_y = K_0 / ((1 + c_b m) (1 + m / C)),  t = (m / K_0) (1 + c_b m)

Keys that nothing speaks of stay near the usual ones, which count as weak measurements. Fitted on cells of 5 mm, which are
within 1 % of those of the force table. Source: Pacejka, Tire and Vehicle Dynamics, ch. 3 and 5.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.optimize import least_squares

from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldError, PressureField
from contact_sim_pkg.rigs.vehicle.tire.body import tire_body
from contact_sim_pkg.rigs.vehicle.tire.force_table import COLS, ITERATIONS, ROWS, TOLERANCE, gap_over_level_road
from contact_sim_pkg.rigs.vehicle.tire.property_file.magic_formula import StandingTire
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.rigs.vehicle.tire.size import read_size
from contact_sim_pkg.scene.schema.catalog import catalog
from contact_sim_pkg.scene.schema.fields import given

__all__ = [
    "ROLLING",
    "STANDING",
    "UNKNOWNS",
    "Target",
    "allowed",
    "angles",
    "fitted",
    "fitted_slip",
    "found_at",
    "found_where",
    "squashed",
    "standing_on_belt",
]

Field = NDArray[numpy.float64]
LOAD_STEP = 0.02  # of the load, either way, for the stiffness
COARSE = 2  # cells of the force table on each way of one of the fit
TINY = 1e-3  # [m] extent of a contact that is less than two cells
FAR = 1e3  # residual of a tire that cannot be solved: more than one that can has
STEP = 0.02  # of a logarithm, for a derivative: the contact's edge moves by a part of a cell
FROM = 10.0  # where the logarithms are counted from: the steps go with them, and none comes to 0
STANDING = ("stiffness", "deflection", "length", "width")
ROLLING = ("braking", "cornering", "trail")
CLOSE = {
    "stiffness": 0.0175, "deflection": 0.0175, "length": 0.03, "width": 0.07, "braking": 0.03, "cornering": 0.03, "trail": 0.06,
}  # fmt: skip
"""Relative standard deviations of what is known."""


class Target(NamedTuple):
    """What is known of a tire under a load at an inflation; nan where nothing is."""

    pressure: float  # [Pa]
    load: float  # [N]
    stiffness: float = math.nan  # [N/m]
    deflection: float = math.nan  # [m] of the axle
    length: float = math.nan  # [m] of the contact
    width: float = math.nan  # [m]
    braking: float = math.nan  # [N] per slip
    cornering: float = math.nan  # [N/rad]
    trail: float = math.nan  # [m]
    weight: float = 1.0  # of the standing tire; 0.2: a usual contact


class Unknown(NamedTuple):
    """A key that the fit changes, its range, and the standard deviation of its logarithm about the usual value."""

    key: str
    low: float
    high: float
    weakly: float


BELT = 0.6, 0.97  # of the section width
UNKNOWNS = (
    Unknown("tread_modulus", 5e5, 5e7, 2.0), Unknown("structure", 5e3, 2e6, 3.0), Unknown("tangential", 2e4, 2e6, 3.0),
    Unknown("belt_width", *BELT, 0.25), Unknown("crown_radius", 0.1, 10.0, 2.0), Unknown("shoulder", 1e-4, 0.01, 2.5),
)  # fmt: skip
ANGLE, RING, HELD = 0.6, 1.0, 0.15
"""Standard deviations of sidewall angle and ring stiffness; of a key that a file states."""
OF_SLIP = (
    Unknown("stiffness", 1e6, 1e9, 3.0), Unknown("yaw", 500.0, 1e5, 2.0), Unknown("bending", 1e-6, 1e-2, 2.0),
    Unknown("extension", 1e-6, 1e-2, 2.0),
)  # fmt: skip


class Lines(NamedTuple):
    """Sums over the lines of a contact along the travel, of length 2a."""

    squares: float  # sum 2 a^2 dy [m^3]
    cubes: float  # sum 2/3 a^3 dy [m^4]
    area: float  # [m^2]


def nearest(unknowns: Sequence[Unknown], usual: Sequence[float], missed: Callable[[Field], Field]) -> Field:
    """Values of the ``unknowns`` at which what is ``missed`` (of the values; in standard deviations) is least, beside their
    distance from the ``usual`` ones.
    """
    low, high = (numpy.log([getattr(each, end) for each in unknowns]) for end in ("low", "high"))
    start = numpy.clip(numpy.log(usual), low + 1e-3, high - 1e-3)
    weakly = numpy.array([each.weakly for each in unknowns])
    solution = least_squares(
        lambda at: numpy.concatenate((missed(numpy.exp(start + at - FROM)), (at - FROM) / weakly)), numpy.full(len(start), FROM),
        "2-point", (low - start + FROM, high - start + FROM), ftol=1e-3, xtol=1e-4, x_scale=numpy.minimum(weakly, 1.0),
        diff_step=STEP / FROM, max_nfev=25,
    )  # fmt: skip
    return numpy.asarray(numpy.exp(start + solution.x - FROM))


def fitted(inflation: Inflation, targets: Sequence[Target], ring: bool) -> Inflation:
    """The tire nearest to the ``targets``; ring: whether the rigid ring is free, otherwise that of `inflation` is held
    back, as the file's.

    Raises FieldError where no such tire carries their loads.
    """
    size = read_size(inflation.size, inflation.radius)
    unknowns = (
        Unknown("sidewall_angle", *angles(inflation), ANGLE), Unknown("ring_stiffness", 1e5, 1e8, RING if ring else HELD),
        *(each if each.key != "belt_width" else each._replace(low=BELT[0] * size.width, high=BELT[1] * size.width)
          for each in UNKNOWNS),
    )  # fmt: skip
    usual = [getattr(inflation, each.key) or size.belt_width for each in unknowns]

    def tire(values: Field) -> Inflation:
        return inflation.model_copy(update={each.key: float(v) for each, v in zip(unknowns, values, strict=True)})

    def missed(values: Field) -> Field:
        try:
            found = found_where(tire(values), targets, COARSE)
        except ValueError:  # sidewalls that carry all
            return numpy.full(len(targets) * len(STANDING), FAR)
        return numpy.concatenate([
            [FAR if have is None else _missed(target, have[0], name) * target.weight for name in STANDING]
            for target, have in zip(targets, found, strict=True)
        ])  # fmt: skip

    return tire(nearest(unknowns, usual, missed))


def fitted_slip(
    lines: Sequence[Lines], targets: Sequence[Target], usual: dict[str, float], stated: str = ""
) -> dict[str, float]:
    """Bristles' ``stiffness`` [N/m^3], ``yaw`` [N m/rad], ``bending`` and ``extension`` [1/(m N)] nearest to the targets on
    contacts of such ``lines``; the key ``stated`` is held back.
    """
    unknowns = [each._replace(weakly=HELD) if each.key == stated else each for each in OF_SLIP]

    def missed(values: Field) -> Field:
        rolling = [rolling_on(each, *values.tolist()) for each in lines]
        return numpy.array([
            _missed(target, have, name) for target, have in zip(targets, rolling, strict=True) for name in ROLLING
        ])  # fmt: skip

    found = nearest(unknowns, [usual[each.key] for each in unknowns], missed)
    return dict(zip((each.key for each in unknowns), found.tolist(), strict=True))


def rolling_on(lines: Lines, bristles: float, yaw: float, bending: float, extension: float) -> Target:
    """Stiffnesses and trail of a rolling tire on a contact; see the module."""
    own, moment = bristles * lines.squares, bristles * lines.cubes
    return Target(
        math.nan, math.nan, braking=own / (1.0 + extension * moment),
        cornering=own / ((1.0 + bending * moment) * (1.0 + moment / yaw)), trail=moment / own * (1.0 + bending * moment),
    )  # fmt: skip


def _missed(target: Target, have: Target, name: str) -> float:
    """By how many standard deviations ``have`` misses what is known; 0 where nothing is."""
    wanted = getattr(target, name)
    return 0.0 if math.isnan(wanted) else math.log(getattr(have, name) / wanted) / CLOSE[name]


def angles(inflation: Inflation) -> tuple[float, float]:
    """Sidewall angles [rad] of the fit: those of a scene at which the belt carries a part of the inflation."""
    size = read_size(inflation.size, inflation.radius)
    low, high = allowed("sidewall_angle")
    return max(low, math.atan(size.sidewall_chord / size.belt_width) + 0.02), high


def allowed(key: str) -> tuple[float, float]:
    """Range of a number of `effects.tire.inflation` in a scene."""
    entry = catalog()["effects", "tire", "inflation", key]
    return given(entry.low), given(entry.high)


def standing_on_belt(inflation: Inflation, load: float) -> StandingTire:
    """The inflated tire of a scene's section under a ``load`` [N] on a level road, on the cells of its force table.

    Raises FieldError where the load is more than the tire carries.
    """
    have, _lines = found_at(inflation, [Target(inflation.pressure, load)])[0]
    return StandingTire(*(getattr(have, name) for name in StandingTire._fields))


def squashed(inflation: Inflation, deflection: float) -> tuple[float, float]:
    """Load [N] and stiffness [N/m] of the inflated tire of a scene's section at a ``deflection`` [m] on a level road.

    Raises FieldError where no grid holds its contact.
    """
    field, gap = _field_of(inflation, COARSE)
    below, above = (field.solve(gap, deflection * (1.0 + step)) for step in (-LOAD_STEP, LOAD_STEP))
    return 0.5 * (below + above), (above - below) / (2.0 * LOAD_STEP * deflection)


def found_at(inflation: Inflation, targets: Sequence[Target], coarse: int = 1) -> list[tuple[Target, Lines]]:
    """What the tire has, standing, under the load and at the inflation of each target, and the lines of its contact; on
    cells ``coarse`` times those of the force table.

    Stiffness, deflection and contact: of the loads 2 % below and above. Raises FieldError where a load is more than the
    tire carries.
    """
    found = found_where(inflation, targets, coarse)
    for target, have in zip(targets, found, strict=True):
        if have is None:
            raise FieldError(f"tire: it does not carry {target.load:g} N at {target.pressure:g} Pa")
    return [have for have in found if have is not None]


def found_where(inflation: Inflation, targets: Sequence[Target], coarse: int = 1) -> list[tuple[Target, Lines] | None]:
    """The same, None where a load is more than the tire carries."""
    found: list[tuple[Target, Lines] | None] = [None] * len(targets)
    by_pressure: dict[float, list[int]] = defaultdict(list)
    for number in sorted(range(len(targets)), key=lambda number: targets[number].load):
        by_pressure[targets[number].pressure].append(number)
    for pressure, numbers in by_pressure.items():
        field, gap = _field_of(inflation.model_copy(update={"pressure": pressure}), coarse)
        for number in numbers:
            try:
                found[number] = _under(field, gap, pressure, targets[number].load)
            except FieldError:  # so are those that are heavier
                break
    return found


def _field_of(inflation: Inflation, coarse: int) -> tuple[PressureField, Field]:
    """The pressure field of a tire, and its gap over a level road."""
    size = read_size(inflation.size, inflation.radius)
    chord, width = inflation.sidewall_chord or size.sidewall_chord, inflation.belt_width or size.belt_width
    body = tire_body({"inflation": {**inflation.model_dump(), "sidewall_chord": chord, "belt_width": width}})
    assert body.extent is not None
    rows, cols = ROWS // coarse, COLS // coarse
    cell_x, cell_y = body.extent[0] / rows, body.extent[1] / cols
    rows, cols = rows + rows // 2, cols + cols // 2
    x, y = (numpy.arange(rows) - rows // 2) * cell_x, (numpy.arange(cols) - 0.5 * (cols - 1)) * cell_y
    tolerance = TOLERANCE if coarse == 1 else 10.0 * TOLERANCE
    settings = FieldSettings(rows, cols, cell_x, cell_y, body.modulus, tolerance, ITERATIONS, 0, body.belt)
    return PressureField(settings, "tire"), gap_over_level_road(body.form, x, y)


def _under(field: PressureField, gap: Field, pressure: float, load: float) -> tuple[Target, Lines]:
    """What a tire has under a load."""
    cell_x, cell_y = field.settings.cell_x, field.settings.cell_y
    depths, along, across = [], [], []
    for step in (1.0 - LOAD_STEP, 1.0 + LOAD_STEP):
        depths.append(field.solve_load(gap, load * step))
        along.append(cell_x * _lengths(field.pressure))
        across.append(cell_y * _lengths(field.pressure.T))
    length, width = (0.5 * sum(float(each.max()) for each in lines) for lines in (along, across))
    halves = 0.5 * numpy.concatenate(along)
    lines = Lines(
        *(0.5 * cell_y * float(each.sum()) for each in (2.0 * halves**2, 2.0 / 3.0 * halves**3, 2.0 * halves))
    )
    stiffness, deflection = 2.0 * LOAD_STEP * load / (depths[1] - depths[0]), 0.5 * (depths[0] + depths[1])
    return Target(pressure, load, stiffness, deflection, max(length, TINY), max(width, TINY)), lines


def _lengths(pressure: Field) -> Field:
    """Length of the contact on each line of the first axis, in cells: its edge lies between two cells, where the square of
    the pressure, straight near an edge, comes to 0.
    """
    lengths = []
    for line in pressure.T:
        loaded = numpy.flatnonzero(line)
        if len(loaded) < 2:
            lengths.append(float(len(loaded)))
            continue
        first, last = loaded[0], loaded[-1]
        lengths.append(last - first + _beyond(line[first], line[first + 1]) + _beyond(line[last], line[last - 1]))
    return numpy.array(lengths)


def _beyond(outer: float, inner: float) -> float:
    """Cells from the middle of the outermost loaded cell to the edge."""
    return 1.0 if inner <= math.sqrt(2.0) * outer else outer**2 / (inner**2 - outer**2)
