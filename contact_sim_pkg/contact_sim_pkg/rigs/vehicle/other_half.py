"""Kernels that a second process compiles while the first compiles those of the pressure fields."""

from __future__ import annotations

import numpy

from contact_sim_pkg.compiled.held import hold
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace
from contact_sim_pkg.pressure.field.solver import CONVERGED, FieldResult
from contact_sim_pkg.pressure.field.window import make_part
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection

STIFFNESS = 1e6  # [N/m]; the kernels do not depend on it


def compile_all_but_fields(scene: ResolvedScene) -> None:
    """Prepare a run of the scene on springs in place of its pressure fields, where it has any."""
    if all(scene.effect(contact, PressureFieldSection) is None for contact in ("tire", "seat")):
        return
    Simulation(scene, build(scene, solver=_Spring)).prepare()


class _Spring:
    """A `RollingField` whose load is proportional to the overlap, evenly over the touching cells."""

    def __init__(self, half_space: HalfSpace) -> None:
        self._cell = half_space.cell_x * half_space.cell_y
        self.whole = hold(make_part(half_space, half_space.rows, half_space.cols))
        self.pressure: Field = numpy.zeros((half_space.rows, half_space.cols))

    def reset(self) -> None:
        pass

    def roll(self, cells: int) -> None:
        pass

    def solve_at_load(self, gap: Field, load: float, _tolerance: float, _max_iterations: int) -> FieldResult:
        return self.solve_at_approach(gap, float(gap.min()) + load / STIFFNESS, 0.0, 0)

    def solve_at_approach(self, gap: Field, approach: float, _tolerance: float, _max_iterations: int) -> FieldResult:
        load = STIFFNESS * max(0.0, approach - float(gap.min()))
        touching = gap <= approach
        self.pressure[:] = numpy.where(touching, load / (max(1, touching.sum()) * self._cell), 0.0)
        return FieldResult(CONVERGED, 0, load, approach, 0.0)
