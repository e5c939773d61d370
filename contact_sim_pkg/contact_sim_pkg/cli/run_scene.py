"""`bench run`: resolve, run on nodes or without, show progress, report the outcome."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

from contact_sim_pkg.bag.names import new_directory
from contact_sim_pkg.cli.main import BEGAN
from contact_sim_pkg.cli.output.checked import check_of_run, facts_of_check, lines_of_check
from contact_sim_pkg.cli.output.outcome import describe, misses, print_outcome, state_of
from contact_sim_pkg.cli.output.progress import RunDisplay
from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import print_json
from contact_sim_pkg.cli.scene_options import SceneOptions
from contact_sim_pkg.files import RefusedError
from contact_sim_pkg.requirements import is_met, is_of_ros, package_sentence

if TYPE_CHECKING:
    from contact_sim_pkg.run.live_parameters import Change
    from contact_sim_pkg.run.sources import Source
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

Result = TypeVar("Result")
GRACE = 0.5  # [s] from a signal to the end of the block that is computed
LOOK = 0.1  # [s] between two looks at signals
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class SetUpInterrupted(BaseException):
    """A signal broke the set-up off, before anything was created."""


class SummarySkipped(BaseException):
    """A signal while the run is summed up."""


class OtherSignals:
    """What a signal does outside of the run, which has an answer of its own: it skips the summary, or breaks off."""

    def __init__(self) -> None:
        """Before the run."""
        self.has_summary = False  # one comes next, or is being made
        self._skips = self._sums_up = False

    def __call__(self) -> None:
        """A signal."""
        if not self.has_summary:
            raise KeyboardInterrupt
        self._skips = True
        if self._sums_up:
            raise SummarySkipped

    def sum_up(self, scene: ResolvedScene, ended: RunEnd) -> dict[str, Any]:
        """The outcome of a run, for whose summary its recording is read, unless a signal says that nobody waits for it."""
        if ended.stopped and ended.bag is not None and not ended.failure:
            say(f"bench: {ended.bag} is closed; its summary follows, another signal skips it", err=True)
        try:
            self._sums_up = True
            with RunDisplay(1.0, "summing up"):
                facts = describe(scene, ended, with_summary=not self._skips)
            self._sums_up = False
        except SummarySkipped:
            self._sums_up = False
            facts = describe(scene, ended, with_summary=False)
        self.has_summary = False
        return facts


class StopRequest:
    """Whether there was a signal: it breaks the set-up off at once, and is checked between two
    blocks once they are computed.
    """

    def __init__(self) -> None:
        """Nothing is computed yet."""
        self.requested_at = float("inf")  # of the monotonic clock
        self._computes = False

    def on_signal(self) -> None:
        """A signal. Raises `SetUpInterrupted` until the run has checked once."""
        self.requested_at = min(self.requested_at, time.monotonic())
        if not self._computes:
            raise SetUpInterrupted

    def __call__(self) -> bool:
        """Whether there was one; the first check marks the start of the run."""
        self._computes = True
        return self.requested_at < float("inf")


class RunEnd(NamedTuple):
    """How a run ended, on nodes or without."""

    blocks: int
    startup: float  # [s] from the start of the process to the first block
    wall: float  # [s] from the first block to the last message recorded
    bag: Path | None
    stopped: bool
    failure: str
    exit_status: int
    excitation: dict[str, dict[str, Any]]  # by topic, findings in it and their treatment
    computes_on: bool = False  # a thread of this process that nothing can stop


class PreparedRun(NamedTuple):
    """A run that may start."""

    scene: ResolvedScene
    directory: Path | None  # of the bag; None: nothing is recorded
    forecast: dict[str, Any]  # numbers of the rig before the run


def prepare(
    options: SceneOptions, *, out: Path | None, from_bag: Path | None, record: bool, allow_long: bool,
    within: tuple[str, ...] = (),
) -> PreparedRun:  # fmt: skip
    """Resolve the scene and refuse whatever can be refused, before the first process or file.

    Raises:
        SceneError, BagError, ExcitationError: refused.
    """
    scene = options.within(within, from_bag) if within else options.resolve(from_bag)
    if from_bag is not None:
        from contact_sim_pkg.run.from_bag import cautions, refuse_other_scene

        refuse_other_scene(from_bag, scene)
        for line in cautions(from_bag):
            say(line, err=True)
    directory = new_directory(out, scene.name) if record else None
    _report_work(scene, allow_long)
    _report_absent(scene)
    return PreparedRun(scene, directory, _forecast(scene))


def run_scene(
    options: SceneOptions,
    *,
    offline: bool,
    out: Path | None,
    from_bag: Path | None,
    clock: bool,
    excitation: str = "topics",
    record: bool,
    check: bool,
    as_json: bool,
    allow_long: bool,
    strict: bool = False,
    within: tuple[str, ...] = (),
) -> int:
    """Run a scene; returns the exit status. Ends the process where an abandoned computation
    still runs in it.

    Raises:
        SceneError, BagError, ExcitationError: refused; nothing was created.
    """
    if from_bag is not None and not offline:
        from contact_sim_pkg.run.from_bag import STEERED, refuse_steered

        refuse_steered(from_bag, STEERED)
    scene, directory, forecast = prepare(
        options, out=out, from_bag=from_bag, record=record, allow_long=allow_long, within=within
    )
    run = _run_offline if offline else partial(_run_on_nodes, clock=clock, excitation=excitation)
    signals = OtherSignals()
    with _signals_call(signals):
        with RunDisplay(scene.duration) as display:
            ended = run(scene, directory, from_bag, display)
        signals.has_summary = True
        status = _report_outcome(scene, ended, forecast, signals, check=check, as_json=as_json, strict=strict)
    # compiled code that does not return would keep the interpreter from ending
    if ended.computes_on:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)
    return status


def _report_outcome(
    scene: ResolvedScene,
    ended: RunEnd,
    forecast: dict[str, Any],
    signals: OtherSignals,
    *,
    check: bool,
    as_json: bool,
    strict: bool,
) -> int:
    """Report the outcome of a run; returns the exit status."""
    if ended.failure:
        say(f"bench: {ended.failure}", err=True)
    if ended.exit_status == 2:
        return 2
    hint = _leave_metadata(scene, ended)
    facts = signals.sum_up(scene, ended) | forecast
    checked = check_of_run(scene, ended) if check else None
    if as_json:
        print_json(facts | facts_of_check(checked))
    else:
        print_outcome(facts, ended, lines_of_check(checked))
    if hint:
        say(f"bench: {hint}", err=True)
    return ended.exit_status or int(strict and bool(misses(facts["summary"])))


def _leave_metadata(scene: ResolvedScene, ended: RunEnd) -> str:
    """Beside a bag that its recorder could not finish; how to make it whole, empty where it is."""
    from contact_sim_pkg.bag.unfinished import leave_metadata

    outcome = {"ended": state_of(scene, ended), "blocks_done": str(ended.blocks), "failure": ended.failure}
    return "" if ended.bag is None else leave_metadata(ended.bag, outcome)


def _report_work(scene: ResolvedScene, allow_long: bool) -> None:
    """One line on standard error where the run is long. Raises SceneError beyond the bound."""
    from contact_sim_pkg.run.work import refuse_long

    report = refuse_long(scene, allowed=allow_long)
    if report:
        say(f"{scene.name}: {report}", err=True)


def _report_absent(scene: ResolvedScene) -> None:
    """One line on standard error where the scene's own values call for an effect that is off."""
    from contact_sim_pkg.studies.effects.absent import sentence_of_absent

    sentence = sentence_of_absent(scene)
    if sentence:
        say(f"{scene.name}: {sentence}", err=True)


