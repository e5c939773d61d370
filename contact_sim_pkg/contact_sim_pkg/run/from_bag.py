"""The excitation of an earlier run: its recorded blocks drive the simulation again, with other
effects or another accuracy.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from contact_sim_pkg.bag.errors import BagError, MessageError
from contact_sim_pkg.bag.excitation import DECODERS, Block
from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.bag.texts import excitation_of_text, scene_of_text, values_of_text
from contact_sim_pkg.bag.versions import differences_from, installed_versions
from contact_sim_pkg.records.messages import ParameterChange, RoadPatch
from contact_sim_pkg.run.bag_content import EXCITATION_KEY, input_names, kernel_fingerprint
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.live_parameters import STEERING, Change
from contact_sim_pkg.run.sources import Source, road_lattice
from contact_sim_pkg.scene.renamed_keys import removed_keys, sentence_of
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.timing import make_timing

STEERED = "run it again with `bench run --offline`"
"""What nodes say, to which no parameter of a run is known."""
KEYS = ("rig", "road", "vibration", "travel", "seed", "block_length")  # of a scene, that make its excitation


class BagSource:
    """The blocks of one excitation topic of a bag, kept as recorded bytes."""

    def __init__(self, bag: Bag, topic: str) -> None:
        """Read the topic; BagError where the bag does not have it, skips a block or holds one that
        cannot drive a rig.
        """
        self._path, self._topic = bag.path, topic
        self._messages = [message.data for message in bag.messages(topic)]
        described = excitation_of_text(bag.metadata.get(EXCITATION_KEY), f"excitation of {bag.path}")
        self._description: dict[str, Any] = described.get(topic, {})
        for expected, data in enumerate(self._messages):
            found = _decoded(bag.path, topic, data).block
            if found != expected:
                raise BagError(
                    f"{bag.path}: {topic} has block {found} where block {expected} was due; it cannot be run again"
                )

    def __len__(self) -> int:
        return len(self._messages)

    def block(self, block: int) -> Block:
        """Block number ``block``; RunError beyond the recording."""
        if block >= len(self._messages):
            raise RunError(f"{self._path}: {self._topic} ends before block {block}; it holds {len(self._messages)}")
        return DECODERS[self._topic](self._messages[block])

    def describe(self) -> dict[str, Any]:
        """Description of the excitation as recorded, and its source now."""
        notes = [*self._description.get("notes", []), f"replayed from the bag {self._path.name}"]
        return {**self._description, "notes": notes}


def sources_from_bag(path: Path, scene: ResolvedScene) -> dict[str, Source]:
    """Sources of every input that ``scene`` calls for, from the bag at ``path``; BagError as
    `refuse_other_scene`.
    """
    refuse_other_scene(path, scene)
    bag = open_bag(path)
    return {topic: BagSource(bag, topic) for topic in input_names(scene)}


def changes_from_bag(path: Path) -> tuple[Change, ...]:
    """The changes of parameters that the run of the bag at ``path`` has made; BagError where one cannot be read."""
    return changes_of(open_bag(path))


def changes_of(bag: Bag) -> tuple[Change, ...]:
    """The same of a bag that is open; none where it has no such topic."""
    if not bag.count(STEERING):
        return ()
    bag.refuse_other_definition(STEERING)
    try:
        found = [decode(ParameterChange, message.data) for message in bag.messages(STEERING)]
    except MessageError as error:
        raise BagError(f"{bag.path}: {STEERING}: {error}") from None
    return tuple(Change(each.block, each.key, each.value) for each in found)


def refuse_steered(path: Path, what: str) -> None:
    """Raise BagError where parameters changed in the run of the bag at ``path``, which ``what`` does not know."""
    if changes_from_bag(path):
        raise BagError(f"{path}: parameters changed in this run ({STEERING}); {what}")


def cautions(path: Path) -> list[str]:
    """Lines about a bag that is run again: what it lacks, other versions that recorded it, keys of
    its scene that were removed since.
    """
    bag = open_bag(path)
    recorded = {} if bag.scene is None else values_of_text(bag.scene, f"scene of {path}")
    removed = [f"{key} of the bag's scene {sentence_of(tuple(key.split('.')))}" for key in removed_keys(recorded)]
    return [*bag.notes, *filter(None, [differences_from(bag, installed_versions(kernel_fingerprint()))]), *removed]


def refuse_other_scene(path: Path, scene: ResolvedScene) -> None:
    """Raise BagError where the bag's excitation is not the one that ``scene`` describes, or does
    not fit it.

    The bag lacks a topic or blocks, its own scene has another excitation, or it was recorded on
    another road lattice or sample rate.
    """
    bag = open_bag(path)
    changed = _changed_keys(bag, scene)
    if changed:
        raise BagError(
            f"{path}: the excitation comes from the bag, and {', '.join(changed)} {'is' if len(changed) == 1 else 'are'} not "
            "as it was recorded with; leave these keys as they are in the bag's scene, or run without --from-bag"
        )
    # every block of the scene must be there, on the grid and sample rate of the scene
    blocks = make_timing(scene, True).blocks
    for topic in input_names(scene):
        bag.refuse_other_definition(topic)
        first, count = next(bag.messages(topic), None), bag.count(topic)
        if first is None or count < blocks:
            cure = f"; ask for --duration {count * scene.block_length:.12g}" if count else ""
            raise BagError(f"{path}: {topic} holds {count} blocks, the scene needs {blocks}{cure}")
        _refuse_misfit(path, topic, _decoded(path, topic, first.data), scene)


def _decoded(path: Path, topic: str, data: bytes) -> Block:
    try:
        return DECODERS[topic](data)
    except MessageError as error:
        raise BagError(f"{path}: {topic}: {error}") from None


def _changed_keys(bag: Bag, scene: ResolvedScene) -> list[str]:
    """Dotted keys that made the recorded excitation and are another in ``scene``; none where the
    bag holds no scene.
    """
    text = bag.scene
    if text is None:
        return []
    changed = _differences(scene_of_text(text, f"scene of {bag.path}"), scene.data)
    if changed:  # a bag of an earlier release may leave open what is written out today
        from contact_sim_pkg.scene.resolve import read_explicit

        changed = _differences(read_explicit(text, f"scene of {bag.path}"), scene.data)
    return changed


def _differences(recorded: dict[str, Any], data: dict[str, Any]) -> list[str]:
    """Single keys where a section is of the same kind, else the section alone."""
    changed = []
    for key in KEYS:
        before, now = recorded.get(key), data.get(key)
        if isinstance(before, dict) and isinstance(now, dict) and before.get("kind") == now.get("kind"):
            changed += [f"{key}.{inner}" for inner in {**before, **now} if before.get(inner) != now.get(inner)]
        elif before != now:
            changed.append(key)
    return changed


def _refuse_misfit(path: Path, topic: str, first: Block, scene: ResolvedScene) -> None:
    if isinstance(first, RoadPatch):
        lattice = road_lattice(scene)
        found = (first.height.shape[1], first.cell_x, first.cell_y)
        needed = (lattice.road_cols, lattice.cell_x, lattice.cell_y)
        if any(abs(a / b - 1.0) > 1e-12 for a, b in zip(found, needed, strict=True)):
            raise BagError(
                f"{path}: {topic} was recorded on {found[0]} columns of {found[1]:.6g} m x {found[2]:.6g} m, the scene needs "
                f"{needed[0]} of {needed[1]:.6g} m x {needed[2]:.6g} m; keep effects.tire.contact_field as recorded"
            )
        return
    assert scene.vibration is not None
    samples = round(scene.block_length * scene.vibration.sample_rate) + 1
    if len(first.acceleration_z) != samples:
        raise BagError(
            f"{path}: {topic} was recorded with {len(first.acceleration_z)} samples a block, the scene needs {samples}; keep "
            "block_length and vibration.sample_rate as recorded"
        )
