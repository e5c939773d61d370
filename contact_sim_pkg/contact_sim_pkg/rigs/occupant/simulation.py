"""The simulation of an occupant on a seat and against its back, block by block."""

from __future__ import annotations

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.rigs.backrest.model import mat_of
from contact_sim_pkg.rigs.backrest.schema import BackrestSection
from contact_sim_pkg.rigs.occupant.model import back_cushion, build_occupant
from contact_sim_pkg.rigs.occupant.outputs import back_map, back_outputs
from contact_sim_pkg.rigs.vehicle.outputs import BlockRecord
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


class OccupantSimulation(Simulation):
    """The simulation of the seat, whose occupant leans on a seat back."""

    def __init__(self, scene: ResolvedScene) -> None:
        """Build the parameters of a resolved scene."""
        cushion = back_cushion(scene)
        super().__init__(scene, build_occupant(scene, cushion))
        assert self.model.rig.back is not None
        self._map = back_map(mat_of(scene.section(BackrestSection)), self.model.rig.back.contact.elastic, cushion)

    def _outputs(self, record: BlockRecord, began: float) -> list[Output]:
        return [*back_outputs(self.model, self._map, record), *super()._outputs(record, began)]
