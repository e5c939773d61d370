"""The tables of `docs/interfaces.md`: topics, messages, nodes, exit codes and renamed scene keys.

`python -m contact_sim_lab.pages.interface_reference docs/interfaces.md` writes them
between the two marks of that file. They come from the table of topics, the `.msg` files, the rigs
and `config/bench.yaml`; nothing is written twice.
"""

from __future__ import annotations

import re
import sys
import textwrap
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.nodes.processes.sros2_policy import LIFECYCLE, OWN_ACTIONS, OWN_SERVICES, PUBLISHED, SUBSCRIBED
from contact_sim_pkg.nodes.protocol.states import DONE, FAULT, LOSS, REFUSED
from contact_sim_pkg.records.definitions import PACKAGE, texts
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.run.rigs import result_topics
from contact_sim_pkg.scene.renamed_keys import REMOVED, RENAMED
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.standard.topics import standard_topics

BEGIN = "<!-- tables made from the code: begin -->"
END = "<!-- tables made from the code: end -->"
PARAMETERS = Path("contact_sim_pkg") / "config" / "bench.yaml"
WIDTH = 100
APPEARS = {
    "scene": "always",
    "road/patch": "scenes with `road` and `travel`",
    "platform/vibration": "scenes with `vibration`",
    "bench/steering": "runs whose parameters changed",
    "cost": "always",
    "state": "always; not recorded",
    "clock": "unless another node publishes it; not recorded",
    "health": "always; not recorded",
}
"""By name or kind of topic: when it appears, for those that no rig publishes."""
EXIT_CODES = {
    DONE: "done, or ended by the user",
    FAULT: "failed while running, or what is judged misses its band, limit or tolerance",
    REFUSED: "refused before anything started: scene, file, option, parameter or graph",
    LOSS: "finished, and messages are missing in the bag, or what is judged cannot be decided",
}


def reference(parameters: str) -> str:
    """All tables, as Markdown; `parameters` is the text of the nodes' parameter file."""
    return "\n\n".join([_topics(), _standard(), *_messages(), *_nodes(parameters), _exit_codes(), _renamed()])


def with_tables(document: str, parameters: str) -> str:
    """The document with its tables made anew.

    Raises:
        ValueError: one of the two marks is missing.
    """
    before, begin, rest = document.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"the document needs the lines {BEGIN!r} and {END!r}")
    return f"{before}{BEGIN}\n\n{reference(parameters)}\n\n{END}{after}"


def _topics() -> str:
    appears = _appearances()
    rows = [
        (f"`{topic.name}`", topic.type.replace("/msg/", "/"), _publisher(topic.name), topic.rate, appears[topic.name])
        for topic in TOPICS.values()
    ]
    return "## Topics\n\n" + _table(("topic", "type", "publisher", "a message comes", "it appears"), rows)


def _standard() -> str:
    """What `bench_view` and `bench export --ros-std` make of the topics; CONTACT stands for any contact."""
    rows: dict[str, tuple[str, ...]] = {}
    for topic in standard_topics([name for name, row in TOPICS.items() if row.recorded]).values():
        contact, _, rest = topic.source.partition("/")
        general = topic.name.count("/") == 2 and contact != "bench" and rest != "axle"
        name, source = (
            each.replace(f"{contact}/", "CONTACT/") if general else each for each in (topic.name, topic.source)
        )
        rows[name] = (f"`{name}`", topic.type.replace("/msg/", "/"), f"`{source}`", topic.content)
    return f"{STANDARD}\n\n{_table(('topic', 'type', 'made from', 'content'), rows.values())}"


def _publisher(topic: str) -> str:
    """The node that publishes a topic in a run, where its excitation is not made inside the simulator; a replay publishes
    what a bag holds.
    """
    return next((node for node, topics in PUBLISHED.items() if topic in topics and node != "bag_replay"), "")


