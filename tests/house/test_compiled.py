"""No compiled function copies a slice: numba compiles the text of an error about shapes into it, which costs seconds of
the first start. `compiled.vectors.copy_row` does the same without.
"""

import ast

from tests.house.source import Function, modules

COMPILED = ("entry", "kernel")
PLAIN = (ast.Constant, ast.UnaryOp)  # a number for all
NAMED = {"numpy.nan", "numpy.inf"}


def is_compiled(function: Function) -> bool:
    """Whether one of the decorators compiles it."""
    return any(ast.unparse(each).split("(")[0].endswith(COMPILED) for each in function.decorator_list)


def copies(function: Function) -> list[int]:
    """Lines that write what may be an array into a slice."""
    return [
        node.lineno
        for node in ast.walk(function)
        if isinstance(node, ast.Assign)
        and any(isinstance(part, ast.Slice) for target in node.targets for part in ast.walk(target))
        and not isinstance(node.value, PLAIN)
        and ast.unparse(node.value) not in NAMED
    ]


def test_no_compiled_function_copies_a_slice() -> None:
    found = [
        f"{name}:{line}"
        for name, module in modules().items()
        for function in module.functions()
        if is_compiled(function)
        for line in copies(function)
    ]
    assert found == []


def test_a_copy_is_found() -> None:
    [function] = ast.parse("@kernel\ndef f(a, b):\n    a[:] = 0.0\n    a[:2] = b\n    a[1] = b[0]\n").body
    assert isinstance(function, ast.FunctionDef)
    assert is_compiled(function)
    assert copies(function) == [4]
