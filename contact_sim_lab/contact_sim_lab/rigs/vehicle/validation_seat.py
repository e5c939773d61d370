"""Published figures of seats and cushions, for `bench validation`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_energy, elastic_force
from contact_sim_pkg.laws.parameters import FoamElastic
from contact_sim_pkg.pressure.cushion.foam_layer import FoamGrid, FoamLayer
from contact_sim_pkg.pressure.cushion.force_table import at_load
from contact_sim_pkg.pressure.cushion.tissue import Tissue
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.fields import given
from contact_sim_pkg.records.metric import Published
from contact_sim_pkg.report.metrics.bands import published_range
from contact_sim_pkg.report.signal.metrics import seat_factor, weighted_rms
from contact_sim_pkg.report.signal.spectrum import CrossDensity, Welch
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.seat.cushion import pan_layer
from contact_sim_pkg.rigs.vehicle.seat.occupants import SEATED_MASS
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatCushion
from contact_sim_pkg.run.contact_laws import formula_foam
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.schema.laws import USUAL_REVERSAL, USUAL_SHARE

__all__ = ["THIGHS_FROM", "VALIDATION", "SittingMap", "default_hardness", "sitting"]

Field = NDArray[numpy.float64]
CELL = 0.01  # [m]
LOADED = 500.0  # [Pa] least pressure of a cell that counts as loaded
LOAD = 498.2  # [N] of 50.8 kg, the mass of `wei_griffin_2`
OFFICE_LOADS = (427.0, 119.0)  # [N] buttocks and thighs: area times mean pressure of the publication
TISSUE = Tissue()
PLATE_LOAD = 600.0  # [N]
THIGHS_FROM, FRONT_FROM = 0.12, 0.25  # [m] before the tuberosities
LOOP_LOAD = 705.0  # [N]
DISC_AREA = 0.0323  # [m^2] of the indenter of ISO 2439
NOISE = "vibration={{kind: noise, low: 0.5, high: 20, rms: {rms}}}"
LENGTH = 60.0  # [s] of a ride; the noise repeats after it
NOISES = 8  # rides of other phases: one alone moves its largest line by 6 %
SEGMENT = 16.0  # [s] of Welch's method: lines of 1/16 Hz, 0.1 Hz wide
ROAD = ("vibration=null", "road.length=1200", "road.texture=null", "travel.speed=20", "effects.tire.contact_field=null",
        "effects.seat.contact_field=null")  # fmt: skip
FLOOR, SEAT = range(2)  # signals


class SittingMap(NamedTuple):
    """Pressure map of a person at rest."""

    x: Field  # [rows] [m] before the tuberosities
    pressure: Field  # [rows, cols] [Pa]

    @property
    def loaded(self) -> Field:
        """Pressures [Pa] of the loaded cells."""
        return self.pressure[self.pressure > LOADED]

    def between(self, first: float, last: float) -> SittingMap:
        """The part between two distances [m] before the tuberosities."""
        inside = (self.x >= first) & (self.x < last)
        return SittingMap(self.x[inside], self.pressure[inside])

    def share(self, first: float, last: float) -> float:
        """Part of the load in [%] between two distances [m] before the tuberosities."""
        return float(100.0 * self.between(first, last).pressure.sum() / self.pressure.sum())

    @property
    def area(self) -> float:
        """Loaded area [cm^2]."""
        return 1e4 * CELL**2 * len(self.loaded)

    @property
    def mean(self) -> float:
        """Mean pressure of the loaded area [kPa]."""
        return 1e-3 * float(self.loaded.mean())

    @property
    def largest(self) -> float:
        """Largest pressure [kPa]."""
        return 1e-3 * float(self.pressure.max())


@cache
def sitting(load: float, percentile: int = 50, scene: str = "", hardness: float | None = None) -> SittingMap:
    """Map of a percentile under ``load`` [N] on the seat of a ``scene``; else on the default foam, or, a body with
    tissue, on foam of another ``hardness`` [Pa].
    """
    if scene:
        keys = given(load_resolved(scene).effect("seat", SeatCushion))
    elif hardness is None:
        keys = SeatCushion()
    else:
        keys = SeatCushion(hardness=hardness, tissue=TISSUE.pressure, tissue_depth=TISSUE.depth)
    carrier = pan_layer(keys.model_copy(update={"percentile": percentile, "cell": CELL}))
    x = CELL * numpy.arange(-24.0, 48.0, dtype=numpy.float64)
    return SittingMap(x, at_load(carrier, load).pressure)


def default_hardness() -> float:
    """Stress [Pa] of the default foam at 40 % strain."""
    foam = formula_foam(SeatCushion())._replace(area=1.0)
    return float(elastic_force(foam, 0.4 * foam.thickness))


def _change_with_hardness(largest: bool) -> float:
    """Change of the largest or mean pressure [Pa] for each Pa of hardness."""
    softer, harder = (sitting(LOAD, hardness=default_hardness() + step).loaded for step in (-500.0, 500.0))
    return float((harder.max() - softer.max() if largest else harder.mean() - softer.mean()) / 1000.0)


def _indentation_ratio() -> float:
    """Force of a disc of 323 cm^2 at 40 % over the stress of an even load times its area; 100 mm
    foam.
    """
    foam: FoamElastic = formula_foam(SeatCushion(thickness=0.1))._replace(area=DISC_AREA)
    place = (numpy.arange(64) - 31.5) * 0.008
    distance = numpy.hypot(place[:, None], place[None, :])
    gap = numpy.where(distance <= numpy.sqrt(DISC_AREA / numpy.pi), 0.0, 1.0)
    disc = FoamLayer(FoamGrid(64, 64, 0.008, 0.008), foam, gap)
    touching = float((gap == 0.0).sum()) * 0.008**2
    return float(disc.solve(0.04).force / touching / (elastic_force(foam, 0.04) / DISC_AREA))


def _slow_loop() -> float:
    """Work lost in [%] between no load and 705 N and back, so slowly that no rate acts."""
    share, contact = USUAL_SHARE, build(load_resolved("seat_ride")).rig.seat_contact
    assert contact is not None
    stored = float(elastic_energy(contact.elastic, approach_of_force(contact.elastic, LOOP_LOAD)))
    scale = USUAL_REVERSAL
    # z = 1 - exp(-u/u0) on the way in, -1 + (1 + z_end) exp(-(U - u)/u0) on the way out
    passed = 1.0 - math.exp(-stored / scale)
    work_in = stored + share * (stored - scale * passed)
    work_out = stored + share * (scale * passed * (1.0 + passed) - stored)
    return 100.0 * (1.0 - work_out / work_in)


def _densities(scene: str, floor: str, *values: str) -> CrossDensity:
    """Densities of floor and seat frame over a ride, default occupant and cushion.

    floor: name of the body that the seat stands on; values: as of `--set`.
    """
    motion = records_of(outputs_of(scene, LENGTH, *values, "block_length=0.1"), "bench/motion")
    rate = 1.0 / motion[0].sample_period
    signals = [
        numpy.concatenate([block.acceleration[block.bodies.index(name)] for block in motion])
        for name in (floor, "seat_frame_z")
    ]
    welch = Welch(len(signals), round(SEGMENT * rate), rate)
    for _end in welch.advance(numpy.array(signals)):
        pass
    return welch.mean()


@cache
def _ride(rms: float, *values: str) -> CrossDensity:
    """Densities of floor and seat frame under noise of 0.5 to 20 Hz and ``rms`` [m/s^2], mean over the
    noises. On a linear seat T(f) is within 0.6 % of the closed form from 2.5 to 6 Hz.

    values: as of `--set`.
    """
    noise = NOISE.format(rms=rms)
    runs = [_densities("seat_ride", "floor_z", noise, f"seed={seed}", *values) for seed in range(1, NOISES + 1)]
    density = numpy.mean([run.density for run in runs], axis=0)
    return CrossDensity(runs[0].frequency, density, sum(run.segments for run in runs))


def _peak(rms: float) -> tuple[float, float]:
    """Frequency [Hz] and height of the peak of the transmissibility."""
    way = _ride(rms).response(FLOOR, SEAT)
    trusted = (way.frequency > 1.0) & (way.frequency < 15.0) & (way.coherence > 0.9)
    place = numpy.flatnonzero(trusted)[way.magnitude[trusted].argmax()]
    return float(way.frequency[place]), float(way.magnitude[place])


def _isolates_from(rms: float) -> float:
    """Frequency [Hz] above which the transmissibility stays below 1, up to 15 Hz."""
    way = _ride(rms).response(FLOOR, SEAT)
    last = int(numpy.flatnonzero((way.frequency < 15.0) & (way.magnitude >= 1.0))[-1])
    here = slice(last, last + 2)
    return float(numpy.interp(-1.0, -way.magnitude[here], way.frequency[here]))


def _seat_factor(densities: CrossDensity) -> float:
    """SEAT [%] of a ride."""
    return seat_factor(weighted_rms(densities.power(SEAT)), weighted_rms(densities.power(FLOOR)))


def _office() -> SittingMap:
    """Map of an office chair under buttocks and thighs."""
    return sitting(sum(OFFICE_LOADS), 50, "office_chair")


def _plate() -> SittingMap:
    """Map of a plate under a man's weight."""
    return sitting(PLATE_LOAD, 50, "plate")


