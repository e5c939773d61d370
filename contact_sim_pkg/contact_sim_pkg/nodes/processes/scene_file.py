"""The scene as it is handed to a node: resolved once by the supervisor, read back by every node."""

from __future__ import annotations

import json
import math
import os
from contextlib import suppress
from pathlib import Path
from typing import Any

from contact_sim_pkg.nodes.processes.run_folder import join
from contact_sim_pkg.nodes.protocol.window import AHEAD
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

RESOLVED = ".resolved.yaml"  # ending of a scene that needs no resolving; its input files stand in the file below
FILES = ".files.json"
DESCRIPTION = ".excitation.json"
REASON = ".reason.json"


def write_scene(scene: ResolvedScene, folder: Path) -> Path:
    """Write a resolved scene, and where its input files are; returns what a node is given as its
    scene.
    """
    path = folder / f"scene{RESOLVED}"
    path.write_text(scene.to_yaml(), encoding="utf-8")
    _write_beside(path, FILES, {where: str(file) for where, file in scene.files.items()})
    return path


def read_scene(scene: str) -> ResolvedScene:
    """The resolved scene behind a node's parameter.

    Args:
        scene: what `write_scene` returned, or the name of a shipped scene, or the path of a scene
        file.

    Raises:
        SceneError: the scene is faulty or not there.
    """
    if scene.endswith(RESOLVED):
        path = Path(scene)
        join(path.parent)
        files = json.loads(_beside(path, FILES).read_text(encoding="utf-8"))
        return ResolvedScene.from_own_yaml(path.read_text(encoding="utf-8"), files)
    from contact_sim_pkg.scene.load import load_scene
    from contact_sim_pkg.scene.resolve import resolve

    return resolve(load_scene(scene))


def write_description(scene: str, topic: str, description: dict[str, Any]) -> None:
    """Leave what an excitation found and did beside a scene of the supervisor, for the logger."""
    if scene.endswith(RESOLVED):
        _write_beside(Path(scene), f".{topic.replace('/', '_')}{DESCRIPTION}", {topic: description})


def read_descriptions(scene: str, resolved: ResolvedScene) -> dict[str, dict[str, Any]]:
    """Description of each excitation: as its node wrote it, or determined here where there is no
    supervisor.
    """
    if scene.endswith(RESOLVED):
        return descriptions_beside(Path(scene))
    from contact_sim_pkg.run.sources import make_sources

    return {topic: source.describe() for topic, source in make_sources(resolved).items()}


def descriptions_beside(scene: Path) -> dict[str, dict[str, Any]]:
    """Descriptions of the excitation nodes beside a scene of the supervisor, by topic."""
    found: dict[str, dict[str, Any]] = {}
    for path in sorted(scene.parent.glob(f"*{DESCRIPTION}")):
        found.update(json.loads(path.read_text(encoding="utf-8")))
    return found


def write_reason(scene: str | Path, reason: str) -> None:
    """Leave why a run ends early beside a scene of the supervisor, for the logger, before the nodes
    are asked to end.

    The first reason stays: a process that fails takes others with it. Nothing where there is no
    supervisor.
    """
    if str(scene).endswith(RESOLVED):
        with suppress(OSError):
            _write_beside(Path(scene), REASON, {"reason": reason}, only_first=True)


def read_reason(scene: str) -> str:
    """Why the supervisor ends the run; empty where it does not, or where there is none."""
    if not scene.endswith(RESOLVED):
        return ""
    try:
        return str(json.loads(_beside(Path(scene), REASON).read_text(encoding="utf-8"))["reason"])
    except OSError:
        return ""


def queue_depth(scene: ResolvedScene) -> int:
    """Depth for the messages of a topic in two windows of blocks."""
    highest = max(scene.outputs.field_rate, scene.outputs.display_rate)
    return 2 * AHEAD * math.ceil(highest * scene.block_length)


def _beside(path: Path, ending: str) -> Path:
    return path.with_name(path.name.removesuffix(RESOLVED) + ending)


def _write_beside(path: Path, ending: str, content: dict[str, Any], *, only_first: bool = False) -> None:
    """In one go: a reader finds the whole file or none. `only_first`: FileExistsError where there
    is one.
    """
    part = _beside(path, f"{ending}.{os.getpid()}.part")
    part.write_text(json.dumps(content), encoding="utf-8")
    if only_first:
        _beside(path, ending).hardlink_to(part)
        part.unlink()
    else:
        part.replace(_beside(path, ending))
