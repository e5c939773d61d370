"""Which nodes a run of a scene has, and the parameters of each. Without ROS: the supervisor and the
launch file read it.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.run.bag_content import input_names
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

TOPICS_ALONE, INSIDE = EXCITATIONS = ("topics", "inside")
"""Where the simulator's blocks of excitation come from: from other nodes, or from itself."""
NODE_OF_INPUT = {"road/patch": "road_profile", "platform/vibration": "vibration"}


class PlannedNode(NamedTuple):
    """One node of a run."""

    name: str  # of the node, of its executable and of its module
    parameters: dict[str, str | bool]


def planned_nodes(
    scene: ResolvedScene,
    scene_path: Path,
    directory: Path | None,
    from_bag: Path | None = None,
    *,
    clock: bool = True,
    excitation: str = TOPICS_ALONE,
) -> list[PlannedNode]:
    """The nodes of a run, in the order of their start: the logger first, to be ended last, the
    simulator last.

    Args:
        scene: the scene.
        scene_path: what `write_scene` returned for it.
        directory: directory of the bag; None: nothing is recorded and there is no logger.
        from_bag: bag whose excitation is sent instead of the scene's own.
        clock: publish simulated time on `/clock`, unless somebody else does.
        excitation: one of `EXCITATIONS`.
    """
    common: dict[str, str | bool] = {"scene": str(scene_path)}
    record: dict[str, str | bool] = {"record": directory is not None}
    source: dict[str, str | bool] = {} if from_bag is None else {"from_bag": str(from_bag.absolute())}
    logger = [] if directory is None else [PlannedNode("bag_logger", {**common, "bag": str(directory.absolute())})]
    sources = [PlannedNode(NODE_OF_INPUT[topic], {**common, **record, **source}) for topic in input_names(scene)]
    if excitation == INSIDE:
        sources, record = [], {**record, "excitation": INSIDE}
    return [*logger, *sources, PlannedNode("contact_simulator", {**common, **record, "publish_clock": clock})]


def in_processes(nodes: list[PlannedNode]) -> list[PlannedNode]:
    """The processes in which a supervisor starts the nodes of a run: two excitation nodes, whose
    parameters are equal, share one.
    """
    sources = [node for node in nodes if node.name in NODE_OF_INPUT.values()]
    if len(sources) < len(NODE_OF_INPUT):
        return nodes
    shared = sources[0]._replace(name="excitation")
    return [shared if node is sources[0] else node for node in nodes if node not in sources[1:]]
