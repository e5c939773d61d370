"""A bag whose recorder was killed, or whose disk was full: what the others leave beside it."""

from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from contact_sim_pkg.bag.errors import BagError, BagWriteError
from contact_sim_pkg.bag.mcap.append_file import is_being_written, write_whole
from contact_sim_pkg.bag.mcap.layout import counts_on_disk
from contact_sim_pkg.bag.metadata import Extent, metadata_text
from contact_sim_pkg.bag.reader import open_bag

METADATA = "metadata.yaml"


def leave_metadata(directory: Path, outcome: Mapping[str, str]) -> str:
    """Write the `metadata.yaml` of a bag that was not finished, with what can be read of it; the
    `.mcap` is not touched.

    Args:
        directory: directory of the bag; nobody records it any more.
        outcome: how the run ended, as the recorder would have kept it.

    Returns:
        Sentence on the content of the bag and how to make a whole one of it; empty where the bag is
        finished, is being recorded, or cannot be read at all.
    """
    try:
        bag = open_bag(directory, skip_bad=True)
    except BagError:
        return ""
    if is_being_written(bag.path) or ((directory / METADATA).exists() and counts_on_disk(bag.path)[1]):
        return ""
    first = next(bag.messages(), None)
    topics = tuple(bag.topics.values())
    counts = {topic.key: bag.count(topic.name) for topic in topics}
    extent = Extent(0 if first is None else first.log_time, bag.end)
    with suppress(BagWriteError):  # a disk that is still full: the sentence is enough
        write_whole(
            directory, METADATA, metadata_text(bag.path.name, topics, counts, extent, {**bag.metadata, **outcome})
        )
    lost = "; ".join(bag.notes) or f"{directory} was not finished"
    return f"{lost}; make it whole: bench recover {directory} {directory}_recovered"
