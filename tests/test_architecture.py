"""The order of imports between the rooms of the package."""

import ast
import re

import pytest
from tests.house.closures import VEHICLE, arrows_back, folder_circles
from tests.house.source import LABORATORY, PACKAGE, Module, circles, imports, modules

from contact_sim_pkg.records.registry import kinds

ORDER = (
    ("requirements",),
    ("files", "public", "python_process"), ("memory",),
    ("records",), ("compiled",), ("integrate",), ("laws",), ("pressure", "rigid"), ("excitation",),
    ("scene",), ("bag",), ("run",), ("compare",), ("report",), ("rigs", "identify"),
    ("studies", "standard"), ("steering", "sweep"), ("view",), ("nodes",), ("cli",), ("answers",), ("library",),
)  # fmt: skip
"""A room imports from those before it, and from none beside it."""
RANK = {room: rank for rank, rooms in enumerate(ORDER) for room in rooms}
BESIDE = {("occupant", "vehicle"), ("occupant", "backrest")}
"""Rigs that import another rig: the occupant sits on a seat and against a seat back."""


@pytest.fixture(scope="module")
def found():
    return modules()


@pytest.fixture(scope="module")
def edges(found):
    return imports(found)


def room(name):
    return name.partition(".")[0]


def rig(name):
    parts = name.split(".")
    return parts[1] if parts[0] == "rigs" and len(parts) > 1 else ""


def against_the_order(name, target):
    """Whether an import, at the top of a module, in a function or for types, goes up or sideways."""
    if "" in (room(name), room(target)):  # what the package itself offers, on use
        return False
    if room(name) != room(target):
        return RANK[room(target)] >= RANK[room(name)]
    two = rig(name), rig(target)
    return "" not in two and two[0] != two[1] and two not in BESIDE


def test_every_room_has_its_place_in_the_order(found):
    assert {room(name) for name in found} - {""} == set(RANK)


def test_imports_go_one_way(edges):
    wrong = {(name, target) for name, targets in edges.items() for target in targets if against_the_order(name, target)}
    assert wrong == set()


def test_imports_are_absolute(found):
    """`tests.house.source.imports` sees no others."""
    relative = [
        name
        for name, module in found.items()
        for node in ast.walk(module.tree)
        if (isinstance(node, ast.ImportFrom) and node.level)
        or (isinstance(node, ast.Import) and any(alias.name.startswith(PACKAGE.name) for alias in node.names))
    ]
    assert relative == []


def test_an_import_against_the_order_is_seen():
    assert against_the_order("records.rig", "scene.resolve")
    assert against_the_order("pressure.layer", "rigid.body")
    assert against_the_order("rigs.impact.model", "rigs.roller.model")
    assert not against_the_order("rigs.occupant.simulation", "rigs.vehicle.model")
    assert not against_the_order("cli.main", "records.rig")


def bound_twice(tree):
    """Names that a module binds twice at its top; one that a condition or an exception chooses counts as bound once,
    and each part of a package that is imported has a name of its own.
    """
    bound = []
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            bound.append(node.name)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            bound += [alias.asname or alias.name for alias in node.names]
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names = (each for target in targets for each in ast.walk(target) if isinstance(each, ast.Name))
            bound += [each.id for each in names if isinstance(each.ctx, ast.Store)]
    return {name for name in bound if name != "_" and bound.count(name) > 1}


def test_no_module_binds_a_name_twice():
    everywhere = [
        each for root in (PACKAGE, LABORATORY, PACKAGE.parents[1] / "tests") for each in modules(root).values()
    ]
    assert {each.path: twice for each in everywhere if (twice := bound_twice(each.tree))} == {}


def test_a_name_that_is_bound_twice_is_seen():
    twice = "import numpy\nimport numpy.linalg\nLIMIT = 1e-12\nLIMIT: float = 1e-9\n"
    assert bound_twice(ast.parse(twice)) == {"LIMIT"}
    assert bound_twice(ast.parse("def run(): ...\nrun, stop = 1, 2")) == {"run"}
    assert bound_twice(ast.parse("try:\n    import a as b\nexcept ImportError:\n    b = None\n")) == set()


