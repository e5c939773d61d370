"""Metrics of the contacts of any run."""

from collections.abc import Iterator

from contact_sim_pkg.records.metric import Metric, judged
from contact_sim_pkg.report.series import Recording


def metrics(recording: Recording) -> Iterator[Metric]:
    """How often each contact closes."""
    for contact, series in recording.contacts.items():
        pressed = series.normal > 0.0  # [samples]
        impacts = float((pressed[1:] & ~pressed[:-1]).sum())
        yield Metric(
            f"{contact}.impacts", "impacts", impacts, "", judged(impacts, None), None, topic=f"{contact}/force"
        )
