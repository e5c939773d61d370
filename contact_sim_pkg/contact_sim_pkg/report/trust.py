"""What a reader needs to trust a run: accuracy requested and estimated, self-checks, cost; and the commands that made it."""

from __future__ import annotations

from collections.abc import Sequence

from contact_sim_pkg.compare.estimated import accuracy_numbers
from contact_sim_pkg.records.metric import SELF_CHECK, Metric
from contact_sim_pkg.records.table import number_of
from contact_sim_pkg.report.metrics.views import value_text, verdict_text
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.summary import solver_numbers
from contact_sim_pkg.report.tables import Table

__all__ = ["commands_of", "topic_table", "trust_tables"]


def trust_tables(recording: Recording, metrics: Sequence[Metric]) -> list[Table]:
    """Accuracy with the cost of it, and self-checks, as far as the run has them."""
    return [each for each in (_accuracy(recording), _self_checks(metrics)) if each.rows]


def commands_of(recording: Recording) -> list[tuple[str, str]]:
    """Command and what it does, to be called beside the bag."""
    name = recording.name
    return [
        (f"bench run --from-bag {name} --offline --out {name}_again", "runs it again, with the same excitation"),
        (f"bench report {name}", "makes this page"),
        (f"bench accuracy {name}", "checks the accuracy that was delivered"),
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


def _accuracy(recording: Recording) -> Table:
    numbers = accuracy_numbers(recording)
    rows = [
        (place if place == kind else f"{place} {kind}", number_of(numbers["requested"]),
         "not estimated" if error is None else number_of(error) + (" (above)" if error > numbers["requested"] else ""),
         f"not below {number_of(least[0])} with {least[1]}"
         if (least := numbers["not_below"].get(place, {}).get(kind)) else "", "not checked")
        for place, kinds in numbers.get("estimated", {}).items() for kind, error in kinds.items()
    ]  # fmt: skip
    caption = f"Numerical error over the largest value of its kind; bench accuracy checks what was delivered. {_cost(recording)}"
    return Table(caption, ("accuracy of", "requested", "estimated", "no request makes it less", "delivered"), rows)


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
        f"fast as the clock: {numbers['steps']} time steps, {numbers['rejected_steps']} rejected, {numbers['events']} events."
    )
