"""Published figures of car tires, for `bench validation`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache, partial

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_stiffness
from contact_sim_pkg.records.published import Published
from contact_sim_pkg.rigs.vehicle.lattice import standing_load
from contact_sim_pkg.rigs.vehicle.tire.body import body_of
from contact_sim_pkg.rigs.vehicle.tire.force_table import TireTable, tire_table
from contact_sim_pkg.rigs.vehicle.tire.schema import TireSection
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of
from contact_sim_pkg.scene.resolve import load_resolved

__all__ = ["VALIDATION"]

SCENE = "tire_rough_road"
USUAL = 220  # [kPa]
ROADS = 5
LENGTH, RUN_IN = 60.0, 2.0  # [s] of a ride, and of its start that does not count
SPEED = 20.0  # [m/s]
RIDE = (
    f"travel={{speed: {SPEED}}}", "accuracy=1e-3", "effects.tire.contact_field=null", "block_length=0.1",
    "road={kind: iso8608, roughness_class: C, length: 1200, shortest_wavelength: 0.3533, longest_wavelength: 90.9}",
)  # fmt: skip


@cache
def _table(inflation: int) -> TireTable:
    """The default tire at an ``inflation`` [kPa]."""
    return tire_table(body_of(load_resolved(SCENE, f"effects.tire.inflation.pressure={1e3 * inflation}")))


def _deflection(load: float, inflation: int = USUAL) -> float:
    """Of the axle [m]."""
    return float(approach_of_force(_table(inflation).law(), load))


def _stiffness(load: float, inflation: int = USUAL) -> float:
    """[N/m]"""
    return float(elastic_stiffness(_table(inflation).law(), _deflection(load, inflation)))


def _deflection_mm(load: float) -> float:
    return 1e3 * _deflection(load)


def _extent_mm(load: float, axis: int) -> float:
    """Length (0) or width (1) of the contact [mm]."""
    return 1e3 * _table(USUAL).contact_at(load)[axis]


def _mean_kpa(inflation: int) -> float:
    """Mean pressure over the whole contact under 4 kN [kPa]."""
    return 1e-3 * 4000.0 / _table(inflation).contact_at(4000.0)[2]


def _inflation_effect() -> float:
    """Relative change of the stiffness over that of the inflation, at 4 kN."""
    return math.log(_stiffness(4000.0, 240) / _stiffness(4000.0, 200)) / math.log(240.0 / 200.0)


def _wheel_mode(inflation: int) -> float:
    """Frequency [Hz] of the wheel on tire and suspension, without damping: the upper of two."""
    car = TireSection()
    stiffness, spring = _stiffness(standing_load(car, None), inflation), car.suspension_stiffness
    coupled = numpy.array([[stiffness + spring, -spring], [-spring, spring]])
    masses = numpy.array([car.wheel_mass, car.body_mass])
    return float(numpy.sqrt(numpy.linalg.eigvals(coupled / masses[:, None]).real.max()) / (2.0 * math.pi))


@cache
def _dynamic_load(inflation: int) -> float:
    """Standard deviation of the force over the load at rest, mean of the roads."""
    given = f"effects.tire.inflation.pressure={1e3 * inflation}"
    runs = [_force(given, f"seed={seed}") for seed in range(1, ROADS + 1)]
    return float(numpy.mean([force.std() for force in runs]) / standing_load(TireSection(), None))


def _force(*values: str) -> NDArray[numpy.float64]:
    blocks = records_of(outputs_of(SCENE, LENGTH, *RIDE, *values), "tire/force")
    force = numpy.concatenate([block.normal for block in blocks])
    return force[round(RUN_IN * len(force) / LENGTH) :]


_SWIFT = (
    "MF-Tyre/MF-Swift 6.2 data of a 205/60 R15 car tire at 220 kPa (TNO and TASS), as they stand as defaults in public "
    "vehicle models; evaluated by the formulas of Pacejka, Tire and Vehicle Dynamics, 2012"
)
_QUARTER_CAR = (
    "quarter car of 300 and 40 kg, 20 kN/m, 1500 N s/m on a linear tire of 200 kN/m (at 220 kPa of 210 kN/m): closed form, "
    "ISO 8608 road of 0.011 to 2.83 cycles/m"
)


def _of(quantity: str, unit: str, value: str, band: tuple[float, float], ours: Callable[[], float], *,
        source: str = _SWIFT, machine: str = "tire", fitted: bool = False, note: str = "") -> Published:  # fmt: skip
    return Published(machine=machine, quantity=quantity, unit=unit, value=value, band=band, source=source, ours=ours,
                     fitted=fitted, note=note)  # fmt: skip


def _near(value: float, part: float) -> tuple[float, float]:
    low, high = (float(f"{value * factor:.3g}") for factor in (1.0 - part, 1.0 + part))
    return low, high


def _by_load() -> Iterator[Published]:
    """Deflection and contact under 2, 4 and 6 kN."""
    too_soft = "the belt is inextensible and its sidewalls a spring: softer than this tire under small loads"
    for load, sunk, length, width in ((2, 10.5, 87, 121), (4, 20.3, 132, 141), (6, 29.6, 169, 151)):
        newton = 1e3 * load
        usual, few = load == 4, load == 2
        yield _of(f"deflection of the axle under {load} kN", "mm", f"{sunk}", _near(sunk, 0.15),
                  partial(_deflection_mm, newton), note=too_soft if few else "")  # fmt: skip
        yield _of(f"length of the contact under {load} kN", "mm", f"{length}", _near(length, 0.1),
                  partial(_extent_mm, newton, 0), fitted=usual,
                  note="as its deflection" if few else "")  # fmt: skip
        yield _of(f"width of the contact under {load} kN", "mm", f"{width}", _near(width, 0.1),
                  partial(_extent_mm, newton, 1),
                  note="a crown of one radius; a real one flattens under load" if few else "")  # fmt: skip


def _by_inflation() -> Iterator[Published]:
    """Mean pressure of the contact from 120 to 300 kPa."""
    for inflation, mean in ((120, 159), (180, 193), (220, 215), (260, 237), (300, 259)):
        yield _of(f"mean pressure over the whole contact, 4 kN, {inflation} kPa", "kPa", f"{mean}", _near(mean, 0.12),
                  partial(_mean_kpa, inflation), fitted=inflation == USUAL,
                  note="the contact stays too wide where it is short" if inflation == 300 else "")  # fmt: skip


def _by_ride() -> Iterator[Published]:
    """Wheel mode and dynamic load of the medium car."""
    for inflation, mode, dynamic in ((200, 12.0, 0.241), (220, 12.25, 0.251)):
        yield _of(f"frequency of the wheel on the tire, {inflation} kPa", "Hz", f"{mode}", (mode - 0.3, mode + 0.3),
                  partial(_wheel_mode, inflation), source=_QUARTER_CAR, machine="quarter car")  # fmt: skip
        yield _of(f"dynamic load coefficient, class C, 20 m/s, {inflation} kPa", "", f"{dynamic}", _near(dynamic, 0.05),
                  partial(_dynamic_load, inflation), source=_QUARTER_CAR, machine="quarter car",
                  note=f"mean of {ROADS} roads of {LENGTH:g} s; damping of the tire included")  # fmt: skip


VALIDATION = [
    _of("stiffness under 4 kN, 220 kPa", "kN/m", "210 (200 to 230 of other tires)", (180.0, 250.0),
        lambda: 1e-3 * _stiffness(4000.0), fitted=True),
    *_by_load(),
    _of("relative change of stiffness over that of inflation, 4 kN", "", "0.63", (0.45, 0.9), _inflation_effect,
        note="tread and a quarter of the ring's stiffness do not follow the inflation"),
    *_by_inflation(),
    *_by_ride(),
]  # fmt: skip
