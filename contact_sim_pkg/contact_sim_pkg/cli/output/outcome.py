"""Outcome of a run, for scripts and for people."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from contact_sim_pkg.cli.output.say import say

if TYPE_CHECKING:
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene


class Outcome(Protocol):
    """A finished run, offline or on nodes."""

    @property
    def blocks(self) -> int:
        """Blocks done."""

    @property
    def startup(self) -> float:
        """Start of the process to first block, [s]."""

    @property
    def wall(self) -> float:
        """First block to last message recorded, [s]."""

    @property
    def bag(self) -> Path | None:
        """Directory of the bag."""

    @property
    def stopped(self) -> bool:
        """Ended by the user."""

    @property
    def failure(self) -> str:
        """Sentence of the fault or of the loss; empty where there is none."""

    @property
    def exit_status(self) -> int:
        """0 done, 1 failed, 3 with loss."""

    @property
    def excitation(self) -> dict[str, dict[str, Any]]:
        """By topic: findings in the excitation and their treatment."""


def describe(scene: ResolvedScene, outcome: Outcome, *, with_summary: bool = True) -> dict[str, Any]:
    """The object that `--json` prints; `bag` is None and `summary` empty where nothing was
    recorded, `summary` also where the run has failed: who waits for a failure is not kept waiting
    for numbers, and `bench report` has them. It is empty, too, without `with_summary`.
    """
    # `ended` and `failure` repeat the texts that the bag ends with
    simulated = round(outcome.blocks * scene.block_length, 9)
    return {
        "scene": scene.name,
        "effects": scene.data["effects"],
        "accuracy": scene.accuracy,
        "ended": state_of(scene, outcome),
        "failure": outcome.failure or None,
        "simulated_s": simulated,
        "startup_s": round(outcome.startup, 3),
        "wall_s": round(outcome.wall, 6),
        "real_time_factor": simulated / outcome.wall if outcome.wall > 0.0 else None,
        "excitation": outcome.excitation,
        "bag": None if outcome.bag is None else str(outcome.bag),
        "summary": {}
        if outcome.bag is None or not outcome.blocks or outcome.exit_status == 1 or not with_summary
        else _summary(outcome.bag, lossy=outcome.exit_status != 0),
    }


def misses(summary: dict[str, Any]) -> list[str]:
    """What `--strict` makes a failure: each error estimated above the request, and a regime that the scene expects
    and the run does not show.
    """
    from contact_sim_pkg.compare.estimated import above
    from contact_sim_pkg.records.metric import OUTSIDE

    numbers, expected = summary.get("accuracy"), summary.get("expected")
    beyond = above(numbers) if numbers else []
    found = [f"estimated above the requested accuracy: {', '.join(beyond)}"] if beyond else []
    if expected and expected["verdict"] == OUTSIDE:
        found.append(f"the scene expects {expected['key'].partition('.')[2]}, which the run does not show")
    return found


def state_of(scene: ResolvedScene, outcome: Outcome) -> str:
    """`failed`, `stopped` (by the user, or by the end of the recording) or `finished`, as in the
    bag.
    """
    if outcome.exit_status == 1:
        return "failed"
    blocks = scene.blocks
    return "stopped" if outcome.blocks < blocks else "finished"


def _summary(bag: Path, *, lossy: bool) -> dict[str, Any]:
    from contact_sim_pkg.bag.errors import BagError
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.memory import MemoryLimitError
    from contact_sim_pkg.report.summary import summarise

    try:
        return summarise(open_bag(bag))
    except MemoryLimitError as error:  # the bag is whole, and too long to be read at once
        say(f"no summary: {error}", err=True)
        return {}
    except BagError:
        if not lossy:
            raise
        return {}  # the loss was named already


def print_outcome(facts: dict[str, Any], outcome: Outcome, checked: Iterable[str] = ()) -> None:
    """A few lines for a person, those of a check among them, the path of the bag last; on standard
    error the findings in the excitation.
    """
    for topic, description in facts["excitation"].items():
        for note in description.get("notes", []):
            say(f"{topic}: {note}", err=True)
    factor = facts["real_time_factor"]
    speed = "" if factor is None else f" in {facts['wall_s']:.3g} s: {factor:.3g}x real time"
    state = "stopped after" if outcome.stopped else "simulated"
    say(f"{facts['scene']}: {state} {facts['simulated_s']:g} s{speed} (start-up {facts['startup_s']:.2f} s)")
    summary = facts["summary"]
    _echo_accuracy(summary.get("accuracy"))
    for warning in summary.get("warnings", []):
        say(f"  warning: {warning}")
    if "messages" in summary:
        say(f"  {sum(summary['messages'].values())} messages on {len(summary['messages'])} topics")
    for line in checked:
        say(f"  {line}")
    _echo_metrics(summary.get("metrics", []), summary.get("accuracy", {}))
    if row := summary.get("expected"):
        from contact_sim_pkg.report.metrics.regimes import line_of
        from contact_sim_pkg.report.metrics.views import metric_of

        say(f"expected: {line_of(metric_of(row))}")
    if facts["bag"] is not None:
        say(f"bag: {facts['bag']}")


def _echo_accuracy(numbers: dict[str, Any] | None) -> None:
    """What was requested and what is estimated, the warning of it on standard error."""
    if not numbers:
        return
    from contact_sim_pkg.compare.estimated import above_request, accuracy_lines

    for line in accuracy_lines(numbers):
        say(f"  {line}")
    if beyond := above_request(numbers).text:
        say(f"bench: {beyond}", err=True)


def _echo_metrics(rows: list[dict[str, Any]], accuracy: dict[str, Any]) -> None:
    """The list of metrics, and the verdict on all of it."""
    if not rows:
        return
    from contact_sim_pkg.compare.estimated import above_request
    from contact_sim_pkg.report.metrics.views import lines_of, verdict_line

    for line in lines_of(rows):
        say(f"  {line}")
    say(verdict_line(rows, above_request(accuracy)))
