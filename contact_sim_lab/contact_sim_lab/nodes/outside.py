"""A subscriber of its own process that follows a run on nodes, started as a user starts it."""

from __future__ import annotations

import subprocess
import tempfile
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import rclpy
from rclpy.node import Node

from contact_sim_pkg.nodes.processes.environment import set_default_environment
from contact_sim_pkg.nodes.processes.process import handle_messages, make_executor
from contact_sim_pkg.nodes.processes.scene_file import queue_depth
from contact_sim_pkg.nodes.protocol.endpoints import informed_subscription, raise_kept
from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["Callbacks", "follow_run"]

SETTLE_SECONDS = 1.0  # of the run, before the subscriber joins: it must not pass for the logger
GATHER_SECONDS = 0.01

Callbacks = Mapping[str, Callable[[bytes, dict[str, Any]], None]]
"""By topic: what is called with each message and what the middleware knows of it."""


def follow_run(
    name: str, scene: ResolvedScene, options: tuple[str, ...], callbacks: Callbacks,
    joined: Callable[[int], None] = lambda process: None,
) -> None:  # fmt: skip
    """Run a scene as `bench run` does, recorded, and follow it to its end.

    Args:
        name: name of the scene.
        scene: the same, resolved.
        options: of `bench run`.
        callbacks: called from one second after the first message recorded on.
        joined: called then with the number of the supervisor's process.

    Raises:
        ValueError: the run failed.
    """
    set_default_environment()
    rclpy.init(args=[])
    node = Node("outside", start_parameter_services=False, enable_rosout=False)
    try:
        with tempfile.TemporaryDirectory() as folder:
            bag = Path(folder) / "bag"
            command = python_command("contact_sim_pkg.cli.main", "run", name, *options)
            command += ["--allow-long", "--json", "--out", str(bag)]
            with subprocess.Popen(
                command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
            ) as process:
                while not bag.is_dir() and process.poll() is None:
                    time.sleep(GATHER_SECONDS)
                time.sleep(SETTLE_SECONDS)
                joined(process.pid)
                _follow(node, queue_depth(scene), callbacks, process)
                if process.returncode != 0:
                    lines = process.stderr.read().strip().splitlines() if process.stderr is not None else []
                    raise ValueError((lines or ["no reason given"])[-1])
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _follow(node: Node, depth: int, callbacks: Callbacks, process: subprocess.Popen[str]) -> None:
    """Follow a run that is under way until its process has ended."""
    executor = make_executor()
    executor.add_node(node)
    kept = [informed_subscription(node, topic, callback, depth) for topic, callback in callbacks.items()]
    while kept and process.poll() is None:
        handle_messages(executor, GATHER_SECONDS, GATHER_SECONDS)
        raise_kept(node)
