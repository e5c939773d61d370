"""The life of a node's process: start, spin, signals, end. Exit status 0 on every signal, no
traceback.
"""

from __future__ import annotations

import atexit
import gc
import os
import signal
import threading
import time
import traceback
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Protocol

import rclpy
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import Executor, ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.logging import get_logger
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future

from contact_sim_pkg.files import RefusedError
from contact_sim_pkg.nodes.parameters import refuse_misspelt
from contact_sim_pkg.nodes.processes.run_folder import leave
from contact_sim_pkg.nodes.processes.scene_file import write_reason
from contact_sim_pkg.nodes.protocol.endpoints import raise_kept
from contact_sim_pkg.nodes.protocol.states import FAULT, REFUSED, NodeError
from contact_sim_pkg.requirements import package_sentence
from contact_sim_pkg.run.errors import RunError

LONGEST_WAIT = 0.05  # [s] between two looks at signals and at the parent
ANSWER_SECONDS = 0.5  # from a signal to the node's reaction; compiled code receives no signal
_NEVER = Future()  # a future that is never done


class Interrupted(BaseException):
    """A signal during the set-up of the node."""


class BenchNode(Protocol):
    """Interface of a node for `run`, beside that of rclpy."""

    exit_status: int | None  # set when the process shall end
    scene_name: str  # of the run that it takes part in, as `read_scene` takes it; empty: of none
    gather: float  # [s] between two batches of messages; 0 handles each message at once
    computes: bool  # the others make way for this node's thread

    def start(self) -> None:
        """The slow part of the set-up: compile, open; a signal may break it off."""

    def tick(self, now: float) -> float:
        """Work that no message triggers; `now` is the steady clock, [s]. Returns the longest wait,
        [s].
        """

    def stop(self) -> None:
        """The user wants the end: begin to end cleanly."""

    def fault(self, sentence: str, exit_status: int) -> None:
        """Log a failure, close what is open, set the exit status."""

    def abandon(self) -> bool:
        """From another thread: end the run if this node computes right now; whether it did. For
        nodes that compute.
        """


class StopSignals:
    """SIGINT, SIGTERM and SIGHUP: a count that the spinning loop looks at."""

    def __init__(self) -> None:
        """Take the three signals over."""
        self.count = 0
        self.breaks_off = True  # a signal ends the set-up at once; later the node ends by itself
        self.answered = 0  # signals that the node has reacted to
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, self._on_signal)

    def _on_signal(self, number: int, frame: Any) -> None:
        self.count += 1
        if self.breaks_off:
            self.breaks_off, self.answered = False, self.count
            raise Interrupted

    def leave_what_computes(self, node: Any) -> None:
        """From now on a node that computes on behind a signal is ended by a thread of its own, in
        good order.
        """
        reading, writing = os.pipe()
        os.set_blocking(writing, False)
        signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
        threading.Thread(target=self._watch, args=(reading, node), daemon=True).start()

    def _watch(self, reading: int, node: Any) -> None:
        while os.read(reading, 1):
            time.sleep(ANSWER_SECONDS)
            if self.answered == self.count > 0:
                continue
            if node.abandon():
                leave()
                os._exit(0)


def make_executor() -> Executor:
    """The executor with the least cost per message (8 times less); the plain one where rclpy does
    not have it.
    """
    try:
        from rclpy.experimental import EventsExecutor
    except ImportError:
        return SingleThreadedExecutor()
    return EventsExecutor()


def handle_messages(executor: Executor, wait: float, gather: float = 0.0) -> None:
    """Run the callbacks of received messages.

    A process that handles several messages at a time is woken less often, which leaves the cores to
    the simulation.

    Args:
        executor: as `make_executor` returns it.
        wait: longest wait for a message, [s].
        gather: where above 0, sleep for that long, [s], and then handle every message received,
            without waiting for more.
    """
    plain = isinstance(executor, SingleThreadedExecutor)
    if gather > 0.0 and not plain:
        time.sleep(min(wait, gather))
    else:
        executor.spin_once(timeout_sec=wait)
    if not plain:
        executor.spin_until_future_complete(_NEVER, timeout_sec=0.0)  # all that is queued, where `spin_once` takes one


def use_batch_policy() -> None:
    """Keep this thread, and those it starts, from interrupting another one when they wake.

    DDS wakes threads some 20 times a block. Under the usual policy each of them interrupts the
    simulation where both cores are busy. A policy that the caller chose is kept.
    """
    _change_policy(0, os.SCHED_OTHER, os.SCHED_BATCH)


def use_usual_policy(*, everywhere: bool = False) -> None:
    """Return this thread, not those it has started, to the usual policy; `everywhere`: every thread
    of the process, whose messages then wait for no other program's turn (3 to 5 ms).
    """
    threads = [int(entry.name) for entry in Path("/proc/self/task").iterdir()] if everywhere else [0]
    for thread in threads:
        _change_policy(thread, os.SCHED_BATCH, os.SCHED_OTHER)


