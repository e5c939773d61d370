"""A whole bag from one that was cut off or damaged; the source is never touched."""

from pathlib import Path
from typing import NamedTuple

from .append_file import is_being_written
from .errors import BagError
from .reader import open_bag
from .writer import BagWriter


class Recovery(NamedTuple):
    """What was brought over; `lossless` is False where anything is missing, and `sentence` says what."""

    path: Path
    messages: int
    lossless: bool
    sentence: str


def recover(source: Path | str, target: Path) -> Recovery:
    """Write every readable message of a bag into a new bag, with its definitions, times, numbers and texts.

    Args:
        source: directory or `.mcap` file of the bag, finished or not.
        target: directory of the new bag, which must not exist.

    Raises:
        BagError: the source is no bag or is being recorded, the target exists, or the disk is full.
    """
    bag = open_bag(source, skip_bad=True)
    if is_being_written(bag.path):
        raise BagError(f"{bag.path} is being recorded at this moment; recover it when the recording has ended")
    with BagWriter(target, tuple(bag.topics.values()), bag.metadata) as writer:
        for message in bag.messages():
            writer.write(
                message.topic,
                message.log_time,
                message.data,
                publish_time=message.publish_time,
                sequence=message.sequence,
            )
        left = f"{bag.not_copied} are not brought over" if bag.not_copied else ""
        lost = "; ".join([*bag.notes, *([left] if left else [])])
        summary = writer.close({"recovered": lost or "nothing was missing"})
    sentence = "; ".join(part for part in (lost, summary.sentence) if part)
    return Recovery(target, summary.messages, not sentence, sentence)
