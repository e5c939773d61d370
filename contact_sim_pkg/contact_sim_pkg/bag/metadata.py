"""`metadata.yaml` as rosbag2 of Jazzy writes it (version 9), and the versions of the software
that wrote a bag.
"""

import hashlib
import json
import platform
from collections.abc import Callable, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple

from ruamel.yaml import YAML
from ruamel.yaml.scalarstring import DoubleQuotedScalarString

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.texts import MOST_VALUES, values_of_text
from contact_sim_pkg.bag.topics import RECORDED, full_name, offered_qos, topic_of
from contact_sim_pkg.bag.typestore import definition, type_hash
from contact_sim_pkg.files import read_regular_file
from contact_sim_pkg.scene.yaml.document import LARGEST_FILE as LARGEST_METADATA

RECORD = "contact_bench"  # name of the MCAP metadata record
LACKING = "lacking"  # key of the outcome, with the messages of the blocks done that never came
OUTCOME = f"{RECORD}_outcome"  # of the one at the end
ROSBAG2 = "rosbag2"  # of the one that rosbag2 reads
SCENE_KEY = "scene"
WALL_TIME = "wall_time"  # key of the instant of simulated time 0, [ns] since 1970, in a bag in wall time
WARNINGS = "imported_warnings"
"""what makes the values of an imported recording doubtful, separated by a line break"""
IMPORTED_FROM = "imported_from"  # key of the file that a bag was imported from, whose accelerations are in m/s^2
RELATIVE_NAME = "relative_name"  # key of a channel's metadata
CHECKSUM_KEY = "texts_sha256"
CDR = "cdr"  # encoding of the messages that are written, read and replayed


class RecordedTopic(NamedTuple):
    """One topic of a bag: `key` is its name for the writer, `name` that in the bag."""

    key: str
    name: str
    type: str
    definition: str  # ros2msg text with dependencies
    type_hash: str
    offered_qos: str  # YAML list of profiles
    relative_name: str = ""  # of the table, where a namespace or a remapping has made another of it
    encoding: str = CDR  # of the messages; others are copied, and never read


def recorded_topics(
    names: Sequence[str] = RECORDED, shown: Callable[[str], str] = full_name
) -> tuple[RecordedTopic, ...]:
    """The given topics of the table, in order of rank, with the definitions installed; BagError for
    an unknown name.

    `shown` gives the name in the bag, that of the graph: namespace and remapping included.
    """
    # channels are numbered in this order, whatever the order of `names`
    rows = sorted((topic_of(name) for name in names), key=lambda topic: topic.rank)
    return tuple(
        RecordedTopic(
            row.name,
            shown(row.name),
            row.type,
            definition(row.type),
            type_hash(row.type),
            offered_qos(row),
            row.name if shown(row.name) != full_name(row.name) else "",
        )
        for row in rows
    )


class Extent(NamedTuple):
    """First and last log time of a bag, [ns]; both 0 without messages."""

    start: int
    end: int


def wall_time_of(texts: Mapping[str, str]) -> int:
    """What is added to the log and publish times of a bag with these texts, [ns]; 0 in simulated time.

    BagError where the text is no instant from 1970 to 2262.
    """
    text = texts.get(WALL_TIME, "0")
    if not text.isascii() or not text.isdigit() or not int(text) < 2**63:
        raise BagError(
            f"the texts of the bag give {WALL_TIME} as {text!r:.40}; it is a number of nanoseconds since 1970"
        )
    return int(text)


def sealed(texts: Mapping[str, str]) -> dict[str, str]:
    """The texts of a metadata record with their checksum: MCAP keeps none for these records."""
    return {**texts, CHECKSUM_KEY: _checksum(texts)}


def unsealed(records: Sequence[Mapping[str, str]]) -> list[dict[str, str] | None]:
    """The texts of each metadata record without their checksum; None where it does not hold.

    Older bags have none; where one record has it, all must.
    """
    needed = any(CHECKSUM_KEY in texts for texts in records)
    bare = [{key: text for key, text in texts.items() if key != CHECKSUM_KEY} for texts in records]
    return [
        texts if not needed or record.get(CHECKSUM_KEY) == _checksum(texts) else None
        for record, texts in zip(records, bare, strict=True)
    ]


