"""Rigid body on the ground with friction. Rig block."""

from contact_sim_pkg.records.rig import Rig

__all__ = ["RIGS"]

RIGS = (
    Rig(
        name="block",
        contacts=("block",),
        takes=("block",),
        simulation=f"{__name__}.simulation:BlockBodySimulation",
        topics=lambda _scene: [f"block/{name}" for name in ("force", "wrench", "points")],
        report=(f"{__name__}.report:BLOCK_REPORT",),
    ),
)
