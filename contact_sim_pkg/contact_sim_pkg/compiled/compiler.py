"""numba's compiler for entries and kernels: with a library of code of our own (`linking.py`), names
that are the same in each process, few garbage collections and one piece of memory for frames.

With a version of numba whose inside this was not tested with (`tested.py`), functions are compiled in
numba's own way: slower, same numbers.
"""

# numba has no types.
# mypy: disallow-untyped-calls=False

from __future__ import annotations

import gc
import uuid
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from typing import Any, TypeVar

from numba.core.compiler import Compiler
from numba.core.errors import NumbaTypeError

from contact_sim_pkg.compiled import companion
from contact_sim_pkg.compiled.claims import given_back_on_failure
from contact_sim_pkg.compiled.linking import KernelLibrary, Overload
from contact_sim_pkg.compiled.tested import IS_TESTED

__all__ = ["compiled_kernels", "compiler_of"]

Result = TypeVar("Result")

_compiled = 0  # overloads, by this process


def compiled_kernels() -> int:
    """Number of overloads of entries and kernels that this process has compiled, not loaded."""
    return _compiled


class _KernelCompiler(Compiler):
    """numba's compiler with a `KernelLibrary`, and a name of the function that is the same in each
    process.
    """

    is_entry = False

    def _compile_bytecode(self) -> Any:
        state, function = self.state, self.state.func_id
        overload = None
        if "<locals>" not in function.func_qualname:  # else nobody can import it
            overload = Overload((function.modname, function.func_qualname, self.is_entry), tuple(state.args))
        # Names of symbols: of an overload the same in each process; of a function that only numba can tell from
        # others of its name, found in no other process, for its code is kept on disk inside that of its callers
        function.unique_id = uuid.uuid4().int if overload is None else zlib.crc32(repr(overload).encode())
        function.unique_name = f"{function.func_qualname}${function.unique_id}"
        companion.begin()
        codegen = state.targetctx.codegen()
        state.library = KernelLibrary(codegen, function.func_qualname, overload, is_machine_code=self.is_entry)
        with _few_collections(), given_back_on_failure() if overload is not None else nullcontext():
            result = _on_a_large_stack(super()._compile_bytecode)
        _refuse_uncounted_array(state, result.signature.return_type)
        global _compiled
        _compiled += overload is not None
        return result


def _refuse_uncounted_array(state: Any, returned: Any) -> None:
    """Raise TypeError where a kernel that counts no references returns an array, or a tuple that
    holds one: its caller would give back a reference that nobody took.
    """
    if not state.flags.nrt and state.targetctx.data_model_manager[returned].contains_nrt_meminfo():
        raise NumbaTypeError(
            f"borrowing_kernel {state.func_id.func_qualname} returns {returned}: it must return no array"
        )


class _EntryCompiler(_KernelCompiler):
    is_entry = True


@contextmanager
def _few_collections() -> Iterator[None]:
    """A compilation makes many objects and little garbage: looking for it took a tenth of the time."""
    before = gc.get_threshold()
    gc.set_threshold(100_000, 50, 1000)
    try:
        yield
    finally:
        gc.set_threshold(*before)


def _on_a_large_stack(function: Callable[[], Result]) -> Result:
    """``function()``, and all that it calls in one piece of memory.

    Python keeps the frames of calls in pieces of 16 KiB. The compiler calls itself some hundred
    levels deep; wherever a piece is full, every further call takes a new one from the system and
    gives it back, which was a sixth of the time. A frame that claims 560 kB makes a piece of 1 MiB.
    """
    return function()


_on_a_large_stack.__code__ = _on_a_large_stack.__code__.replace(co_stacksize=70_000)


def compiler_of(*, is_entry: bool) -> type[Compiler] | None:
    """The compiler of entries or of kernels; None, numba's own, where its version was not tested."""
    if not IS_TESTED:
        return None
    return _EntryCompiler if is_entry else _KernelCompiler
