"""Published figures of car tires, for `bench validation`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache, partial

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_stiffness
from contact_sim_pkg.records.metric import Published
from contact_sim_pkg.report.metrics.bands import published_range
from contact_sim_pkg.rigs.vehicle.machines.flat_track import Track, flat_track
from contact_sim_pkg.rigs.vehicle.machines.held_axle import CLEAT, OverCleat, over_cleat
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.tire.body import body_of
from contact_sim_pkg.rigs.vehicle.tire.force_table import TireTable, tire_table
from contact_sim_pkg.rigs.vehicle.tire.lattice import standing_load
from contact_sim_pkg.rigs.vehicle.tire.schema import TireSection
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of
from contact_sim_pkg.scene.resolve import load_resolved

__all__ = ["VALIDATION"]

SCENE = "tire_rough_road"
USUAL = 220  # [kPa]
ROADS = 5
LOWEST = 15.0  # [Hz] of a line behind the cleat
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


@cache
def _track(*values: str, speed: float = 60.0 / 3.6, duration: float = 0.8) -> Track:
    """The tire on its belt under 4 kN at 60 km/h."""
    return flat_track(4000.0, speed, duration, "effects.tire.sidewall_compliance={}", *values)


def _steady(*values: str) -> NDArray[numpy.float64]:
    """F_x, F_y [N] and M_z [N m], mean of the last 50 ms."""
    force: NDArray[numpy.float64] = _track(*values).force[-200:].mean(axis=0)
    return force


def _slip_stiffness() -> float:
    """Braking force over a small slip [kN]."""
    return 1e-3 * float(_steady("slip={longitudinal: -0.002}")[0]) / -0.002


def _cornering(angle: float = 0.002) -> tuple[float, float]:
    """Side force over a small slip angle [N/deg], and pneumatic trail [mm]."""
    _force_x, force_y, moment = _steady(f"slip={{angle: {angle}}}")
    return -float(force_y) / math.degrees(angle), -1e3 * float(moment / force_y)


def _relaxation(value: str, axis: int) -> float:
    """Way [m] to 63 % of a step of the slip."""
    track = _track(value)
    part = track.axle[:, axis] / track.axle[-1, axis]
    return 60.0 / 3.6 * float(track.time[numpy.argmax(part > 1.0 - math.exp(-1.0))])


@cache
def _braking() -> tuple[float, float, float]:
    """Largest braking force over the load, its slip, and the force of the locked wheel."""
    slips = numpy.linspace(-0.06, -0.2, 15)
    forces = numpy.array([_steady(f"slip={{longitudinal: {slip:.3f}}}")[0] for slip in slips]) / -4000.0
    best = int(forces.argmax())
    return float(forces[best]), -float(slips[best]), -float(_steady("slip={longitudinal: -1}")[0]) / 4000.0


def _largest_side_force() -> float:
    """Over the load, up to 12 degrees."""
    return max(-float(_steady(f"slip={{angle: {math.radians(angle):.4f}}}")[1]) for angle in range(5, 13)) / 4000.0


def _belt_modes() -> tuple[float, float]:
    """Translation and wind-up [Hz] of the belt on a fixed rim."""
    friction = build(load_resolved("tire_cleat")).rolling_friction
    assert friction is not None
    belt = friction.sidewalls
    assert belt is not None
    return (
        math.sqrt(belt.stiffness_x / belt.mass) / (2.0 * math.pi),
        math.sqrt(belt.stiffness_twist / belt.inertia) / (2.0 * math.pi),
    )


@cache
def _over_cleat(speed: float) -> OverCleat:
    """Over a cleat of 10 by 50 mm at a ``speed`` [km/h], the axle held under 4 kN."""
    return over_cleat(4000.0, speed / 3.6)


def _ringing(speed: float, name: str) -> float:
    """Frequency [Hz] of the highest line of a force behind the cleat."""
    found = _over_cleat(speed)
    force = getattr(found, name)[found.place > CLEAT + 0.3][:700]
    power = abs(numpy.fft.rfft((force - force.mean()) * numpy.hanning(len(force)), 16384))
    lines = numpy.fft.rfftfreq(16384, found.time[1])
    heard = lines > LOWEST
    return float(lines[heard][power[heard].argmax()])


def _rise(speed: float) -> float:
    """Largest rise of the vertical force [N]."""
    force = _over_cleat(speed).vertical
    return float(force.max() - force[0])


def _along(speed: float) -> float:
    """Largest force along the road, either way [N]."""
    return float(abs(_over_cleat(speed).longitudinal).max())


def _rolling_resistance(speed: float) -> float:
    """Force against the travel over the load, 4 kN at a ``speed`` [km/h]."""
    values = (
        f"travel={{speed: {speed / 3.6}}}", "road={kind: flat}", f"tire.body_mass={4000.0 / 9.80665 - 40.0}",
        "effects.tire.tread_viscoelasticity={}",
    )  # fmt: skip
    outputs = outputs_of("tire_cleat", 0.6, *values)
    force = numpy.concatenate([record.longitudinal for record in records_of(outputs, "tire/axle")])
    return -float(force[len(force) // 2 :].mean()) / 4000.0


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
    for load, sunk, length, width in ((2, 10.5, 87, 121), (4, 20.3, 132, 141), (6, 29.6, 169, 151)):
        newton = 1e3 * load
        yield _of(f"deflection of the axle under {load} kN", "mm", f"{sunk}", _near(sunk, 0.15),
                  partial(_deflection_mm, newton))  # fmt: skip
        yield _of(f"length of the contact under {load} kN", "mm", f"{length}", _near(length, 0.1),
                  partial(_extent_mm, newton, 0), fitted=load == 4)  # fmt: skip
        yield _of(f"width of the contact under {load} kN", "mm", f"{width}", _near(width, 0.1),
                  partial(_extent_mm, newton, 1))  # fmt: skip


def _by_inflation() -> Iterator[Published]:
    """Mean pressure of the contact from 120 to 300 kPa."""
    for inflation, mean in ((120, 159), (180, 193), (220, 215), (260, 237), (300, 259)):
        yield _of(f"mean pressure over the whole contact, 4 kN, {inflation} kPa", "kPa", f"{mean}", _near(mean, 0.12),
                  partial(_mean_kpa, inflation), fitted=inflation == USUAL,
                  note="the shoulders' round keeps a long contact narrow" if inflation < USUAL else "")  # fmt: skip


def _by_ride() -> Iterator[Published]:
    """Wheel mode and dynamic load of the medium car."""
    for inflation, mode, dynamic in ((200, 12.0, 0.241), (220, 12.25, 0.251)):
        yield _of(f"frequency of the wheel on the tire, {inflation} kPa", "Hz", f"{mode}", (mode - 0.3, mode + 0.3),
                  partial(_wheel_mode, inflation), source=_QUARTER_CAR, machine="quarter car")  # fmt: skip
        yield _of(f"dynamic load coefficient, class C, 20 m/s, {inflation} kPa", "", f"{dynamic}", _near(dynamic, 0.05),
                  partial(_dynamic_load, inflation), source=_QUARTER_CAR, machine="quarter car",
                  note=f"mean of {ROADS} roads of {LENGTH:g} s; damping of the tire included")  # fmt: skip


_CLEAT = (
    "rigid ring with a line of springs and a brush of 87 kN, axle held, cleat of 10 by 50 mm (computed for comparison); "
    "sizes of published cleat tests from memory: +1 to +2.5 kN upward, 0.7 to 2 kN along, for 20 to 60 km/h"
)
_FIRST = "bristles and a belt that yields as a whole; a belt that bends sideways has a longer trail"


def _by_slip() -> Iterator[Published]:
    """Slip stiffnesses, relaxation and friction under 4 kN."""
    slip = partial(_of, machine="flat track")
    yield slip(
        "braking force over slip", "kN", "86.8 (103 of another tire)", (75.0, 110.0), _slip_stiffness, fitted=True
    )
    yield slip(
        "side force over slip angle", "N/deg", "930 (1170 of another tire)", (900.0, 1400.0), lambda: _cornering()[0]
    )
    yield slip("pneumatic trail at small angles", "mm", "28.2", (20.0, 40.0), lambda: _cornering()[1], note=_FIRST)
    yield slip("relaxation length of the side force", "m", "0.338", (0.25, 0.6),
               lambda: _relaxation("slip={angle: 0.005}", 1))  # fmt: skip
    yield slip("relaxation length of the braking force", "m", "0.227", (0.1, 0.25),
               lambda: _relaxation("slip={longitudinal: -0.002}", 0))  # fmt: skip
    yield slip(
        "largest braking force over the load",
        "",
        "1.04",
        published_range("tire_friction"),
        lambda: _braking()[0],
        fitted=True,
    )
    yield slip("its slip", "", "0.12", (0.08, 0.18), lambda: _braking()[1])
    yield slip("locked wheel: force over the load", "", "0.74", (0.65, 0.85), lambda: _braking()[2], fitted=True)
    yield slip("largest side force over the load", "", "0.88 at 9 degrees", (0.8, 1.1), _largest_side_force)


def _by_belt() -> Iterator[Published]:
    """Modes of the belt, forces over a cleat, rolling resistance."""
    yield _of("belt on a fixed rim: translation", "Hz", "76.6 and 80", (65.0, 82.0), lambda: _belt_modes()[0])
    yield _of("belt on a fixed rim: wind-up", "Hz", "67.7 and 70", (55.0, 72.0), lambda: _belt_modes()[1])
    for speed, rise, along in ((20, 1369, 723), (40, 1718, 748), (60, 1862, 667)):
        cleat = partial(_of, source=_CLEAT, machine="cleat")
        yield cleat(
            f"largest rise of the vertical force, {speed} km/h", "N", f"{rise}", (1000.0, 2500.0), partial(_rise, speed)
        )
        yield cleat(f"largest force along the road, {speed} km/h", "N", f"{along}", (700.0, 2000.0),
                    partial(_along, speed),
                    note="a footprint round across climbs more gently than a line")  # fmt: skip
        yield cleat(f"vertical force behind the cleat, {speed} km/h", "Hz", "79", (75.0, 90.0),
                    partial(_ringing, speed, "vertical"),
                    note="the ring's stiffness, fitted to standing tires, is 15 % below that of the mode")  # fmt: skip
        high = speed > 50
        yield cleat(f"force along behind the cleat, {speed} km/h", "Hz", "33 or 80" if high else "33",
                    (30.0, 90.0) if high else (30.0, 45.0), partial(_ringing, speed, "longitudinal"))  # fmt: skip
    for speed, published in ((30, 0.0078), (60, 0.0086), (100, 0.0102)):
        yield _of(f"rolling resistance over the load, {speed} km/h", "", f"{published} (0.007 to 0.017 of many tires)",
                  (0.85 * published, 1.15 * published), partial(_rolling_resistance, speed), fitted=True)  # fmt: skip


VALIDATION = [
    _of("stiffness under 4 kN, 220 kPa", "kN/m", "210 (200 to 230 of other tires)", published_range("tire_stiffness"),
        lambda: 1e-3 * _stiffness(4000.0), fitted=True),
    *_by_load(),
    _of("relative change of stiffness over that of inflation, 4 kN", "", "0.63", (0.45, 0.9), _inflation_effect),
    *_by_inflation(),
    *_by_ride(),
    *_by_slip(),
    *_by_belt(),
]  # fmt: skip
