"""Rolling resistance of a tire whose pressure field is taken as elastic: what its rubber loses under the
standing footprint that rolls along.

A pressure that moves at V works on each wave k of the rubber with the frequency k V. With the memory
``M = 1 + i w T + sum r_k i w t_k / (1 + i w t_k)`` of a modulus at w = k V the loss a metre, a force, is

* of the tread, a half-space ``u = 2 p / (E* |k|)``: ``- sum over waves of k_x Im[2 / (E* |k| M)] |p_k|^2 / area``;
* of belt and sidewalls: ``- sum over n >= 2 of (n / R) Im[1 / (D_n + (M - 1) V_n)] |q_n|^2 / (pi R)``, D_n and V_n
  as in `inflated_belt.py` and `tread_viscoelasticity.py`, q the line load of the road and what the sidewalls leave
  to the belt.

The footprint is that of a tire as stiff as it rolls: with the storage modulus, the real part of M, at the
frequency of a usual one. First order in what is left: the field of a viscoelastic tread also leans
forward. Valid for steady rolling on level ground; a pressure that changes faster than it rolls through its
length has no loss of its own. Real tires warm up and lose less: the numbers are those of a tire at its
usual temperature. Sources: Johnson, Contact Mechanics, 9.5 (rolling of viscoelastic bodies); Pacejka, Tire
and Vehicle Dynamics, 4.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.pressure.kept_arrays import kept_arrays
from contact_sim_pkg.pressure.settings import InflatedBelt
from contact_sim_pkg.rigs.vehicle.field import inflated_belt, sidewalls
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import ring_modes, stiffened
from contact_sim_pkg.rigs.vehicle.field.sidewalls import Softening
from contact_sim_pkg.rigs.vehicle.tire import force_table
from contact_sim_pkg.rigs.vehicle.tire.body import TireBody
from contact_sim_pkg.rigs.vehicle.tire.force_table import MAP_EVERY, tire_table
from contact_sim_pkg.rigs.vehicle.tire.parameters import TreadViscoelasticity

__all__ = ["RollingLoss", "rolling_loss", "whole_footprint"]

Field = NDArray[numpy.float64]
SPEEDS = numpy.array([0.0, *numpy.geomspace(0.5, 100.0, 16)])  # [m/s]
PADDED = 256  # cells of the transform: twice the longest footprint and more
USUAL_FREQUENCY = 1e3  # [rad/s] of a footprint of 0.13 m at 20 m/s
WAVES = 200  # of the ring
PASSES = 30  # of the sidewalls


class RollingLoss(NamedTuple):
    """Forces [N] at ``load`` [N] and ``speed`` [m/s]."""

    load: Field  # [loads], increasing from 0
    speed: Field  # [speeds], increasing from 0
    force: Field  # [loads, speeds]

    def along(self, load: Field, speed: float) -> Field:
        """Force [N] against the travel under each ``load`` [N], at a signed ``speed`` [m/s] of the wheel; linear in
        both between the entries, beyond the last as there.
        """
        at_speed = numpy.array([numpy.interp(abs(speed), self.speed, row) for row in self.force])
        return numpy.asarray(math.copysign(1.0, speed) * numpy.interp(load, self.load, at_speed))


def rolling_loss(body: TireBody, tread: TreadViscoelasticity, of_belt: float) -> RollingLoss:
    """The losses of a ``body``, an inflated tire, kept on disk; ``of_belt``: memory of belt and sidewalls over that
    of the ``tread``.
    """
    memory = tread.retardation_time, tread.ratios.tolist(), tread.times.tolist(), of_belt
    sources = [__file__, inflated_belt.__file__, sidewalls.__file__, force_table.__file__]
    arrays = kept_arrays("rolling", repr((body, memory)), sources, lambda: _make(body, tread, of_belt)._asdict())
    return RollingLoss(**arrays)


def _make(body: TireBody, tread: TreadViscoelasticity, of_belt: float) -> RollingLoss:
    belt = body.belt
    assert isinstance(belt, InflatedBelt)
    stores = float(_memory(tread, numpy.array(USUAL_FREQUENCY)).real)
    rolling = stiffened(belt, 1.0 + of_belt * stores)
    table = tire_table(body._replace(modulus=(1.0 + stores) * body.modulus, belt=rolling))
    softening = None if belt.arc is None else Softening(rolling, 2 * table.quarters.shape[1], float(table.cell[0]))
    loads, rows = [0.0], [numpy.zeros(len(SPEEDS))]
    for number in range(1, len(table.quarters)):
        pressure = whole_footprint(table.quarters[number].astype(numpy.float64))
        loads.append(float(table.force[number * MAP_EVERY]))
        rows.append(
            _lost_in_tread(pressure, table.cell, body.modulus, tread)
            + _lost_in_belt(pressure, table.cell, belt, softening, tread, of_belt)
        )
    return RollingLoss(numpy.array(loads), SPEEDS, numpy.array(rows))


def whole_footprint(quarter: Field) -> Field:
    """The footprint of its quarter x, y >= 0, whose row 0 lies under the axle."""
    half = numpy.concatenate((quarter[:0:-1], quarter))
    return numpy.concatenate((half[:, ::-1], half), axis=1)


def _memory(tread: TreadViscoelasticity, frequency: Field) -> Field:
    """M - 1, complex, at angular frequencies [rad/s]."""
    turned = 1j * frequency[..., None] * tread.times
    return numpy.asarray(
        1j * frequency * tread.retardation_time + (tread.ratios * turned / (1.0 + turned)).sum(axis=-1)
    )


def _lost_in_tread(pressure: Field, cell: Field, modulus: float, tread: TreadViscoelasticity) -> Field:
    """Force [N] at `SPEEDS`."""
    rows, cols = (max(PADDED, 2 * count) for count in pressure.shape)
    waves = abs(numpy.fft.fft2(pressure, (rows, cols)) * cell.prod()) ** 2
    along, across = (2.0 * math.pi * numpy.fft.fftfreq(n, size) for n, size in zip((rows, cols), cell, strict=True))
    size = numpy.hypot(along[:, None], across)
    size[0, 0] = 1.0  # does not move
    elastic = (2.0 * waves / (modulus * size)).sum(axis=1) / (rows * cols * cell.prod())
    frequency = SPEEDS[:, None] * along
    return numpy.asarray(-(along * (1.0 / (1.0 + _memory(tread, frequency))).imag * elastic).sum(axis=1))


def _lost_in_belt(
    pressure: Field, cell: Field, belt: InflatedBelt, softening: Softening | None, tread: TreadViscoelasticity, of_belt: float
) -> Field:  # fmt: skip
    """Force [N] at `SPEEDS`."""
    line = pressure.sum(axis=1) * float(cell[1])
    place = (numpy.arange(len(line)) - len(line) // 2) * float(cell[0])
    if softening is not None:
        softening.start()
        for _pass in range(PASSES):
            softening.follow(pressure, float(cell[1]))
        line = softening.load.copy()
        line[softening.rows(len(pressure))] += pressure.sum(axis=1) * float(cell[1])
        place = (numpy.arange(len(line)) - len(line) // 2) * float(cell[0])
    n = numpy.arange(2, WAVES + 1, dtype=numpy.float64)
    rigidity, rubber = ring_modes(belt, n)
    force = abs(numpy.exp(-1j * numpy.outer(n / belt.radius, place)) @ line * float(cell[0])) ** 2
    frequency = SPEEDS[:, None] * n / belt.radius
    compliance = 1.0 / (rigidity + of_belt * _memory(tread, frequency) * rubber)
    return numpy.asarray(-(n / belt.radius * compliance.imag * force).sum(axis=1) / (math.pi * belt.radius))
