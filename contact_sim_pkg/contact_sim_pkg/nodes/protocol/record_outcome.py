"""How a run ended, as its bag keeps it. Without ROS."""

from __future__ import annotations

from collections.abc import Mapping

from contact_sim_pkg.bag.metadata import LACKING
from contact_sim_pkg.nodes.protocol.states import Follower, RunState

UNREPORTED = "the recording was ended before the simulator said that the run had ended"


def outcome_of(
    run: Follower, blocks_done: int, *, reason: str = "", lacking: int = 0, counts: Mapping[str, int] | None = None
) -> dict[str, str]:
    """The texts that end a bag.

    Args:
        run: the run as the logger has followed it.
        blocks_done: whole blocks in the bag.
        reason: why the supervisor ended the run, with the process that failed; empty where it did
            not.
        lacking: messages of the blocks done that never came.
        counts: what was left out, by its name; what is 0 is not mentioned.
    """
    # the supervisor's reason overrides the simulator's last report
    failure = reason or (run.last.message if run.last is not None and run.state is RunState.FAILED else "")
    ended = "failed" if reason else "stopped" if run.state is RunState.RESET else run.state.name.lower()
    if not failure and not run.state.ended:
        ended, failure = "stopped", UNREPORTED
    outcome = {"ended": ended, "blocks_done": str(blocks_done), "failure": failure}
    if lacking:
        outcome[LACKING] = f"{lacking} messages of the blocks done never came"
    return outcome | {name: str(count) for name, count in (counts or {}).items() if count}
