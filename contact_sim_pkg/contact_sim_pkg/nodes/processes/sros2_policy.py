"""The SROS2 policy of the bench, made from the table of topics: each node may do what it does, and
nothing else.

    python -m contact_sim_pkg.nodes.processes.sros2_policy > contact_sim_pkg/config/sros2_policy.xml

Schema: sros2 policy 0.2.0, which the ROS design article "ROS 2 Access Control Policies" describes.
"""

import sys
from collections.abc import Iterable
from xml.etree import ElementTree

from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.standard.topics import standard_topics
from contact_sim_pkg.view.scope import SHOWN

LIFECYCLE = ("contact_simulator", "bag_logger", "bag_replay", "bench_view", "live_view")
_VIEW = standard_topics([name for name, topic in TOPICS.items() if topic.recorded])
PUBLISHED = {
    "road_profile": ("road/patch",),
    "vibration": ("platform/vibration",),
    "contact_simulator": tuple(name for name in TOPICS if name != "bench/recorded"),
    "bag_logger": ("bench/recorded",),
    "bag_replay": tuple(name for name, topic in TOPICS.items() if topic.recorded or topic.kind == "clock"),
    "bench_view": tuple(_VIEW),
    "live_view": (),
    "bench_run": (),
}
SUBSCRIBED = {
    "road_profile": ("bench/progress", "bench/recorded"),
    "vibration": ("bench/progress", "bench/recorded"),
    "contact_simulator": ("road/patch", "platform/vibration", "bench/recorded"),
    "bag_logger": (*(name for name, topic in TOPICS.items() if topic.recorded), "bench/progress"),
    "bag_replay": (),
    "bench_view": tuple(dict.fromkeys(source for topic in _VIEW.values() for source in topic.sources)),
    "live_view": SHOWN,
    "bench_run": ("bench/progress", "bench/recorded"),
}
PARAMETER_SERVICES = (
    "~/describe_parameters",
    "~/get_parameter_types",
    "~/get_parameters",
    "~/list_parameters",
    "~/set_parameters",
    "~/set_parameters_atomically",
)
OWN_SERVICES = {
    "bag_replay": ("~/pause",),
    "contact_simulator": (
        "~/get_simulation_state", "~/get_simulator_features", "~/reset_simulation", "~/set_simulation_state",
        "~/step_simulation",
    ),
}  # fmt: skip
OWN_ACTIONS = {"contact_simulator": ("~/simulate_steps",)}
REQUESTED = {"live_view": ("bag_replay/pause", "contact_simulator/change_state")}
LIFECYCLE_SERVICES = (
    "~/change_state",
    "~/get_available_states",
    "~/get_available_transitions",
    "~/get_state",
    "~/get_transition_graph",
)


def policy() -> str:
    """The policy as XML text: one enclave a node, `/contact_bench/NODE`."""
    root = ElementTree.Element("policy", version="0.2.0")
    enclaves = ElementTree.SubElement(root, "enclaves")
    for node in PUBLISHED:
        enclave = ElementTree.SubElement(enclaves, "enclave", path=f"/contact_bench/{node}")
        profiles = ElementTree.SubElement(enclave, "profiles")
        profile = ElementTree.SubElement(profiles, "profile", ns="/", node=node)
        own = ("~/transition_event",) if node in LIFECYCLE else ()
        _allow(profile, "topics", "publish", (*PUBLISHED[node], *own, "parameter_events", "rosout"))
        _allow(profile, "topics", "subscribe", SUBSCRIBED[node])
        services = (*LIFECYCLE_SERVICES, *OWN_SERVICES.get(node, ())) if node in LIFECYCLE else ()
        parameters = () if node == "bench_run" else PARAMETER_SERVICES
        _allow(profile, "services", "reply", (*parameters, *services, "~/get_type_description"))
        _allow(profile, "services", "request", REQUESTED.get(node, ()))
        _allow(profile, "actions", "execute", OWN_ACTIONS.get(node, ()))
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _allow(profile: ElementTree.Element, kind: str, direction: str, names: Iterable[str]) -> None:
    listed = sorted(set(names))
    if listed:
        group = ElementTree.SubElement(profile, kind, {direction: "ALLOW"})
        for name in listed:
            ElementTree.SubElement(group, kind[:-1]).text = name


if __name__ == "__main__":
    sys.stdout.write(policy())