def _change_policy(thread: int, usual: int, wanted: int) -> None:
    with suppress(OSError):  # a system that forbids it runs a little slower
        if os.sched_getscheduler(thread) == usual:
            os.sched_setscheduler(thread, wanted, os.sched_param(0))


def run(*make_nodes: Callable[[], Any], args: Sequence[str] | None = None) -> int:
    """Run nodes, usually one, until they end or a signal comes; returns the exit status of the
    process.
    """
    atexit.register(gc.freeze)  # the process ends without looking through every object
    signals = StopSignals()
    nodes: list[Any] = []
    node: Any = None
    try:
        use_batch_policy()
        _init(args)
        for make_node in make_nodes:
            node = None
            node = make_node()
            nodes.append(node)
            if node.computes:
                signals.leave_what_computes(node)
                use_usual_policy()
            refuse_misspelt(node)
            node.start()
        signals.breaks_off = False
        return _spin(nodes, signals)
    except Interrupted:
        return 0
    except NodeError as error:
        _log_fatal(node, str(error))
        return error.exit_status
    except (
        RefusedError,
        ParameterException,
        NameValidationException,
    ) as error:  # the last two: rclpy's own parameters and names
        _log_fatal(node, " ".join(str(error).split()))
        return REFUSED
    except (ExternalShutdownException, rclpy_implementation.RCLError):
        if rclpy.ok():
            raise
        return 0
    finally:
        signals.breaks_off = False
        for node in nodes:
            node.destroy_node()
        rclpy.try_shutdown()
        if nodes and _orphaned(nodes[0].supervisor):
            leave()


def _init(args: Sequence[str] | None) -> None:
    """Start rclpy; NodeError (refused) where it cannot read the arguments after `--ros-args`."""
    try:
        rclpy.init(args=None if args is None else list(args), signal_handler_options=SignalHandlerOptions.NO)
    except (rclpy_implementation.RCLError, rclpy_implementation.UnknownROSArgsError) as error:
        reason = str(error).partition(", at /")[0].removeprefix("failed to initialize rcl: ")
        raise NodeError(f"the arguments after --ros-args cannot be read: {reason}", REFUSED) from None


def _spin(nodes: Sequence[Any], signals: StopSignals) -> int:
    executor = make_executor()
    for node in nodes:
        executor.add_node(node)
    supervisor, seen = nodes[0].supervisor, 0
    while _run_on(nodes):
        wait = min(LONGEST_WAIT, *(_guarded(node, node.tick, time.monotonic()) for node in nodes))
        if _run_on(nodes):
            handle_messages(executor, wait, min(node.gather for node in nodes))
            for node in nodes:
                _guarded(node, raise_kept, node)
        orphaned = _orphaned(supervisor)
        if orphaned:
            write_reason(nodes[0].scene_name, f"bench run (process {supervisor}), which watched the nodes, is gone")
        if signals.count > seen or orphaned:
            seen, supervisor = signals.count, 0 if orphaned else supervisor
            signals.answered = seen
            for node in nodes:
                node.stop()
    return next((node.exit_status for node in nodes if node.exit_status), 0)


def _guarded(node: Any, action: Callable[..., Any], *arguments: Any) -> Any:
    """Result of an action of a node; 0 where it failed: the node then ends, or ends its run."""
    try:
        return action(*arguments)
    except (NodeError, RunError, RefusedError) as error:
        node.fault(str(error), getattr(error, "exit_status", FAULT))
    except (ExternalShutdownException, rclpy_implementation.RCLError):
        raise
    except Exception as error:  # noqa: BLE001  # the boundary of a node: named once, the bag closed
        end_unexpectedly(node, error)
    return 0.0


def end_unexpectedly(node: Any, error: Exception) -> None:
    """End a node for an error that no one has foreseen, with its traceback; for a package that is missing or too old,
    with its sentence.
    """
    if sentence := package_sentence(error):
        node.fault(sentence, REFUSED)
        return
    node.get_logger().error("".join(traceback.format_exception(error)))
    node.fault(f"unexpected {type(error).__name__}: {error}", FAULT)


def _run_on(nodes: Sequence[Any]) -> bool:
    """Whether a node has not ended, and none has ended badly."""
    return any(node.exit_status is None for node in nodes) and not any(node.exit_status for node in nodes)


def _orphaned(supervisor: int) -> bool:
    """Whether the supervisor that started this process is gone."""
    return bool(supervisor) and os.getppid() != supervisor


def _log_fatal(node: Any, sentence: str) -> None:
    (node.get_logger() if node is not None else get_logger("bench")).fatal(sentence)
