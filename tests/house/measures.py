"""What `make measures` prints: each measure of the package's shape, what it was, what it is, what is wanted.

The column *before* is the state of 2026-11, before the package was ordered by rigs; of lines of code that of 372f7ee,
counted by today's rules, rigs that are not among the roots left out.
"""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Callable
from typing import NamedTuple

from tests.house.closures import FRAME, VEHICLE, arrows_back, closure, code_of, folder_circles
from tests.house.patches import PATCHES, shared_files
from tests.house.source import Function, Module, circles, imports, modules

WIDE = 8  # positional arguments
LONG = 20  # lines of a function
MANY_EFFECTS = 4  # names of effects in one module that make it a table of them
_SYMBOL = r"(?:(?:[munpkMG]?(?:m|s|N|Pa|J|W|Hz|rad|kg|g|K|A|V|B|iB)|deg|°C|%))"
UNIT = re.compile(
    rf"\[(?:1|{_SYMBOL})(?:\^?-?[\d.]+)?(?:[ /*·(]+{_SYMBOL}?\)?(?:\^?-?[\d.]+)?\)?)*\]|\bdimensionless\b"
)
SHAPE = re.compile(
    r"\[(?:\w+(?: [-+*] \d+)?)(?:, (?:\w+|\.\.\.)(?: [-+*] \d+)?)+\]|\[(?!rad\]|deg\])[a-z_]{3,}\]|\bone (?:for )?(?:a|each|per)\b"
)
NUMBER = re.compile(r"\bfloat\b")
ARRAY = re.compile(r"Vector|Matrix|NDArray|Array")


class Measure(NamedTuple):
    """One row: what is measured, before and wanted as words, today as measured."""

    what: str
    before: str
    today: str
    wanted: str


def measure() -> list[Measure]:
    """All rows, in the order of the table."""
    found = list(modules().values())
    own = [module for module in found if module.text.strip()]
    edges = imports(modules())
    shared = {name: str(len(shared_files(name))) for name in PATCHES}
    nodes = [module for module in own if re.fullmatch(r"nodes\.\w+", module.name)]
    by_name = modules()
    return [
        *_closures(by_name),
        Measure("circles of imports between neighbours, one a folder", "8", f"{len(folder_circles(edges))}", "0"),
        Measure("arrows back inside rigs/vehicle", "5", f"{len(arrows_back(edges, 'rigs.vehicle', VEHICLE))}", "0"),
        Measure("circles of imports", "3", f"{len(circles(edges))}", "0"),
        Measure("tables of effects", "5", f"{1 + len(tables_of_effects(own))}", "1"),  # the records are one
        *(
            Measure(
                f"{'all' if patch.whole else 'shared'} files edited for a new {name}",
                patch.before,
                shared[name],
                patch.wanted,
            )
            for name, patch in PATCHES.items()
        ),
        Measure(f"calls with {WIDE} or more positional arguments", "206", f"{len(wide_calls(own))}", "< 40"),
        Measure("class names defined twice", "60", f"{len(doubled_classes(own))}", "< 10"),
        Measure(f"functions of {LONG} lines or more with a comment", "18 %", commented(own), "> 50 %"),
        Measure(
            "public functions of numbers whose docstring names units", "53 %", _documented(own, NUMBER, UNIT), "> 80 %"
        ),
        Measure(
            "public functions of arrays whose docstring names shapes", "31 %", _documented(own, ARRAY, SHAPE), "> 80 %"
        ),
        Measure("lines of the longest node", "188", f"{max(len(m.text.splitlines()) for m in nodes)}", "<= 150"),
    ]


def _closures(found: dict[str, Module]) -> list[Measure]:
    """Lines of code that are carried with something."""
    frame = closure(found, FRAME)
    rigs = {
        name: code_of(found, closure(found, (*FRAME, f"rigs.{name}")))
        for name in ("vehicle", "body", "backrest", "impact", "roller")
    }
    others = [rigs[name] for name in ("backrest", "impact", "roller")]
    return [
        Measure(
            "lines of code of the frame: run, report, replay, nodes",
            "13115",
            f"{code_of(found, frame)}",
            "<= 12500 + new",
        ),
        Measure("frame and vehicle", "27766", f"{rigs['vehicle']}", "<= 25500"),
        Measure("frame and body", "25041", f"{rigs['body']}", "<= 20000"),
        Measure("frame and any other rig", "17898 to 19713", f"{min(others)} to {max(others)}", "<= 20000"),
        Measure("the whole product", "58170", f"{code_of(found, found)}", "about 49000 + new"),
    ]


def wide_calls(found: list[Module]) -> list[str]:
    """Places of calls with many positional arguments; `*args` counts as one."""
    return [
        f"{module.name}:{node.lineno}"
        for module in found
        for node in ast.walk(module.tree)
        if isinstance(node, ast.Call) and len(node.args) >= WIDE and not _varies(node.func)
    ]


def _varies(function: ast.expr) -> bool:
    """Whether a function takes any number of like arguments by its nature."""
    name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
    return name in {"max", "min", "print", "chain", "zip", "join"}


def doubled_classes(found: list[Module]) -> list[str]:
    """Names that more than one module gives to a class."""
    names = Counter(node.name for module in found for node in module.tree.body if isinstance(node, ast.ClassDef))
    return sorted(name for name, number in names.items() if number > 1)


def commented(found: list[Module]) -> str:
    """Part of the long functions that hold a comment, as words."""
    of, with_one = 0, 0
    for module in found:
        comments = module.comment_lines()
        for function in module.functions():
            first, last = function.body[0].lineno, function.end_lineno or 0
            if last - function.lineno + 1 >= LONG:
                of, with_one = of + 1, with_one + any(number in comments for number in range(first, last + 1))
    return _share(with_one, of)


def _documented(found: list[Module], applies: re.Pattern[str], names: re.Pattern[str]) -> str:
    """Part of the public functions with such an argument or result whose docstring holds the pattern, as words."""
    texts = [
        ast.get_docstring(function) or ""
        for module in found
        for function in _public(module)
        if applies.search(_annotations(function))
    ]
    return _share(sum(bool(names.search(text)) for text in texts), len(texts))


def _public(module: Module) -> list[Function]:
    return [node for node in module.tree.body if isinstance(node, Function) and not node.name.startswith("_")]


def _annotations(function: Function) -> str:
    given = [each.annotation for each in (*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs)]
    return " ".join(ast.unparse(each) for each in (*given, function.returns) if each is not None)


def tables_of_effects(found: list[Module]) -> list[str]:
    """Modules outside a rig's own records that name many effects as text."""
    from contact_sim_pkg.records.registry import effects

    names = set(effects())
    counted: dict[str, int] = {}
    for module in found:
        if re.fullmatch(r"rigs\..*\.effects", module.name):
            continue
        skipped = module.docstring_lines()
        texts = {
            node.value
            for node in ast.walk(module.tree)
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and node.lineno not in skipped
        }
        counted[module.name] = len(texts & names)
    return sorted(name for name, number in counted.items() if number >= MANY_EFFECTS)


def _share(part: int, of: int) -> str:
    return f"{100.0 * part / of:.0f} %" if of else "none"


LISTS: dict[str, Callable[[list[Module]], list[str]]] = {
    "wide-calls": wide_calls, "doubled-classes": doubled_classes, "tables-of-effects": tables_of_effects,
}  # fmt: skip
"""What `python -m tests.house NAME` lists one by one."""
