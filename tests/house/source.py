"""The modules of the package as syntax trees, and what imports what."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "contact_sim_pkg" / "contact_sim_pkg"
LABORATORY = PACKAGE.parents[1] / "contact_sim_lab" / "contact_sim_lab"
Function = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True)
class Module:
    """One module: dotted name below the package, text, syntax tree."""

    name: str
    path: Path
    text: str
    tree: ast.Module = field(repr=False)

    def functions(self) -> Iterator[Function]:
        """All functions, methods and inner ones included."""
        return (node for node in ast.walk(self.tree) if isinstance(node, Function))

    def docstring_lines(self) -> set[int]:
        """Numbers of the lines that docstrings take."""
        found: set[int] = set()
        for node in ast.walk(self.tree):
            body = getattr(node, "body", [])
            for each in body if isinstance(body, list) else []:
                if (
                    isinstance(each, ast.Expr)
                    and isinstance(each.value, ast.Constant)
                    and isinstance(each.value.value, str)
                ):
                    found.update(range(each.lineno, (each.end_lineno or each.lineno) + 1))
        return found

    def comment_lines(self) -> set[int]:
        """Numbers of the lines that hold a comment for readers, not one for tools."""
        tokens = tokenize.generate_tokens(io.StringIO(self.text).readline)
        comments = (token for token in tokens if token.type == tokenize.COMMENT)
        return {each.start[0] for each in comments if not re.match(r"# (?:fmt|noqa|type|mypy|pragma)\b", each.string)}

    def code_lines(self) -> int:
        """Lines that are not blank, comment or docstring."""
        left_out = self.docstring_lines()
        lines = enumerate(self.text.splitlines(), start=1)
        return sum(
            1 for number, line in lines if line.strip() and not line.lstrip().startswith("#") and number not in left_out
        )


def modules(package: Path = PACKAGE) -> dict[str, Module]:
    """Every module below the folder of a package, by its dotted name below it; packages by the name of their folder."""
    found = {}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package).with_suffix("").parts
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        text = path.read_text(encoding="utf-8")
        found[name] = Module(name, path, text, ast.parse(text))
    return found


def imports(found: dict[str, Module], package: str = PACKAGE.name) -> dict[str, set[str]]:
    """Modules of the package that each module imports, at its top or inside a function."""
    edges: dict[str, set[str]] = {name: set() for name in found}
    for name, module in found.items():
        for node in ast.walk(module.tree):
            if not isinstance(node, ast.ImportFrom) or not (node.module or "").startswith(package):
                continue
            base = (node.module or "").removeprefix(package).removeprefix(".")
            for alias in node.names:
                full = f"{base}.{alias.name}" if base else alias.name
                target = full if full in found else base
                if target in found and target != name:
                    edges[name].add(target)
    return edges


def circles(edges: dict[str, set[str]]) -> list[list[str]]:
    """Groups of modules that import each other, directly or through others (strongly connected components, Tarjan)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(node: str) -> None:
        index[node] = low[node] = len(index)
        stack.append(node)
        for target in sorted(edges[node]):
            if target not in index:
                visit(target)
                low[node] = min(low[node], low[target])
            elif target in stack:
                low[node] = min(low[node], index[target])
        if low[node] == index[node]:
            group = stack[stack.index(node) :]
            del stack[stack.index(node) :]
            if len(group) > 1:
                found.append(sorted(group))

    for node in sorted(edges):
        if node not in index:
            visit(node)
    return found
