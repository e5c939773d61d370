"""A bag in wall time, for players and databases that expect times since 1970; header stamps stay simulated time.

Log and publish times, the index of the file and `metadata.yaml` are later by one and the same
instant: a player that seeks to the start of the metadata finds the messages there. The instant
stands in the texts of the bag, and `bag/reader.py` takes it off again.
"""

from datetime import datetime, timezone
from pathlib import Path

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.metadata import WALL_TIME
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.bag.writer import BagSummary, BagWriter

__all__ = ["began_at", "export_wall_time", "wall_time_texts"]


def export_wall_time(bag: Bag, directory: Path, began: int) -> BagSummary:
    """Write all messages of a bag into a new one; `began` is the instant of simulated time 0, [ns] since 1970."""
    with BagWriter(directory, tuple(bag.topics.values()), {**bag.metadata, **wall_time_texts(began)}) as writer:
        for message in bag.messages():
            writer.write(
                message.topic, message.log_time, message.data,
                publish_time=message.publish_time, sequence=message.sequence,
            )  # fmt: skip
        return writer.close()


def began_at(bag: Bag, given: str = "") -> int:
    """The instant of simulated time 0, [ns] since 1970.

    Args:
        bag: whose file was written last when its run at real time had ended.
        given: date and time of ISO 8601, in UTC where it names no zone; empty: from the file.

    Raises BagError for any other text, and for an instant before 1970.
    """
    if not given:
        return max(0, bag.path.stat().st_mtime_ns - bag.end)
    try:
        moment = datetime.fromisoformat(given.replace("Z", "+00:00"))
        moment = moment if moment.tzinfo else moment.replace(tzinfo=timezone.utc)
        began = int(moment.replace(microsecond=0).timestamp()) * SECOND + moment.microsecond * 1000
    except (ValueError, OverflowError) as error:
        raise BagError(
            f"--begin {given!r:.60} is no date and time ({error}); give one such as 2026-05-04T10:30:00Z"
        ) from None
    if began < 0:
        raise BagError(f"--begin {given} lies before 1970; give a later date")
    return began


def wall_time_texts(began: int) -> dict[str, str]:
    """The text of a bag in wall time; `began` as of `export_wall_time`."""
    return {WALL_TIME: str(began)}
