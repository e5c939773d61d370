"""What a shipped scene records, without a bag."""

from __future__ import annotations

from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_duration, set_value
from contact_sim_pkg.scene.resolve import resolve

__all__ = ["Message", "messages_of"]

Message = tuple[str, int, bytes]


def messages_of(scene_name: str, duration: float, *values: str) -> list[Message]:
    """Recorded messages of a shipped scene, `values` as of `--set`, without the wall times of `bench/cost`."""
    overrides = [set_duration(duration), *(set_value(value) for value in values)]
    scene = resolve(load_scene(scene_name, overrides))
    simulation, sources = make_simulation(scene), make_sources(scene)
    simulation.prepare()
    found: list[Message] = []
    for block in range(simulation.blocks):
        result = simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()})
        found += [message for message in result.messages if message[0] != "bench/cost"]
    return found
