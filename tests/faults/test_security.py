"""Strangers: on the network, in files, in packages (FAULTS part G)."""

import ast
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from packaging.requirements import Requirement
from packaging.version import Version
from tests.bench_process import Nodes, needs_ros, resolved, wait_until

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "contact_sim_pkg" / "contact_sim_pkg"
POLICY = ROOT / "contact_sim_pkg" / "config" / "sros2_policy.xml"

UNSAFE_IMPORTS = {"pickle", "cPickle", "dill", "marshal", "shelve", "joblib", "cloudpickle"}
UNSAFE_CALLS = {"eval", "exec", "compile", "os.system", "os.popen", "yaml.load", "__import__"}
TRUSTED = {
    "kernel_cache.py",  # numba's cache is pickled: of the user alone, with a hash in front (tests of G3)
    "sitecustomize.py",  # set-up: trees of one build, in the folder of the build that the same build has emptied
}


def unsafe_in(path: Path) -> list[str]:
    """What a module does that could run code from a file."""
    found = []
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found += [each.name for each in node.names if each.name in UNSAFE_IMPORTS]
        elif isinstance(node, ast.ImportFrom) and node.module in UNSAFE_IMPORTS:
            found.append(node.module)
        elif isinstance(node, ast.Call):
            name, given = ast.unparse(node.func), {each.arg: ast.unparse(each.value) for each in node.keywords}
            found += [name] if name in UNSAFE_CALLS else []
            found += [f"{name}(shell=True)"] if given.get("shell") == "True" else []
            loads = name in ("numpy.load", "np.load") and given.get("allow_pickle", "False") != "False"
            found += [name] if loads else []
            found += [name] if name.endswith("YAML") and given.get("typ") == "'unsafe'" else []
    return found


@pytest.mark.fault("G4")
def test_nothing_that_reads_files_can_run_what_stands_in_them():
    files = [path for root in (PACKAGE, ROOT / "ros2_ws" / "set_up") for path in root.rglob("*.py")]
    assert len(files) > 100
    assert {path.name: unsafe_in(path) for path in files if path.name not in TRUSTED and unsafe_in(path)} == {}


@pytest.mark.fault("G4")
def test_the_search_for_unsafe_calls_finds_them(tmp_path):
    bad = tmp_path / "bad.py"
    bad.write_text("import pickle\neval('1')\nsubprocess.run('x', shell=True)\nnumpy.load(f, allow_pickle=True)\n")
    assert unsafe_in(bad) == ["pickle", "eval", "subprocess.run(shell=True)", "numpy.load"]


def allowed(node: str) -> dict[str, set[str]]:
    """What the policy file allows a node: publish, subscribe, reply -> full names."""
    found: dict[str, set[str]] = {"publish": set(), "subscribe": set(), "reply": set()}
    for profile in ElementTree.parse(POLICY).iter("profile"):
        if profile.get("node") == node:
            for group in profile:
                for direction in set(found) & set(group.keys()):
                    names = [(each.text or "").replace("~", node) for each in group]
                    found[direction] |= {name if name.startswith("/") else f"/{name}" for name in names}
    return found


@pytest.mark.fault("G2")
def test_the_policy_of_sros2_is_the_one_that_the_table_of_topics_gives():
    from contact_sim_pkg.nodes.processes.sros2_policy import policy

    assert POLICY.read_text() == policy(), (
        "run python -m contact_sim_pkg.nodes.processes.sros2_policy > …/sros2_policy.xml"
    )


@needs_ros
@pytest.mark.fault("G2")
def test_the_policy_allows_what_the_nodes_of_a_run_do_and_nothing_beyond_the_table(tmp_path):
    """Against the graph of a run under way: every publisher, subscription and service of every node is allowed."""
    from tests.nodes.stand_in import StandIn

    nodes = Nodes(resolved("seat_ride", "duration=60"), tmp_path)
    try:
        with StandIn("looker", "road/patch") as looker:
            for name in ("bag_logger", "vibration", "contact_simulator"):
                nodes.start(name)
            wait_until(lambda: looker.node.count_publishers("seat/force") == 1)
            looker.wait_ready(0)
            graph = looker.node
            for name in ("bag_logger", "vibration", "contact_simulator"):
                lists = {
                    "publish": graph.get_publisher_names_and_types_by_node,
                    "subscribe": graph.get_subscriber_names_and_types_by_node,
                    "reply": graph.get_service_names_and_types_by_node,
                }
                wait_until(lambda name=name: (name, "/") in graph.get_node_names_and_namespaces())
                for direction, listed in lists.items():
                    wait_until(lambda listed=listed, name=name: listed(name, "/"))
                    seen = {topic for topic, _types in listed(name, "/")}
                    assert seen <= allowed(name)[direction], (name, direction)
    finally:
        nodes.end()
    assert "/tire/force" not in allowed("vibration")["publish"]


@pytest.mark.fault("G7")
def test_every_range_of_the_package_holds_the_versions_that_the_tests_run_with_and_has_an_end():
    text = (ROOT / "contact_sim_pkg" / "setup.py").read_text()
    block = re.search(r"install_requires=\[(.*?)\]", text, re.DOTALL)
    ranges = [Requirement(each) for each in re.findall(r'"([^"]+)"', block[1])]
    locked: dict[str, set[Version]] = {}
    for line in (ROOT / "ros2_ws" / "requirements.txt").read_text().splitlines():
        if "==" in line and not line.startswith("#"):
            pin = Requirement(line)
            locked.setdefault(pin.name.lower(), set()).add(Version(str(pin.specifier).removeprefix("==")))
    for each in ranges:
        versions = locked[each.name.lower()]
        assert all(each.specifier.contains(version) for version in versions), each
        assert any(part.operator == "<" for part in each.specifier), f"{each} has no upper bound"