def _appearances() -> dict[str, str]:
    """By topic: the rigs that publish it, and the effects or the key that it needs."""
    rows = {name: APPEARS.get(name) or APPEARS.get(topic.kind, "") for name, topic in TOPICS.items()}
    needed: dict[
        str, dict[str, list[str]]
    ] = {}  # topic -> rig -> effects or key, one of which it needs; empty for none
    for rig in rigs():
        for topic, condition in _conditions(rig):
            needed.setdefault(topic, {}).setdefault(rig, []).extend([condition] if condition else [])
    for topic, conditions in needed.items():
        by_condition: dict[str, list[str]] = {}
        for name, named in conditions.items():
            by_condition.setdefault(" or ".join(named), []).append(name)
        rows[topic] = "; ".join(_rigs(names, condition) for condition, names in by_condition.items())
    return rows


def _rigs(names: list[str], condition: str) -> str:
    named = "every rig" if names == [*rigs()] else f"rig{'s' * (len(names) > 1)} {', '.join(names)}"
    return f"{named} with {condition}" if condition else named


def _conditions(rig: str) -> Iterator[tuple[str, str]]:
    """Topics of one rig, each with what it needs beside the rig; one effect or key is switched on
    at a time.
    """
    base = _published(rig)
    yield from ((topic, "") for topic in base)
    for contact in rigs()[rig].contacts:
        for effect in contact.effects:
            added = [topic for topic in _published(rig, contact.name, effect.name) if topic not in base]
            yield from ((topic, f"`{effect.name}`") for topic in added)
        for key in {each.key for each in contact.topics if each.key}:
            added = [topic for topic in _published(rig, contact.name, key=key) if topic not in base]
            yield from ((topic, f"`{contact.name}.{key}`") for topic in added)


def _published(rig: str, contact: str = "", effect: str = "", key: str = "") -> list[str]:
    effects: dict[str, dict[str, Any]] = {contact.name: {} for contact in rigs()[rig].contacts}
    if effect:
        effects[contact][effect] = {}
    return result_topics(ResolvedScene({"rig": rig, "effects": effects, contact: {key: 1}}))


class FieldRow(NamedTuple):
    """One line of a message definition."""

    name: str
    type: str
    unit: str
    meaning: str


def message_fields(text: str) -> list[FieldRow]:
    """The fields and constants of a `.msg` text; the unit stands in brackets at the start of the
    comment.
    """
    found = []
    for line in text.splitlines():
        code, _, comment = line.partition("#")
        if not code.strip():
            continue
        kind, name = code.split(maxsplit=1)
        unit = re.match(r"\[([^]]*)\]\s*", comment.strip())
        meaning = comment.strip()[unit.end() :] if unit else comment.strip()
        name = name.strip() if "=" in name else name.split()[0]  # a default is no part of it
        found.append(FieldRow(name, kind, unit.group(1) if unit else "", meaning))
    return found


STANDARD = """\
## Standard topics

Of `bench_view` and of `bench export --ros-std`, at most 20 messages of a topic a second unless
requested; reliable and volatile, with a depth of 10. A run has those whose source it publishes, and
accelerometers of the bodies that it has. [view.md](view.md) explains frames and images."""
WRENCH = """\
### geometry_msgs/WrenchStamped

The forces of a contact on the upper body (wheel, occupant, sphere), in the contact's frame and
about its origin: `tire_contact` lies on the ground (z = 0 of the road) below the wheel centre,
`seat_contact` below the centre of the occupant, `backrest_contact` in the middle of the back (with
`cushion` at the lower edge of the seat back), `impact_contact` where the sphere falls. `force` is
friction along x and y, as in the contact's `force` topic, and the normal force along z. All forces
act in the plane z = 0; the normal one in the centre of pressure (x_c, y_c) of the last field or
points, so `torque` = (y_c F_z, -x_c F_z, M_z), M_z that of friction. Where a scene has neither
field nor points the torque is 0. About the axle of a tire, R_e above the ground, the moment is
`torque.y` - R_e `force.x`, which `moment_y` of `tire/axle` is in steady rolling; pressure on slopes
of the road is in `tire/axle` alone.
`block/wrench` is about the centre of mass of the body, its mean over a display period, in the
axes of the ground (in those of the world where frame_id is bench)."""


def own_types() -> list[str]:
    """Our message types in the order of the table of topics, then that of plug-ins."""
    ours = dict.fromkeys(topic.type for topic in TOPICS.values() if topic.type.startswith(f"{PACKAGE}/"))
    return [*ours, f"{PACKAGE}/msg/Series"]