AREA, MEAN_PRESSURE, PEAK_PRESSURE = (
    published_range(f"cushion_{name}") for name in ("area", "mean_pressure", "peak_pressure")
)
PEAK, PEAK_FREQUENCY = published_range("seat_peak"), published_range("seat_peak_frequency")
SEAT_FACTOR = published_range("seat_factor_conventional")
"""Bands of the product's data file."""
_CAR_SEATS = "car seats with people: textbook values, of no single publication"
_SEAT_FACTORS = "conventional car seats with people, ISO 10326-1: usual values, of no single publication"
_CAR_MAPS = "pressure maps of car seats: usual values, of no single publication"
_ADULTS = "the same usual values, of adults of any size; nothing is published by percentile"
_OFFICE = (
    "BioMedical Engineering OnLine 2018: pressure mats on office chairs, 15 people, mean ± standard deviation: buttocks "
    "527 ± 64 cm², 8.1 ± 1.0 kPa, thighs 342 ± 95 cm², 3.5 ± 0.6 kPa; both together by propagation, as independent"
)
_ZONES = "Mergl 2006: zones of a car cushion that people find comfortable"
_FOAMS = "flexible polyurethane foams of seats, ISO 2439 and ISO 3386-1; usual values"
_TISSUE = "a body with tissue; none flows sideways from under a bone, so the trend of the peak is too steep"
_SMALL = "a small woman; the usual range is that of adults together"
_OFFICE_NOTE = "scene `office_chair` under 546 N: 40 mm of foam of 15 kPa, tissue by its measured thickness"
_PLATE = (
    "J. Phys. Ther. Sci. 29 (2017) 57: firm seat without cushion, 49 men of 69 kg; area of the group, for which seat is "
    "not said in what was read"
)
_PLATE_NOTE = "scene `plate`: tissue by its measured thickness"
_SPLIT = "split at 0.12 m before the tuberosities; that of the publication is not known"
_HARDNESS = "SAE 2019-01-5024: car cushions of 4 to 6.2 kPa hardness"
_PERSONS = {5: "5th percentile, woman", 50: "50th percentile, man", 95: "95th percentile, man"}