def _forecast(scene: ResolvedScene) -> dict[str, Any]:
    """Forecast of the rig before the run: a line on standard error, and the numbers of `--json`."""
    from contact_sim_pkg.run.rigs import forecast_of

    found = forecast_of(scene)
    if found is None:
        return {}
    say(f"{scene.name}: {found.sentence}", err=True)
    return {"stability": found.facts}


def _run_offline(scene: ResolvedScene, directory: Path | None, from_bag: Path | None, display: RunDisplay) -> RunEnd:
    from contact_sim_pkg.run.computing import Computing
    from contact_sim_pkg.run.offline import RunOutcome, run_offline

    sources: dict[str, Source] | None = None
    changes: tuple[Change, ...] = ()
    if from_bag is not None:
        from contact_sim_pkg.run.from_bag import changes_from_bag, sources_from_bag

        sources, changes = sources_from_bag(from_bag, scene), changes_from_bag(from_bag)
    stop = StopRequest()
    before = time.monotonic() - BEGAN
    computing = Computing[RunOutcome]()
    worker = Worker(
        run_offline, scene, directory, display.show, stop, sources, computing, display.show_set_up, display.print_line,
        changes,
    )  # fmt: skip
    broken_off: RunOutcome | None = None
    # the run has a thread of its own: this one waits for signals, and gives a block `GRACE` to end
    with _signals_call(stop.on_signal):
        try:
            worker.start()
            while worker.is_alive() and broken_off is None:
                worker.join(LOOK)
                if time.monotonic() > stop.requested_at + GRACE:
                    broken_off = computing.abandon()
        except SetUpInterrupted:
            return RunEnd(
                blocks=0,
                startup=time.monotonic() - BEGAN,
                wall=0.0,
                bag=None,
                stopped=True,
                failure="",
                exit_status=0,
                excitation={},
                computes_on=True,
            )
    outcome = broken_off or worker.result()
    lost = bool(outcome.loss) or (outcome.bag is not None and not outcome.bag.complete)
    failure = outcome.failure or (outcome.bag.sentence if outcome.bag is not None else "") or outcome.loss
    status = 1 if outcome.failure else 3 if lost else 0
    bag = None if outcome.bag is None else outcome.bag.path
    return RunEnd(
        blocks=outcome.blocks,
        startup=before + outcome.startup,
        wall=outcome.wall,
        bag=bag,
        stopped=outcome.stopped,
        failure=failure,
        exit_status=status,
        excitation=outcome.excitation,
        computes_on=broken_off is not None,
    )


