"""Finds the function, or the constant of a module, that a mutant names, and changes its text."""

import ast
from pathlib import Path

from tests.mutants.listed import Mutant

PACKAGES = ("contact_sim_pkg/contact_sim_pkg", "contact_sim_lab/contact_sim_lab")


def file_of(mutant: Mutant, checkout: Path) -> Path:
    """The one file of a checkout's packages that holds the mutant's text, exactly once, in the function that it
    names.
    """
    module = mutant.function.split(".")[0]
    paths = [path for package in PACKAGES for path in (checkout / package).rglob(f"{module}.py")]
    found = [path for path in paths if _count(mutant, path.read_text()) == 1]
    if len(found) != 1:
        raise LookupError(f"{mutant.function}: {mutant.text!r} stands once in {len(found)} files, it must be 1")
    return found[0]


def mutated(mutant: Mutant, source: str) -> str:
    """The source with the mutant's text replaced."""
    start, end = _span(mutant, source)
    return source[:start] + source[start:end].replace(mutant.text, mutant.becomes) + source[end:]


def noticing(mutant: Mutant, tests: Path) -> list[str]:
    """What pytest is given: the test modules, or single tests, that must notice the mutant."""
    found = []
    for name in mutant.tests:
        module, _, test = name.partition("::")
        paths = [
            path
            for path in tests.rglob(f"{module}.py")
            if not test or f"def {test.partition('[')[0]}(" in path.read_text()
        ]
        if not paths:
            raise LookupError(f"{mutant.function}: there is no test {name}")
        found += [f"{path}::{test}" if test else str(path) for path in paths]
    return found


def _count(mutant: Mutant, source: str) -> int:
    start, end = _span(mutant, source)
    return source[start:end].count(mutant.text)


def _span(mutant: Mutant, source: str) -> tuple[int, int]:
    """Where its text begins and ends, a function's without its docstring; an empty span where the file has neither."""
    node: ast.AST | None = ast.parse(source)
    for name in mutant.function.split(".")[1:]:
        inside = [each for each in ast.iter_child_nodes(node) if name in _names(each)] if node else []
        node = inside[0] if inside else None
    if isinstance(node, ast.FunctionDef):
        first = node.body[1 if ast.get_docstring(node) else 0]
    elif isinstance(node, ast.Assign):
        first = node
    else:
        return 0, 0
    lines = source.splitlines(keepends=True)
    return sum(map(len, lines[: first.lineno - 1])), sum(map(len, lines[: node.end_lineno]))


def _names(node: ast.AST) -> list[str]:
    """Names that a statement defines: of a function, a class, a constant."""
    if isinstance(node, ast.Assign):
        return [target.id for target in node.targets if isinstance(target, ast.Name)]
    return [node.name] if isinstance(node, ast.FunctionDef | ast.ClassDef) else []