def _published(machine: str, source: str, quantity: str, unit: str, value: str, band: tuple[float, float],
               ours: Callable[[], float], *, fitted: bool = False, note: str = "") -> Published:  # fmt: skip
    return Published(machine=machine, quantity=quantity, unit=unit, value=value, band=band, source=source, ours=ours,
                     fitted=fitted, note=note)  # fmt: skip


def _by_percentile(percentile: int) -> Iterator[Published]:
    """Area and pressure of a small, medium or large person on the default cushion."""
    load = SEATED_MASS[percentile] * GRAVITY
    who = f"{_PERSONS[percentile]}, {load:.0f} N"
    yield _published("cushion", _ADULTS, f"loaded area, {who}", "cm²", "1000 to 1500", AREA,
                     lambda: sitting(load, percentile).area, note=_SMALL if percentile == 5 else "")  # fmt: skip
    yield _published("cushion", _ADULTS, f"mean pressure of the loaded area, {who}", "kPa", "3 to 8", MEAN_PRESSURE,
                     lambda: sitting(load, percentile).mean)  # fmt: skip
    yield _published("cushion", _ADULTS, f"largest pressure, {who}", "kPa", "8 to 20", PEAK_PRESSURE,
                     lambda: sitting(load, percentile).largest)  # fmt: skip


