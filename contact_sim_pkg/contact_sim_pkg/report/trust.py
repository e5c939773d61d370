"""What a reader needs to trust a run: accuracy requested and estimated, self-checks, cost; and the commands that made it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from contact_sim_pkg.compare.estimated import MOTION, accuracy_numbers
from contact_sim_pkg.records.metric import SELF_CHECK, Metric
from contact_sim_pkg.records.table import number_of
from contact_sim_pkg.report.metrics.views import value_text, verdict_text
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.summary import longest_block_sentence, solver_numbers
from contact_sim_pkg.report.tables import Table

if TYPE_CHECKING:
    from contact_sim_pkg.compare.delivered import Check

__all__ = ["commands_of", "topic_table", "trust_tables"]


def trust_tables(recording: Recording, metrics: Sequence[Metric], check: Check | None = None) -> list[Table]:
    """Accuracy with the cost of it, and self-checks, as far as the run has them; ``check``: of the accuracy delivered."""
    return [each for each in (_accuracy(recording, check), _self_checks(metrics)) if each.rows]


def commands_of(recording: Recording) -> list[tuple[str, str]]:
    """Command and what it does, to be called beside the bag."""
    name = recording.name
    return [
        (f"bench run --from-bag {name} --offline --out {name}_again", "runs it again, with the same excitation"),
        (f"bench report {name}", "makes this page"),
        (f"bench report {name} --check", "makes it again with the accuracy that was delivered, by a finer run"),
        (f"bench metrics {name} --csv", "prints the metrics"),
        (f"bench export {name}", "writes each topic as a table"),
    ]  # fmt: skip


def topic_table(recording: Recording) -> Table:
    """Topics of the bag."""
    rows = [
        (topic.name, topic.type, str(topic.messages),
         f"{topic.messages / recording.duration:.4g}" if recording.duration > 0.0 and topic.messages > 1 else "–")
        for topic in recording.topics
    ]  # fmt: skip
    rows.append(("all topics", "", str(sum(topic.messages for topic in recording.topics)), ""))
    return Table("", ("topic", "type", "messages", "a second"), rows)


def _accuracy(recording: Recording, check: Check | None) -> Table:
    numbers, delivered = accuracy_numbers(recording), _delivered(check)
    asked = numbers.get("requested", 0.0)
    rows = [
        (place if place == kind else f"{place} {kind}", number_of(asked), _said(error, asked, "not estimated"),
         f"not below {number_of(least[0])} with {least[1]}"
         if (least := numbers["not_below"].get(place, {}).get(kind)) else "",
         _said(delivered.get((place, kind)), asked, "not checked"))
        for place, kinds in numbers.get("estimated", {}).items() for kind, error in kinds.items()
    ]  # fmt: skip
    by = f"delivered: {_checked(check)}" if check else "bench report --check finds what was delivered"
    caption = f"Numerical error over the largest value of its kind; {by}. {_cost(recording)}"
    return Table(caption, ("accuracy of", "requested", "estimated", "no request makes it less", "delivered"), rows)


def _delivered(check: Check | None) -> dict[tuple[str, str], float]:
    """Largest error by place and kind; of the bodies together that of the worst."""
    found: dict[tuple[str, str], float] = {}
    for each in check.judgements if check else ():
        name = (MOTION, MOTION) if each.kind == MOTION else (each.place, each.kind)
        found[name] = max(found.get(name, 0.0), each.error)
    return found


def _said(error: float | None, requested: float, absent: str) -> str:
    return absent if error is None else number_of(error) + (" (above)" if error > requested else "")


def _checked(check: Check) -> str:
    """What the check ran, and where."""
    spans = ", ".join(f"{each.start:g} to {each.end:g} s" for each in check.windows)
    parted = f", until {check.parting.time:.3g} s, where they part" if check.parting else ""
    return f"beside a finer run in {spans}{parted}"


def _self_checks(metrics: Sequence[Metric]) -> Table:
    rows = [
        (each.name, value_text(each), each.band.text, verdict_text(each), each.band.source)
        for each in metrics if each.basis == SELF_CHECK and each.band is not None
    ]  # fmt: skip
    return Table("", ("self-check", "this run", "closed form", "verdict", "by"), rows)


def _cost(recording: Recording) -> str:
    if recording.cost is None:
        return ""
    numbers = solver_numbers(recording.cost)
    return (
        f"{numbers['blocks']} blocks took {numbers['physics_wall_s']:.3g} s, {numbers['physics_real_time_factor']:.3g} times as "
        f"fast as the clock: {numbers['steps']} time steps, {numbers['rejected_steps']} rejected, {numbers['events']} events. "
        f"{numbers['overruns']} took longer than they last; {longest_block_sentence(numbers)}."
    )
