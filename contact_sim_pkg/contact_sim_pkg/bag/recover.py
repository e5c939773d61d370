"""A whole bag from one that was cut off or damaged; the source is never touched."""

from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.mcap.append_file import is_being_written
from contact_sim_pkg.bag.metadata import RecordedTopic
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.bag.texts import values_of_text
from contact_sim_pkg.bag.writer import BagWriter


class Recovery(NamedTuple):
    """Outcome of a recovery; `sentence` names what is missing, and `lossless` is then False."""

    path: Path
    messages: int
    lossless: bool
    sentence: str


def recover(source: Path | str, target: Path) -> Recovery:
    """Write every readable message of a bag into a new bag, with its definitions, times, numbers
    and texts.

    Args:
        source: directory or `.mcap` file of the bag, finished or not.
        target: directory of the new bag, which must not exist.

    Raises:
        BagError: the source is no bag or is being recorded, the target exists, or the disk is full.
    """
    bag = open_bag(source, skip_bad=True)
    if is_being_written(bag.path):
        raise BagError(f"{bag.path} is being recorded at this moment; recover it when the recording has ended")
    topics, lost_quality = _with_readable_quality(bag)
    # notes on what is missing grow while the messages are read
    with BagWriter(target, topics, bag.metadata) as writer:
        for message in bag.messages():
            writer.write(
                message.topic,
                message.log_time,
                message.data,
                publish_time=message.publish_time,
                sequence=message.sequence,
            )
        left = [f"{bag.not_copied} are not brought over"] if bag.not_copied else []
        lost = "; ".join([*bag.notes, *lost_quality, *left])
        summary = writer.close({"recovered": lost or "nothing was missing"})
    sentence = "; ".join(part for part in (lost, summary.sentence) if part)
    return Recovery(target, summary.messages, not sentence, sentence)


def _with_readable_quality(bag: Bag) -> tuple[tuple[RecordedTopic, ...], list[str]]:
    """The topics of the bag, without a quality of service that cannot be read, and a sentence on
    each of those.
    """
    topics, lost = [], []
    for row in bag.topics.values():
        try:
            values_of_text(row.offered_qos or "[]", f"quality of service of {row.name}")
        except BagError as error:
            lost.append(f"{error} and is left out")
            row = row._replace(offered_qos="")
        topics.append(row)
    return tuple(topics), lost