VALIDATION = [
    _published("seat", _CAR_SEATS, "peak of T(f), noise of 0.5 to 20 Hz, 1 m/s² rms", "Hz", "about 4", PEAK_FREQUENCY,
               lambda: _peak(1.0)[0],
               note=f"lines of 1/16 Hz, 0.1 Hz wide (Hann); {NOISES} noises of {LENGTH:g} s"),
    _published("seat", _CAR_SEATS, "T(f) at its peak, the same noise", "", "1.5 to 2.5", PEAK, lambda: _peak(1.0)[1],
               note="lines 0.4 Hz wide, those of the report, lower it by 4 %"),
    _published("seat", _CAR_SEATS, "frequency from which T(f) is below 1, the same noise", "Hz", "about 6", (4.2, 6.6),
               lambda: _isolates_from(1.0), note="band: √2 times that of the peak, as with one mode"),
    _published("seat", _SEAT_FACTORS, "SEAT, the same noise", "%", "60 to 90", SEAT_FACTOR,
               lambda: _seat_factor(_ride(1.0)),
               note="SEAT ranks seats (van Niekerk 2003: 16 car seats, R² 0.94 of estimated against measured); no value "
                    "holds for all floors"),
    _published("seat", _SEAT_FACTORS, "SEAT in the car, road of class B, 20 m/s", "%", "60 to 90", SEAT_FACTOR,
               lambda: _seat_factor(_densities("car_full_bench", "body_z", *ROAD))),
    _published("cushion", _CAR_MAPS, "loaded area, 50th percentile of shape, 498 N (`wei_griffin_2`)", "cm²", "1000 to 1500",
               AREA, lambda: sitting(LOAD).area, fitted=True),
    _published("cushion", _CAR_MAPS, "mean pressure of the loaded area, the same", "kPa", "3 to 8", MEAN_PRESSURE,
               lambda: sitting(LOAD).mean, fitted=True),
    _published("cushion", _CAR_MAPS, "largest pressure, the same", "kPa", "8 to 20", PEAK_PRESSURE, lambda: sitting(LOAD).largest),
    *(each for percentile in _PERSONS for each in _by_percentile(percentile)),
    _published("cushion", _FOAMS, "work lost in a slow loop up to 705 N", "%", "15 to 30", (15.0, 30.0), _slow_loop),
    _published("cushion", _FOAMS, "indentation force at 40 % over area times stress, 100 mm", "", "1.25 to 1.45",
               (1.25, 1.45), _indentation_ratio, fitted=True),
    _published("cushion", _ZONES, "load behind 0.12 m before the tuberosities", "%", "49 to 58", (49.0, 58.0),
               lambda: sitting(LOAD).share(-1.0, THIGHS_FROM),
               note="hips and buttocks together; the publication's zones end elsewhere"),
    _published("cushion", _ZONES, "load from 0.12 to 0.25 m", "%", "below 28", (0.0, 28.0),
               lambda: sitting(LOAD).share(THIGHS_FROM, FRONT_FROM),
               note="hips and buttocks as above"),
    _published("cushion", _ZONES, "load beyond 0.25 m", "%", "below 6", (0.0, 6.0),
               lambda: sitting(LOAD).share(FRONT_FROM, 1.0)),
    _published("cushion", _HARDNESS, "largest pressure by hardness", "kPa/kPa", "0.09", (0.03, 0.27),
               lambda: _change_with_hardness(largest=True), note=_TISSUE),
    _published("cushion", _HARDNESS, "mean pressure by hardness", "kPa/kPa", "0.04", (0.013, 0.12),
               lambda: _change_with_hardness(largest=False), note=_TISSUE),
    _published("office chair", _OFFICE, "area under buttocks and thighs", "cm²", "869 ± 115", (640.0, 1098.0),
               lambda: _office().area, note=_OFFICE_NOTE),
    _published("office chair", _OFFICE, "mean pressure under buttocks and thighs", "kPa", "6.3 ± 0.7", (4.8, 7.7),
               lambda: _office().mean, note=_OFFICE_NOTE),
    _published("office chair", _OFFICE, "largest pressure, under the buttocks", "kPa", "41 ± 12", (17.0, 65.0),
               lambda: _office().largest,
               note="no tissue flows sideways from under a bone"),
    _published("office chair", _OFFICE, "area under the thighs", "cm²", "342 ± 95", (152.0, 532.0),
               lambda: _office().between(THIGHS_FROM, 1.0).area, note=_SPLIT),
    _published("office chair", _OFFICE, "load of the buttocks", "%", "78 ± 6", (66.0, 91.0),
               lambda: _office().share(-1.0, THIGHS_FROM), note="split as above"),
    _published("hard plate", _PLATE, "loaded area, 600 N", "cm²", "830 ± 163", (667.0, 993.0),
               lambda: _plate().area, note=_PLATE_NOTE),
    _published("hard plate", _PLATE, "mean pressure of the loaded area, 600 N", "kPa", "7.5 ± 1.7", (5.8, 9.2),
               lambda: _plate().mean, note=_PLATE_NOTE),
]  # fmt: skip