class Worker(threading.Thread, Generic[Result]):
    """A call in a thread of its own, so that this one receives signals while compiled code runs."""

    def __init__(self, function: Callable[..., Result], *arguments: Any) -> None:
        """Not started yet."""
        super().__init__(daemon=True)
        self._call = partial(function, *arguments)
        self._results: list[Result] = []
        self._error: BaseException | None = None

    def run(self) -> None:
        """Call; keeps the result or the error."""
        try:
            self._results.append(self._call())
        except BaseException as error:  # noqa: BLE001  # raised again by `result`
            self._error = error

    def result(self) -> Result:
        """Result of the call; raises its error."""
        if self._error is not None:
            raise self._error
        return self._results[0]


def _run_on_nodes(
    scene: ResolvedScene,
    directory: Path | None,
    from_bag: Path | None,
    display: RunDisplay,
    *,
    clock: bool,
    excitation: str,
) -> RunEnd:
    try:
        import rclpy  # noqa: F401  # refused here, with the cure, where ROS is not there
        from contact_msgs_defs.msg import BenchProgress  # noqa: F401
    except ImportError as error:
        if not is_of_ros(error):
            raise
        raise RefusedError(f"{package_sentence(error)} (`bench run --offline` needs no ROS)") from error

    if find_spec("numba") is None or not is_met("numba"):  # which only the simulator's process imports
        raise ModuleNotFoundError("No module named 'numba' of a version that fits", name="numba")
    from contact_sim_pkg.nodes.processes.supervisor import Supervisor

    supervisor = Supervisor(scene, directory, from_bag=from_bag, clock=clock, excitation=excitation)
    before = time.monotonic() - BEGAN
    with _signals_call(supervisor.stop):
        outcome = supervisor.run(display.show, display.print_line)
    return RunEnd(
        blocks=outcome.blocks,
        startup=before + outcome.startup,
        wall=outcome.wall,
        bag=outcome.bag,
        stopped=outcome.stopped,
        failure=outcome.failure,
        exit_status=outcome.exit_status,
        excitation=outcome.excitation,
    )


@contextmanager
def _signals_call(stop: Callable[[], Any]) -> Iterator[None]:
    """While the run lasts, the three signals request a clean end."""
    before = {number: signal.signal(number, lambda *_: stop()) for number in SIGNALS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
