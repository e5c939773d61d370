"""Bags with any content, right or wrong, by the writer of the mcap package."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mcap.writer import CompressionType, Writer

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import RECORD, recorded_topics, sealed
from contact_sim_pkg.records.messages import String
from contact_sim_pkg.run.bag_content import attachments
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve

BLOCK = 10_000_000  # [ns]
VIBRATION = "platform/vibration"


@dataclass
class Content:
    """What `write` puts into a file."""

    texts: Mapping[str, str]
    messages: Sequence[tuple[str, int, bytes]]
    records: Mapping[str, Mapping[str, str]] = field(default_factory=dict)  # metadata records beside ours
    attachments: Mapping[str, bytes] = field(default_factory=dict)
    definitions: Mapping[str, str] = field(default_factory=dict)  # by topic, in place of the installed ones
    quality: str | None = None  # offered profiles of all topics
    seal: bool = True
    compression: CompressionType = CompressionType.ZSTD
    names: Mapping[str, str] = field(default_factory=dict)  # by topic, in place of its full name
    encodings: Mapping[str, str] = field(default_factory=dict)  # by topic, in place of CDR


def seat_ride(blocks: int = 2, **changes: Any) -> Content:
    """The excitation of `seat_ride` on a spring as its run records it, without the simulation."""
    values = (f"duration={blocks * 0.01}", "effects.seat={normal_elastic: {}, normal_dissipative: {}}")
    scene = resolve(load_scene("seat_ride", [set_value(value) for value in values]))
    source = make_sources(scene)[VIBRATION]
    stamps = [number * BLOCK for number in range(blocks)]
    sent = [(VIBRATION, stamp, encode(source.block(stamp // BLOCK), stamp)) for stamp in stamps]
    texts = attachments(scene, {VIBRATION: source.describe()})
    return Content(texts, [("bench/scene", 0, encode(String(data=scene.to_yaml()))), *sent], **changes)


def write(directory: Path, content: Content) -> Path:
    """Write a finished bag of one file; returns the file."""
    directory.mkdir(parents=True)
    file = directory / f"{directory.name}_0.mcap"
    with file.open("wb") as stream:
        writer = Writer(stream, compression=content.compression)
        writer.start(profile="ros2", library="hand made")
        writer.add_metadata(RECORD, sealed(content.texts) if content.seal else dict(content.texts))
        for name, texts in content.records.items():
            writer.add_metadata(name, dict(texts))
        for name, data in content.attachments.items():
            writer.add_attachment(0, 0, name, "text/plain", data)
        numbers = _channels(writer, content, dict.fromkeys(name for name, _, _ in content.messages))
        for order, (name, time, data) in enumerate(content.messages):
            writer.add_message(numbers[name], time, data, time, order)
        writer.finish()
    return file


def _channels(writer: Writer, content: Content, names: Iterable[str]) -> dict[str, int]:
    numbers = {}
    for row in recorded_topics(tuple(names)):
        text = content.definitions.get(row.key, row.definition)
        schema = writer.register_schema(row.type, "ros2msg", text.encode())
        quality = row.offered_qos if content.quality is None else content.quality
        kept = {"offered_qos_profiles": quality, "topic_type_hash": "" if text != row.definition else row.type_hash}
        name, encoding = content.names.get(row.key, row.name), content.encodings.get(row.key, "cdr")
        numbers[row.key] = writer.register_channel(name, encoding, schema, kept)
    return numbers
