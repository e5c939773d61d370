"""A recorded run as the comparison reads it: its scene, its judged outputs, its costs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import record_of
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.compare.columns import judged_topics
from contact_sim_pkg.records import messages
from contact_sim_pkg.records.messages import SolverCost
from contact_sim_pkg.run.rigs import result_topics
from contact_sim_pkg.scene.files import find_file
from contact_sim_pkg.scene.resolve import read_explicit
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["costs_of_bag", "outputs_of_bag", "scene_of_bag"]


def scene_of_bag(path: Path) -> ResolvedScene:
    """The resolved scene of a bag, its input files looked for from the current folder and in the
    package.

    Raises BagError where it holds none.
    """
    text = open_bag(path).scene
    if text is None:
        raise BagError(f"{path} holds no scene, so it cannot be run again finer")
    data = read_explicit(text, f"scene of {path}")
    named = {f"{section}.file": (data.get(section) or {}).get("file") for section in ("road", "vibration")}
    found = {where: find_file(name, Path()) for where, name in named.items() if name}
    return ResolvedScene(data, {where: place for where, place in found.items() if place is not None})


def outputs_of_bag(path: Path, scene: ResolvedScene) -> list[Output]:
    """Records of the topics with judged columns, in the order of the file."""
    bag = open_bag(path)
    found = []
    for topic in judged_topics(result_topics(scene)):
        if topic in bag:
            bag.refuse_other_definition(topic)
            found += _outputs(bag, topic)
    return found


def costs_of_bag(path: Path) -> list[SolverCost]:
    """Costs of the blocks that a bag holds."""
    bag = open_bag(path)
    return [record_of(SolverCost, message) for _, message in bag.decoded("bench/cost")] if "bench/cost" in bag else []


def _outputs(bag: Bag, topic: str) -> list[Output]:
    kind = getattr(messages, TOPICS[topic].type.rpartition("/")[2])
    return [Output(topic, _stamp(message), record_of(kind, message)) for _, message in bag.decoded(topic)]


def _stamp(message: Any) -> int:
    stamp = message.header.stamp
    return int(stamp.sec * SECOND + stamp.nanosec)
