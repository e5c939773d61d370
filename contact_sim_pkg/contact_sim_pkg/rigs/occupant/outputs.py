"""Outputs of the seat back under an occupant who sits too; those of the seat are the vehicle rig's."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.laws.parameters import ElasticLaw
from contact_sim_pkg.pressure.mat import spread_force
from contact_sim_pkg.records.messages import ContactForce, ContactPoints
from contact_sim_pkg.rigs.backrest.model import Mat
from contact_sim_pkg.rigs.vehicle.model import Model
from contact_sim_pkg.rigs.vehicle.motion import columns
from contact_sim_pkg.rigs.vehicle.outputs import BlockRecord
from contact_sim_pkg.run.contact_laws import Cushion
from contact_sim_pkg.run.contact_patch import contact_patch
from contact_sim_pkg.run.outputs import BlockStamps, contact_outputs


class BackMap(NamedTuple):
    """Pressure map of the seat back: x up, y to the right of the occupant."""

    cells: tuple[float, float, float, float]  # [m] sizes of a cell along x and y, centre of cell (0, 0)
    pressure: Callable[[float, float], NDArray[numpy.float64]]  # approach [m], force [N] -> [rows, cols] [Pa]


def back_map(mat: Mat, law: ElasticLaw, cushion: Cushion | None) -> BackMap:
    """Map of a cushion, or of a point contact of this ``law`` on the cells of a ``mat``."""
    if cushion is not None:
        return BackMap(cushion.cells, cushion.pressure)
    area = mat.cell_x * mat.cell_y

    def pressure(approach: float, force: float) -> NDArray[numpy.float64]:
        return spread_force(force, approach, law, mat.gap, area)

    return BackMap((mat.cell_x, mat.cell_y, float(mat.x[0]), float(mat.y[0])), pressure)


def back_outputs(model: Model, shown: BackMap, record: BlockRecord) -> Iterator[Output]:
    """Force of the seat back on the trunk, along its normal, and its map and one point at the field
    rate.
    """
    stamps = BlockStamps(record.block, model.timing)
    normal, approach = record.forces[:, columns.BACK_NORMAL], record.forces[:, columns.BACK_APPROACH]
    none = numpy.zeros_like(normal)
    force = ContactForce(
        block=record.block, sample_period=stamps.period, normal=normal, tangential=none, approach=approach,
        effective_height=none,
    )  # fmt: skip
    patches = []
    for interval in range(model.timing.intervals):
        sample = interval * model.timing.segments // model.timing.sample_every
        pressure = shown.pressure(float(approach[sample]), float(normal[sample]))
        patches.append((sample, contact_patch(record.block, shown.cells, float(approach[sample]), pressure)))
        yield Output("backrest/points", stamps.at(sample), _point(record, sample))
    yield from contact_outputs("backrest", stamps, force, patches)


def _point(record: BlockRecord, sample: int) -> ContactPoints:
    """The whole contact as one point in the middle of the back."""
    one = numpy.zeros(1)
    normal = record.forces[sample : sample + 1, columns.BACK_NORMAL]
    touches = ContactPoints.TOUCHES if normal[0] > 0.0 else ContactPoints.APART
    return ContactPoints(
        block=record.block, x=one, y=one, approach=record.forces[sample : sample + 1, columns.BACK_APPROACH], normal=normal,
        tangential=one, displacement=one, state=numpy.array([touches], dtype=numpy.uint8),
    )  # fmt: skip
