"""The one place for compile options: every compiled function of the core is decorated here.

`@kernel` marks a compiled helper that other compiled functions call (`@borrowing_kernel` one that
makes no array), `@entry` a compiled function that Python calls. A kernel is linked into the machine
code of its callers, or called by its symbol where it is large (`compiled/linking.py`). What stands
between Python and machine code is compiled for calls from Python alone: with the wide parameter
tuples of a rig it would take a third of the time to compile. Both release the interpreter lock, follow the NumPy error
model (1/0 is inf, never an exception half-way through an update), forbid `fastmath` (which removes
guards against NaN) and are kept on disk (`compiled/kernel_cache.py`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, TypeVar

import numba
from numba.core import entrypoints
from numba.extending import overload

from contact_sim_pkg.compiled import linking
from contact_sim_pkg.compiled.call_graph import Call, CallGraph
from contact_sim_pkg.compiled.compiler import compiled_kernels, compiler_of
from contact_sim_pkg.compiled.kernel_cache import attach_cache

__all__ = [
    "COMPILE_OPTIONS",
    "borrowing_kernel",
    "calls_of",
    "closed",
    "compiled_functions",
    "compiled_kernels",
    "entry",
    "kernel",
    "kernel_overload",
    "never_called",
]

COMPILE_OPTIONS: dict[str, Any] = {
    "nopython": True, "nogil": True, "error_model": "numpy", "fastmath": False, "no_cfunc_wrapper": True,
}  # fmt: skip

# numba's extensions, which it would look for at the first compilation, and fail for good at a package whose description is
# damaged. It does not look twice.
with suppress(Exception):
    entrypoints.init_all()  # type: ignore[no-untyped-call]

Function = TypeVar("Function", bound=Callable[..., Any])

_kernels: list[Any] = []
_entries: list[Any] = []


def kernel(function: Function) -> Function:
    """Compile a helper that other compiled functions call; a call from Python compiles it once
    more, as an entry.
    """
    return _kernel(function)


def borrowing_kernel(function: Function) -> Function:
    """As `kernel`, for a helper that makes no array and returns none: it works on arrays that its
    caller holds.

    numba then counts no references to them, which otherwise costs two atomic operations for every
    array of every tuple at every call: half the time of an integrator's step. A helper that makes
    an array is refused when it is compiled.
    """
    return _kernel(function, _nrt=False)


def _kernel(function: Function, **options: Any) -> Function:
    compiled: Any = _compile(function, **options)
    _kernels.append(compiled)
    if hasattr(compiled, "overloads"):  # with NUMBA_DISABLE_JIT=1 it is a plain Python function
        bare: Any = _compile(function, "bare", no_cpython_wrapper=True, **options)
        compiled.get_call_template, compiled.get_overload = bare.get_call_template, bare.get_overload
        _kernels.append(bare)
    return compiled  # type: ignore[no-any-return]


def entry(function: Function) -> Function:
    """Compile a function that is called from Python; inside `closed` it takes no argument types not
    seen before.
    """
    compiled = _compile(function)
    _entries.append(compiled)
    return compiled


def kernel_overload(function: Callable[..., Any], *, thin: bool = False) -> Callable[[Function], Function]:
    """Register a compiled implementation of `function`, chosen by argument types, with the compile
    options of kernels.

    As `numba.extending.overload`: the decorated function receives the argument *types* and returns
    the implementation or `None`. The body is compiled into its caller, so it is cached with the
    caller. thin: it makes no array, as a `borrowing_kernel`, and stands in its caller whatever LLVM thinks of
    it: for what only hands on, since what is passed costs by its width.
    """
    options = dict(COMPILE_OPTIONS, pipeline_class=compiler_of(is_entry=False))
    if thin:
        options.update(_nrt=False, forceinline=True)
    decorator: Callable[[Function], Function] = overload(function, jit_options=options)  # type: ignore[arg-type]
    return decorator


@contextmanager
def closed() -> Iterator[None]:
    """While a run is running: an entry called with new argument types raises `TypeError` at once.

    Entries that were never called are closed as well: they raise instead of compiling in the middle
    of a run. The closing acts on the whole process and ends with the block of code, so any number
    of scenes can be prepared and run one after another.
    """
    linking.stop()
    _set_open(False)
    try:
        yield
    finally:
        _set_open(True)


def _set_open(may_compile: bool) -> None:
    for function in _dispatchers(_entries):
        # disable_compile() refuses entries that have no compiled version yet
        function._can_compile = may_compile


def compiled_functions() -> list[Any]:
    """Every decorated function of the process, entries first: for checks of options and of cache
    statistics.
    """
    return [*_entries, *_kernels]


def never_called() -> list[Any]:
    """Entries that have no compiled version, which `closed` refuses: what a warm-up left out."""
    return [function for function in _dispatchers(_entries) if not function.overloads]


def calls_of(run: Callable[[], Any]) -> tuple[CallGraph, set[Call]]:
    """Which compiled functions call which in what ``run`` makes, and those that Python calls.

    Versions from before are forgotten, and come from the cache again where they are needed.
    """
    for function in _dispatchers(compiled_functions()):
        function.overloads.clear()
        function._reset_overloads()
    run()
    found = _dispatchers(compiled_functions())  # of modules that the run has loaded as well
    return linking.call_graph(each.library for function in found for each in function.overloads.values())


def _compile(function: Function, form: str = "", **options: Any) -> Function:
    is_entry = not form
    compiled = numba.jit(**COMPILE_OPTIONS, **options, pipeline_class=compiler_of(is_entry=is_entry))(function)
    linking.register(function, compiled, is_entry=is_entry)
    attach_cache(compiled, form)
    return compiled  # type: ignore[no-any-return]


def _dispatchers(functions: list[Any]) -> list[Any]:
    """Only compiled functions: with NUMBA_DISABLE_JIT=1 the decorators hand back plain Python
    functions.
    """
    return [function for function in functions if hasattr(function, "overloads")]
