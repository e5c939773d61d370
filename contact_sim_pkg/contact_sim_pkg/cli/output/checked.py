"""Delivered accuracy of a run or of a bag, for scripts and for people."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from contact_sim_pkg.cli.output.say import announce, say

if TYPE_CHECKING:
    from contact_sim_pkg.cli.output.outcome import Outcome
    from contact_sim_pkg.compare.delivered import Check
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["check_of_bag", "check_of_run", "facts_of_check", "lines_of_check"]


def check_of_bag(path: Path, *, whole: bool = False, scene: ResolvedScene | None = None) -> Check:
    """Check a bag; progress goes to standard error. Raises what `check_bag` raises."""
    from contact_sim_pkg.compare.delivered import check_bag

    return check_bag(path, announce, scene=scene, whole=whole)


def check_of_run(scene: ResolvedScene, outcome: Outcome) -> Check | None:
    """Check a run; None where it was stopped, failed or left no bag, or where the check fails: the
    outcome of the run is reported all the same.
    """
    if outcome.bag is None or outcome.exit_status or outcome.stopped:
        return None
    from contact_sim_pkg.run.errors import RunError

    try:
        return check_of_bag(outcome.bag, scene=scene)
    except RunError as error:
        say(f"bench: the companion run ended: {error}", err=True)
        return None


def facts_of_check(check: Check | None) -> dict[str, Any]:
    """The key `check` of `--json`; empty without a check."""
    if check is None:
        return {}
    from contact_sim_pkg.compare.sentences import facts_of

    return {"check": facts_of(check)}


def lines_of_check(check: Check | None) -> Iterable[str]:
    """Lines of a check; none without one."""
    if check is None:
        return ()
    from contact_sim_pkg.compare.sentences import lines_of

    return lines_of(check)