NAMED_PATH = re.compile(r"(?<![\w/.~<-])((?:[\w.-]+/)+[\w.-]*\w\.(?:py|md|yaml|msg|cpp|csv))\b")


def paths_that_are_not_there(module):
    """Paths of files in the docstrings of a module that stand in none of the folders that they may count from."""
    project = PACKAGE.parents[1]
    places = (project, PACKAGE, LABORATORY, PACKAGE.parent, project / "contact_msgs_defs", *module.path.parents)
    nodes = (each for each in ast.walk(module.tree) if isinstance(each, ast.Module | ast.FunctionDef | ast.ClassDef))
    named = {path for node in nodes for path in NAMED_PATH.findall(ast.get_docstring(node) or "")}
    return {path for path in named if not any((place / path).exists() for place in places)}


def test_files_that_docstrings_name_exist(tmp_path):
    everywhere = [each for root in (PACKAGE, LABORATORY) for each in modules(root).values()]
    assert {each.path: gone for each in everywhere if (gone := paths_that_are_not_there(each))} == {}
    stray = Module(
        "stray", tmp_path / "stray.py", "", ast.parse('"""See `laws/nowhere.py` and laws/elastic_law.py."""')
    )
    assert paths_that_are_not_there(stray) == {"laws/nowhere.py"}


def test_no_modules_import_each_other(edges):
    assert circles(edges) == []


def test_folders_import_their_neighbours_one_way(edges):
    assert folder_circles(edges) == []


def test_rooms_of_the_vehicle_import_by_layer(edges):
    assert arrows_back(edges, "rigs.vehicle", VEHICLE) == []


def test_an_arrow_back_is_seen():
    up_and_beside = {
        "rigs.vehicle.seat.lean": {"rigs.vehicle.tire.model"},
        "rigs.vehicle.field.driver": {"rigs.vehicle.motion"},
    }
    assert len(arrows_back(up_and_beside, "rigs.vehicle", VEHICLE)) == 2
    down = {
        "rigs.vehicle.tire.model": {"rigs.vehicle.seat.lean", "rigs.vehicle.tire.body"},
        "rigs.vehicle": {"rigs.vehicle.run"},
    }
    assert arrows_back(down, "rigs.vehicle", VEHICLE) == []


def test_nothing_of_the_product_imports_the_laboratory():
    """It names it once, as a text, to say what to install."""
    naming = {name for name, module in modules().items() if LABORATORY.name in module.text}
    assert naming == {"cli.laboratory", "cli.main"}
    assert not [name for name, module in modules().items() if f"from {LABORATORY.name}" in module.text]


def test_no_modules_of_the_laboratory_import_each_other():
    assert circles(imports(modules(LABORATORY), LABORATORY.name)) == []


def compared_with_a_kind(tree, names):
    """Lines that compare a `kind` with the name of a road or a vibration."""
    return [
        node.lineno
        for node in ast.walk(tree)
        if isinstance(node, ast.Compare) and re.search(r"""\.kind\b|\[?["']kind["']""", ast.unparse(node))
        if names & {each.value for each in ast.walk(node) if isinstance(each, ast.Constant) and each.value != "kind"}
    ]


def test_nobody_compares_the_kind_of_a_road_or_a_vibration():
    """Who wants to know asks the kind."""
    names = {*kinds("road"), *kinds("vibration")}
    everywhere = [each for root in (PACKAGE, LABORATORY) for each in modules(root).values()]
    assert {each.path: lines for each in everywhere if (lines := compared_with_a_kind(each.tree, names))} == {}
    assert compared_with_a_kind(
        ast.parse('if road.kind in ("bump", "step") or scene.get("kind") == "sine": ...'), names
    )
