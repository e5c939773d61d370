"""Published figures of seats and cushions, for `bench validation`."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.optimize import brentq

from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_energy, elastic_force
from contact_sim_pkg.laws.parameters import FoamElastic
from contact_sim_pkg.pressure.cushion.foam_layer import Compression, FoamGrid, FoamLayer
from contact_sim_pkg.pressure.cushion.sitter import PERCENTILES, pan_gap
from contact_sim_pkg.records.published import Published
from contact_sim_pkg.report.signal.spectrum import Transmissibility, transmissibility
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatCushion, SeatHysteresis
from contact_sim_pkg.run.contact_laws import foam_of
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.schema.laws import USUAL_REVERSAL

__all__ = ["VALIDATION"]

Field = NDArray[numpy.float64]
CELL = 0.01  # [m]
LOADED = 500.0  # [Pa] least pressure of a cell that counts as loaded
LOAD = 498.2  # [N] of 50.8 kg, the mass of `wei_griffin_2`
OFFICE_LOADS = (427.0, 119.0)  # [N] buttocks and thighs: area times mean pressure of the publication
THIGHS_FROM, FRONT_FROM = 0.12, 0.25  # [m] before the tuberosities
LOOP_LOAD = 705.0  # [N]
DISC_AREA = 0.0323  # [m^2] of the indenter of ISO 2439
NOISE = "vibration={{kind: noise, low: 0.5, high: 20, rms: {rms}}}"
LENGTH = 60.0  # [s] of a ride


class _Map(NamedTuple):
    """Pressure map of a person at rest."""

    x: Field  # [rows] [m] before the tuberosities
    pressure: Field  # [rows, cols] [Pa]

    @property
    def loaded(self) -> Field:
        """Pressures [Pa] of the loaded cells."""
        return self.pressure[self.pressure > LOADED]

    def share(self, first: float, last: float) -> float:
        """Part of the load in [%] between two distances [m] before the tuberosities."""
        inside = (self.x >= first) & (self.x < last)
        return float(100.0 * self.pressure[inside].sum() / self.pressure.sum())


@cache
def _sitting(load: float, thickness: float = 0.08, hardness: float | None = None) -> _Map:
    """Map of the 50th percentile under ``load`` [N] on the default foam, or on one of another
    ``thickness`` [m] and ``hardness`` [Pa].
    """
    x, y = (CELL * numpy.arange(first, last, dtype=numpy.float64) for first, last in ((-24.0, 48.0), (-31.5, 32.0)))
    foam = foam_of(SeatCushion(thickness=thickness, hardness=hardness))
    layer = FoamLayer(FoamGrid(len(x), len(y), CELL, CELL), foam, pan_gap(PERCENTILES[50], x, y))
    return _Map(x, _at_load(layer, load, foam.thickness).pressure)


def _at_load(layer: FoamLayer, load: float, thickness: float) -> Compression:
    approach = brentq(lambda place: layer.solve(place).force - load, 1e-4, 0.8 * thickness, xtol=1e-6)
    return layer.solve(float(approach))


def _default_hardness() -> float:
    """Stress [Pa] of the default foam at 40 % strain."""
    foam = foam_of(SeatCushion())._replace(area=1.0)
    return float(elastic_force(foam, 0.4 * foam.thickness))


def _change_with_hardness(largest: bool) -> float:
    """Change of the largest or mean pressure [Pa] for each Pa of hardness."""
    softer, harder = (_sitting(LOAD, hardness=_default_hardness() + step).loaded for step in (-500.0, 500.0))
    return float((harder.max() - softer.max() if largest else harder.mean() - softer.mean()) / 1000.0)


def _indentation_ratio() -> float:
    """Force of a disc of 323 cm^2 at 40 % over the stress of an even load times its area; 100 mm
    foam.
    """
    foam: FoamElastic = foam_of(SeatCushion(thickness=0.1))._replace(area=DISC_AREA)
    place = (numpy.arange(64) - 31.5) * 0.008
    distance = numpy.hypot(place[:, None], place[None, :])
    gap = numpy.where(distance <= numpy.sqrt(DISC_AREA / numpy.pi), 0.0, 1.0)
    disc = FoamLayer(FoamGrid(64, 64, 0.008, 0.008), foam, gap)
    touching = float((gap == 0.0).sum()) * 0.008**2
    return float(disc.solve(0.04).force / touching / (elastic_force(foam, 0.04) / DISC_AREA))


def _slow_loop() -> float:
    """Work lost in [%] between no load and 705 N and back, so slowly that no rate acts."""
    section, contact = SeatHysteresis(), build(load_resolved("seat_ride")).rig.seat_contact
    assert contact is not None
    stored = float(elastic_energy(contact.elastic, approach_of_force(contact.elastic, LOOP_LOAD)))
    scale = USUAL_REVERSAL
    # z = 1 - exp(-u/u0) on the way in, -1 + (1 + z_end) exp(-(U - u)/u0) on the way out
    passed = 1.0 - math.exp(-stored / scale)
    work_in = stored + section.share * (stored - scale * passed)
    work_out = stored + section.share * (scale * passed * (1.0 + passed) - stored)
    return 100.0 * (1.0 - work_out / work_in)


@cache
def _ride(rms: float) -> Transmissibility:
    """Seat frame over floor, 0.5 to 20 Hz of noise of ``rms`` [m/s^2]; default occupant and
    cushion.
    """
    motion = records_of(outputs_of("seat_ride", LENGTH, NOISE.format(rms=rms), "block_length=0.1"), "bench/motion")
    floor, seat = (
        numpy.concatenate([block.acceleration[block.bodies.index(name)] for block in motion])
        for name in ("floor_z", "seat_frame_z")
    )
    return transmissibility(floor, seat, 1.0 / motion[0].sample_period)


def _peak(rms: float) -> tuple[float, float]:
    """Frequency [Hz] and height of the peak of the transmissibility."""
    way = _ride(rms)
    trusted = (way.frequency > 1.0) & (way.frequency < 15.0) & (way.coherence > 0.9)
    place = numpy.flatnonzero(trusted)[way.magnitude[trusted].argmax()]
    return float(way.frequency[place]), float(way.magnitude[place])


def _at(frequency: float, rms: float) -> float:
    way = _ride(rms)
    return float(numpy.interp(frequency, way.frequency, way.magnitude))


def _office() -> _Map:
    """Map of an office chair under buttocks and thighs."""
    return _sitting(sum(OFFICE_LOADS), 0.04, 2.5 * _default_hardness())


_CAR_SEATS = "car seats with people: textbook values, of no single publication"
_CAR_MAPS = "pressure maps of car seats: usual values, of no single publication"
_OFFICE = "BioMedical Engineering OnLine 2018: pressure mats on office chairs, mean ± standard deviation"
_ZONES = "Mergl 2006: zones of a car cushion that people find comfortable"
_FOAMS = "flexible polyurethane foams of seats, ISO 2439 and ISO 3386-1; usual values"
_RIGID = "the form of the body is that under load; softer tissue would even out the pressure"
_OFFICE_NOTE = "40 mm of foam of 2.5 times the default's stress; buttocks and thighs in one map under 546 N"
_HARDNESS = "SAE 2019-01-5024: car cushions of 4 to 6.2 kPa hardness"


def _published(machine: str, source: str, quantity: str, unit: str, value: str, band: tuple[float, float],
               ours: Callable[[], float], *, fitted: bool = False, note: str = "") -> Published:  # fmt: skip
    return Published(machine=machine, quantity=quantity, unit=unit, value=value, band=band, source=source, ours=ours,
                     fitted=fitted, note=note)  # fmt: skip


VALIDATION = [
    _published("seat", _CAR_SEATS, "peak of T(f), noise of 0.5 to 20 Hz, 1 m/s² rms", "Hz", "about 4", (3.0, 4.7),
               lambda: _peak(1.0)[0]),
    _published("seat", _CAR_SEATS, "T(f) at its peak, the same noise", "", "1.5 to 2.5", (1.5, 2.5), lambda: _peak(1.0)[1]),
    _published("seat", _CAR_SEATS, "T(f) at 10 Hz, the same noise", "", "isolates above 6 Hz", (0.0, 1.0),
               lambda: _at(10.0, 1.0)),
    _published("cushion", _CAR_MAPS, "loaded area, 50th percentile, 498 N", "cm²", "1000 to 1500", (1000.0, 1500.0),
               lambda: 1e4 * CELL**2 * len(_sitting(LOAD).loaded), fitted=True),
    _published("cushion", _CAR_MAPS, "mean pressure of the loaded area", "kPa", "3 to 8", (3.0, 8.0),
               lambda: 1e-3 * float(_sitting(LOAD).loaded.mean()), fitted=True),
    _published("cushion", _CAR_MAPS, "largest pressure", "kPa", "8 to 20", (8.0, 20.0),
               lambda: 1e-3 * float(_sitting(LOAD).pressure.max())),
    _published("cushion", _FOAMS, "work lost in a slow loop up to 705 N", "%", "15 to 30", (15.0, 30.0), _slow_loop),
    _published("cushion", _FOAMS, "indentation force at 40 % over area times stress, 100 mm", "", "1.25 to 1.45",
               (1.25, 1.45), _indentation_ratio, fitted=True),
    _published("cushion", _ZONES, "load behind 0.12 m before the tuberosities", "%", "49 to 58", (49.0, 58.0),
               lambda: _sitting(LOAD).share(-1.0, THIGHS_FROM),
               note="hips and buttocks together; the publication's zones end elsewhere"),
    _published("cushion", _ZONES, "load from 0.12 to 0.25 m", "%", "below 28", (0.0, 28.0),
               lambda: _sitting(LOAD).share(THIGHS_FROM, FRONT_FROM)),
    _published("cushion", _ZONES, "load beyond 0.25 m", "%", "below 6", (0.0, 6.0),
               lambda: _sitting(LOAD).share(FRONT_FROM, 1.0)),
    _published("cushion", _HARDNESS, "largest pressure by hardness", "kPa/kPa", "0.09", (0.03, 0.27),
               lambda: _change_with_hardness(largest=True), note=_RIGID),
    _published("cushion", _HARDNESS, "mean pressure by hardness", "kPa/kPa", "0.04", (0.013, 0.12),
               lambda: _change_with_hardness(largest=False), note=_RIGID),
    _published("office chair", _OFFICE, "area under the buttocks", "cm²", "527 ± 64", (399.0, 655.0),
               lambda: 1e4 * CELL**2 * len(_office().loaded), note=_OFFICE_NOTE),
    _published("office chair", _OFFICE, "mean pressure under the buttocks", "kPa", "8.1 ± 1.0", (6.1, 10.1),
               lambda: 1e-3 * float(_office().loaded.mean())),
    _published("office chair", _OFFICE, "largest pressure", "kPa", "41 ± 12", (17.0, 65.0),
               lambda: 1e-3 * float(_office().pressure.max())),
]  # fmt: skip
