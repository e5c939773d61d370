"""Content of a scene's bag: its topics, and the texts kept with it. The same for the offline
run and the logger node.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from contact_sim_pkg.bag.metadata import SCENE_KEY, software_versions
from contact_sim_pkg.compiled.sources import digest_of_sources
from contact_sim_pkg.run.rigs import result_topics
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

EXCITATION_KEY = "excitation"
PUBLISHED_BY = "published by"
"""Key of the description of an excitation: full name of the node that published it"""
OWN_SOURCES = ("road_profile", "vibration", "contact_simulator", "bag_replay")
"""Nodes of the bench that publish excitation: what the scene says of it holds"""


def input_names(scene: ResolvedScene) -> list[str]:
    """Excitation topics that the scene calls for."""
    given = {name for name in ("road", "travel", "vibration") if scene.data.get(name) is not None}
    names = ["road/patch"] if given >= {"road", "travel"} else []
    return names + (["platform/vibration"] if "vibration" in given else [])


def result_names(scene: ResolvedScene) -> list[str]:
    """Recorded topics that the simulator publishes for the scene."""
    return result_topics(scene)


def recorded_names(scene: ResolvedScene) -> list[str]:
    """Every topic of the scene's bag."""
    return ["bench/scene", *input_names(scene), *result_names(scene)]


def attachments(scene: ResolvedScene, excitation: dict[str, dict[str, Any]]) -> dict[str, str]:
    """Texts for the bag: resolved scene, versions, and what each excitation found and did (JSON by
    topic).
    """
    return {
        SCENE_KEY: scene.to_yaml(),
        **software_versions(kernel_fingerprint()),
        EXCITATION_KEY: json.dumps(excitation, sort_keys=True),
    }


def described_by_publishers(
    descriptions: Mapping[str, dict[str, Any]], publishers: Mapping[str, str]
) -> dict[str, dict[str, Any]]:
    """The ``descriptions`` with who published each topic, by the full name of its node. Of a node that is none of the
    bench nothing else is known: what the scene says of the excitation did not act.
    """
    found = {topic: dict(description) for topic, description in descriptions.items()}
    for topic, node in publishers.items():
        if node.rpartition("/")[2] in OWN_SOURCES:
            found[topic] = {**found.get(topic, {}), PUBLISHED_BY: node}
        else:
            said = f"published by {node}, which is no node of the bench: the scene's own excitation did not act"
            found[topic] = {PUBLISHED_BY: node, "notes": [said]}
    return found


def kernel_fingerprint() -> str:
    """Name of the kernels' sources: what a result depends on beside the scene and the versions.
    Starts no compiler.
    """
    return digest_of_sources(Path(__file__).parents[1])[:20]
