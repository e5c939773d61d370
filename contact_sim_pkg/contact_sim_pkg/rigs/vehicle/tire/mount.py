"""The motion that a test machine gives to the axle, over time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.vehicle.motion.spring import Spring
from contact_sim_pkg.rigs.vehicle.tire.force_table import TireTable
from contact_sim_pkg.rigs.vehicle.tire.mount_section import MountSection
from contact_sim_pkg.rigs.vehicle.tire.schema import TireSection
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.schema.catalog import show_below

__all__ = ["Mounted", "mounted", "refuse_beyond_law"]


@dataclass(frozen=True)
class Mounted:
    """A machine that keeps a load, or the height of the axle: then its table moves up where the axle is to be lowered."""

    times: Vector  # [rows] [s] of what it keeps
    load: Vector | None  # [rows] [N] of the servo; None: held in height
    deflection: Vector | None  # [rows] [m] of a held axle; None: that of `start` all the time
    start: float  # [N] load under which it stands at the start; of a deflection that is given it is nominal
    damping: float  # [N s/m] of the slide

    @property
    def largest(self) -> float:
        """[N] of the loads; of a deflection the nominal one."""
        return self.start if self.load is None else float(self.load.max())

    @property
    def is_held(self) -> bool:
        """Whether the axle is held in height."""
        return self.load is None

    def acceleration(self, times: Vector, mass: float, wheel: float, gravity: float) -> Vector:
        """[m/s^2] that the servo gives to the ``wheel`` [kg] at ``times`` [s], so that the road carries the load beside
        the weight of the whole ``mass`` [kg].
        """
        if self.load is None:
            return numpy.zeros(len(times))
        return (mass * gravity - numpy.interp(times, self.times, self.load)) / wheel

    def table(self, times: Vector, step: float) -> tuple[Vector, Vector]:
        """Height [m] of the table at ``times`` [s], and its rate [m/s] over a ``step`` [s] to both sides."""
        if self.deflection is None:
            return numpy.zeros(len(times)), numpy.zeros(len(times))
        before, here, behind = (numpy.interp(times + side, self.times, self.deflection) for side in (-step, 0.0, step))
        return here, (behind - before) / (2.0 * step)


def mounted(tire: TireSection) -> Mounted | None:
    """The machine of a resolved scene's tire; None on a quarter car."""
    mount: MountSection | None = tire.mount
    if mount is None or mount.kind == "quarter_car":
        return None
    assert mount.load is not None
    programme = tire.programme
    times = [0.0] if programme is None else programme.time
    load, deflection = (None, None) if programme is None else (programme.load, programme.deflection)
    if load is None and deflection is None:
        times = [0.0]
    if mount.control == "height":
        if deflection is None and mount.deflection is not None:
            deflection = [mount.deflection]
        held = None if deflection is None else numpy.array(deflection, dtype=numpy.float64)
        return Mounted(numpy.array(times, dtype=numpy.float64), None, held, mount.load, 0.0)
    kept = numpy.array([mount.load] if load is None else load, dtype=numpy.float64)
    assert mount.slide_damping is not None
    return Mounted(numpy.array(times, dtype=numpy.float64), kept, None, float(kept[0]), mount.slide_damping)


def refuse_beyond_law(machine: Mounted, tire: TireSection, table: TireTable, sidewalls: Spring | None) -> None:
    """SceneError where a machine runs an inflated tire beyond its force ``table``, by the first row that does."""
    force = float(table.force[-1])
    deepest = (len(table.force) - 1) * table.spacing + (0.0 if sidewalls is None else force / sidewalls.stiffness)
    for name, values, most, unit in (
        ("load", machine.load, force, "N"),
        ("deflection", machine.deflection, deepest, "m"),
    ):
        if values is None or not (beyond := numpy.flatnonzero(values > most)).size:
            continue
        programme, row = tire.programme, int(beyond[0])
        by_programme = programme is not None and getattr(programme, name) is not None
        where = f"tire.programme.{name}.{row}" if by_programme else f"tire.mount.{name}"
        when = f" at {machine.times[row]:g} s" if by_programme else ""
        sentence = (
            f"{values[row]:g} {unit}{when} is beyond the law, which ends at {show_below(most, 5)} {unit} with this inflation; take "
            "less, or more effects.tire.inflation.pressure"
        )
        raise SceneError([Fault("scene", 0, 0, where, sentence)])
    if machine.load is None and machine.deflection is None and machine.start > force:
        sentence = f"{machine.start:g} N is beyond the law, which ends at {show_below(force, 5)} N with this inflation; take less"
        raise SceneError([Fault("scene", 0, 0, "tire.mount.load", sentence)])