def _checksum(texts: Mapping[str, str]) -> str:
    return hashlib.sha256(json.dumps(dict(texts), sort_keys=True).encode()).hexdigest()


def software_versions(kernel_fingerprint: str) -> dict[str, str]:
    """Versions of the package and of what its numbers depend on; neither paths nor environment."""
    names = {"package_version": "contact_sim_pkg", "numpy": "numpy", "numba": "numba"}
    return {
        **{key: _version(name) for key, name in names.items()},
        "python": platform.python_version(),
        "kernel_fingerprint": kernel_fingerprint,
    }


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"


def metadata_text(
    file_name: str,
    topics: Sequence[RecordedTopic],
    counts: Mapping[str, int],
    extent: Extent,
    custom: Mapping[str, str],
) -> str:
    """The text of `metadata.yaml` of a bag of one file; `counts` by key of the topic."""
    information = _information(file_name, topics, counts, extent, custom)
    return _dump({"rosbag2_bagfile_information": information})


def serialized_metadata(
    file_name: str,
    topics: Sequence[RecordedTopic],
    counts: Mapping[str, int],
    extent: Extent,
    custom: Mapping[str, str],
) -> dict[str, str]:
    """The MCAP metadata record `rosbag2`, from which `ros2 bag reindex` and `info` read a lone
    file.
    """
    information = _information(file_name, topics, counts, extent, custom)
    return {"serialized_metadata": _dump(information), "ROS_DISTRO": "jazzy"}


def files_of_bag(path: Path) -> list[str]:
    """The files that the `metadata.yaml` at `path` lists; BagError where it cannot be read or lists
    none as it should.
    """
    try:
        text = read_regular_file(path, LARGEST_METADATA).decode("utf-8", "replace")
    except OSError as error:
        raise BagError(f"{path} cannot be read: {error.strerror}; give the .mcap file instead") from None
    content = values_of_text(text, str(path), most_values=MOST_VALUES)
    information = content.get("rosbag2_bagfile_information") if isinstance(content, dict) else None
    files = information.get("relative_file_paths") if isinstance(information, dict) else None
    if not isinstance(files, list) or not all(isinstance(name, str) and name.isprintable() for name in files):
        raise BagError(
            f"{path} is no metadata of a bag: no list rosbag2_bagfile_information.relative_file_paths of names; give the .mcap "
            "file instead"
        )
    return files


def _information(
    file_name: str,
    topics: Sequence[RecordedTopic],
    counts: Mapping[str, int],
    extent: Extent,
    custom: Mapping[str, str],
) -> dict[str, Any]:
    duration = {"nanoseconds": extent.end - extent.start}
    # the one file spans the whole bag, so both entries have the same extent
    start = {"nanoseconds_since_epoch": extent.start}
    total = sum(counts[topic.key] for topic in topics)
    return {
        "version": 9,
        "storage_identifier": "mcap",
        "duration": dict(duration),
        "starting_time": dict(start),
        "message_count": total,
        "topics_with_message_count": [_topic(topic, counts[topic.key]) for topic in topics],
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [file_name],
        "files": [
            {"path": file_name, "starting_time": dict(start), "duration": dict(duration), "message_count": total}
        ],
        "custom_data": {DoubleQuotedScalarString(key): DoubleQuotedScalarString(text) for key, text in custom.items()}
        or None,
        "ros_distro": "jazzy",
    }


def _topic(topic: RecordedTopic, count: int) -> dict[str, Any]:
    return {
        "topic_metadata": {
            "name": topic.name,
            "type": topic.type,
            "serialization_format": topic.encoding,
            "offered_qos_profiles": values_of_text(topic.offered_qos, topic.name) if topic.offered_qos.strip() else [],
            "type_description_hash": topic.type_hash,
        },
        "message_count": count,
    }


def _dump(content: dict[str, Any]) -> str:
    yaml = YAML()
    yaml.width = 4096
    text = StringIO()
    yaml.dump(content, text)
    return text.getvalue()