def _messages() -> Iterator[str]:
    yield "## Messages\n\nThe unit of a field is SI; a field without one is a number, a flag or a text."
    for name in own_types():
        text = texts()[name]
        head = " ".join(line.lstrip("# ") for line in text.split("\n\n")[0].splitlines() if line.startswith("#"))
        rows = [(f"`{field.name}`", field.type, field.unit, field.meaning) for field in message_fields(text)]
        table = _table(("field", "type", "unit", "meaning"), rows)
        yield f"### {name.rpartition('/')[2]}\n\n{_wrapped(head)}\n\n{table}"
    yield WRENCH


def _nodes(parameters: str) -> Iterator[str]:
    yield "## Nodes"
    for node in PUBLISHED:
        if node in ("bench_run", "live_view"):
            continue  # the supervisor, and the command of the live page: they publish nothing
        kind = "lifecycle node" if node in LIFECYCLE else "plain node"
        services = "".join(f"; service `{name}`" for name in OWN_SERVICES.get(node, ()))
        services += "".join(f"; action `{name}`" for name in OWN_ACTIONS.get(node, ()))
        rows = [(f"`{name}`", value, meaning) for name, value, meaning in _parameters_of(node, parameters)]
        table = _table(("parameter", "default", "meaning"), rows)
        said = textwrap.fill(
            f"A {kind}{services}.{_subscribed(node)}", WIDTH, break_long_words=False, break_on_hyphens=False
        )
        yield f"### {node}\n\n{said}\n\n{table}"


def _subscribed(node: str) -> str:
    recorded = {name for name, topic in TOPICS.items() if topic.recorded}
    names = [*SUBSCRIBED[node]]
    if recorded <= {*names}:
        names = ["every recorded topic of the scene", *(f"`{name}`" for name in names if name not in recorded)]
    else:
        names = [f"`{name}`" for name in names]
    if node == "bench_view":
        return " Subscribes to the sources of its standard topics, while somebody reads these."
    return f" Subscribes to {', '.join(names)}." if names else ""


def _parameters_of(node: str, text: str) -> Iterator[tuple[str, str, str]]:
    """Name, default and comment of each parameter of a node."""
    section = text.partition(f"/**/{node}:\n")[2].partition("\n/**/")[0]
    for line in section.splitlines()[1:]:
        code, _, comment = line.partition("#")
        name, _, value = code.strip().partition(": ")
        yield name, f"`{value.strip()}`", comment.strip()


def _exit_codes() -> str:
    rows = [(str(code), meaning) for code, meaning in sorted(EXIT_CODES.items())]
    judging = (
        "`metrics`, `compare --tolerances`, `paper --figure`, `hard`, `validation` and `effects` judge, and end by one rule: "
        "1 on a miss, 3 where something could not be judged (doubtful, undefined, undecided, not reached, not hard), 0 where "
        "all holds."
    )
    head = "## Exit codes\n\nOf every `bench` command and of every node.\n\n"
    return head + textwrap.fill(judging, WIDTH) + "\n\n" + _table(("code", "meaning"), rows)


def _renamed() -> str:
    rows = [(f"`{old}`", f"`{new}`") for old, new in RENAMED.items()]
    rows += [(f"`{old}`", f"removed; {new} in its place") for old, new in REMOVED.items()]
    return f"## Renamed scene keys\n\n{_table(('old key', 'new key'), rows)}"


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    lines = [tuple(head), *(tuple(cell.replace("|", "\\|") for cell in row) for row in rows)]
    rows_as_text = [f"| {' | '.join(line)} |" for line in lines]
    return "\n".join([rows_as_text[0], "|---" * len(lines[0]) + "|", *rows_as_text[1:]])


def _wrapped(text: str) -> str:
    return "\n".join(textwrap.wrap(text, WIDTH, break_long_words=False, break_on_hyphens=False))


def main(arguments: list[str]) -> int:
    """Write the tables into the given document of a checkout."""
    path = Path(arguments[0])
    parameters = (path.resolve().parents[1] / PARAMETERS).read_text(encoding="utf-8")
    path.write_text(with_tables(path.read_text(encoding="utf-8"), parameters), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
