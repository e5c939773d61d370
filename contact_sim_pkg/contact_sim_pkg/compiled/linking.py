"""Kernels as intermediate code that is linked into machine code once, instead of being optimised
at each level of calls.

numba optimises a function together with all that it calls, and turns it into machine code, even
where only other compiled functions call it: a kernel at the bottom of six levels is optimised six
times and more. Here a kernel stays intermediate code until a function needs machine code: an entry
that Python calls, or a kernel that has grown to `LARGEST_LINKED` with all that is linked into it.
Such a large kernel is compiled once and called by its symbol; it is not looked into, which costs
nothing at its size. What is inlined where is LLVM's choice: results may differ from those of another
way of linking in the last digits.

Machine code is made by a second process (`assembler.py`) while this one types and lowers the next
kernels; whatever Python is about to call waits for it.

All that leans on numba's inside stands here, there, in `compiler.py` and in `kernel_cache.py`.
"""

# numba has no types.
# mypy: disallow-untyped-calls=False

from __future__ import annotations

import atexit
import importlib
from collections.abc import Callable, Iterable
from concurrent.futures import CancelledError, Future
from typing import Any, NamedTuple

import llvmlite.binding as llvm
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompileResult, compile_result
from numba.core.compiler_lock import require_global_compiler_lock
from numba.core.environment import lookup_environment

from contact_sim_pkg.compiled.assembler import DYNAMIC, ENVIRONMENT, Assembler, Assembly, assemble
from contact_sim_pkg.compiled.call_graph import Call, CallGraph, call_of, edges_between, graph_of

__all__ = [
    "KernelLibrary",
    "Overload",
    "call_graph",
    "finish",
    "make_at_once",
    "rebuild",
    "reduce",
    "register",
    "stop",
    "when_loaded",
]

LARGEST_LINKED = 60_000
"""[bytes of bitcode] A kernel that is larger, with all that would be linked into it, becomes
machine code of its own."""

Function = tuple[str, str, bool]  # module, qualified name, whether Python calls it

_dispatchers: dict[Function, Any] = {}
_assembler = Assembler()
_awaited: list[KernelLibrary] = []  # in the order of their submission, callees first
_when_loaded: list[Callable[[], None]] = []  # what waits for machine code: files of the cache


class Overload(NamedTuple):
    """A kernel for one combination of argument types, by which another process finds it."""

    function: Function
    types: tuple[Any, ...]

    def library(self) -> KernelLibrary:
        """Its code, from the cache on disk or compiled anew."""
        if self.function not in _dispatchers:
            importlib.import_module(self.function[0])
        dispatcher = _dispatchers[self.function]
        dispatcher.compile(self.types)
        library: KernelLibrary = dispatcher.overloads[self.types].library
        return library


class KernelLibrary(JITCodeLibrary):
    """Code of one overload: intermediate code, or machine code where ``is_machine_code``."""

    def __init__(self, codegen: Any, name: str, overload: Overload | None, *, is_machine_code: bool) -> None:
        """``overload``: None for a function inside another, which nobody can import.
        ``is_machine_code``: of an entry.
        """
        super().__init__(codegen, name)
        self.overload = overload
        self.is_machine_code = self.is_entry = is_machine_code
        self.callees: dict[KernelLibrary, None] = {}  # in the order of their calls
        self._size = 0
        self._awaited: Future[Assembly] | None = None  # machine code in the making
        self._code = b""  # machine code, as it goes to disk
        self._called: list[KernelLibrary] = []  # by symbol
        self._calls: tuple[tuple[Call, Call], ...] = ()  # in its machine code
        self._symbols: list[str] = []  # functions that it defines itself
        self._environments: tuple[str, ...] = ()
        self.enable_object_caching()

    @property
    def codegen(self) -> Any:
        """numba's generator of code; one that sets no variables of an engine which does not know
        them.
        """
        return self._codegen if self.is_loaded else _WithoutEngine(self._codegen)

    @property
    def is_loaded(self) -> bool:
        """Whether it can be called: machine code that has arrived."""
        return self.is_machine_code and self._finalized and self._awaited is None

    def add_linking_library(self, library: Any) -> None:
        """numba announces what the function calls."""
        library._ensure_finalized()
        if isinstance(library, KernelLibrary) and library.overload is not None:
            self.callees[library] = None
            return
        self._linking_libraries.append(library)
        if isinstance(library, KernelLibrary):
            self.callees.update(library.callees)

    def finalize(self) -> None:
        """End of the function's own code: keep it as it is, or make machine code where it is
        wanted.
        """
        require_global_compiler_lock()
        self._raise_if_finalized()
        self._symbols = [each.name for each in self._final_module.functions if not each.is_declaration]
        for library in dict.fromkeys(self._linking_libraries):
            self._reload_init.update(library._reload_init)
            module = library.own_module() if isinstance(library, KernelLibrary) else library._get_module_for_linking()
            self._final_module.link_in(module, preserve=True)
        for callee in self.callees:
            self._reload_init.update(callee._reload_init)
        linked, self._called = self._all_callees()
        grown = self.overload is not None and self.size() + sum(each.size() for each in linked) > LARGEST_LINKED
        self.is_machine_code = self.is_machine_code or grown
        if not self.is_machine_code:
            self._finalize_dynamic_globals()
            self._finalized = True
            return
        self._calls = tuple(dict.fromkeys(edges_between((self, *linked))))
        for each in linked:
            self._final_module.link_in(each.own_module(), preserve=True)
        self._refuse_unknown_symbols()
        self._awaited = _assembler.submit(self._final_module.as_bitcode())
        self._finalized = True
        _awaited.append(self)
        if self.is_entry or _assembler.is_here:
            finish()

    def _refuse_unknown_symbols(self) -> None:
        """An unknown function would end the process when its caller is loaded."""
        known = {name for each in self._called for name in each._symbols}
        for function in self._final_module.functions:
            if function.is_declaration and function.name.startswith("_ZN") and function.name not in known:
                raise RuntimeError(f"{self.name}: nothing defines {function.name}")

    def load_awaited(self) -> None:
        """Wait for the machine code and hand it to numba's engine, with the names that it defines."""
        assert self._awaited is not None
        try:
            self._code, variables = self._awaited.result()
        except CancelledError:  # stopped with a compilation that was broken off
            self._code, variables = assemble(self._final_module.as_bitcode())
        self._awaited = None
        self._environments = tuple(name for name in variables if name.startswith(ENVIRONMENT))
        self._dynamic_globals += [name for name in variables if name.startswith(DYNAMIC)]
        self._load()
        for name in self._environments:
            environment = lookup_environment(name)
            if environment is not None:
                self.codegen.set_env(name, environment)

    def _load(self) -> None:
        # The engine asks for object code when it is given the module, which may then be empty
        self._final_module = llvm.parse_assembly(str(self._codegen._create_empty_module(self.name)))
        self._set_compiled_object(self._code)
        self._finalize_final_module()
        self._codegen._engine._defined_symbols.update(self._symbols)

    def environments(self) -> tuple[Any, ...]:
        """Globals of the functions in its machine code that can be kept on disk."""
        found = map(lookup_environment, self._environments)
        return tuple(each for each in found if each is not None and each.can_cache())

    def _all_callees(self) -> tuple[list[KernelLibrary], list[KernelLibrary]]:
        """What is linked into machine code of this function, and what it calls by symbol.

        Callers come before what they call: LLVM leaves out a function that nothing needs yet.
        """
        linked: list[KernelLibrary] = []
        called: dict[KernelLibrary, None] = {}
        seen = {self}

        def visit(library: KernelLibrary) -> None:
            for each in library.callees:
                if each.is_machine_code:
                    called[each] = None
                elif each not in seen:
                    seen.add(each)
                    visit(each)
                    linked.append(each)

        visit(self)
        return linked[::-1], list(called)

    def calls(self) -> tuple[tuple[Call, Call], ...]:
        """Calls of its own, and of what is linked into it."""
        return self._calls if self.is_machine_code else tuple(edges_between((self,)))

    def size(self) -> int:
        """Length of its own intermediate code [bytes]."""
        if not self._size:
            self._size = len(self._final_module.as_bitcode())
        return self._size

    def own_module(self) -> Any:
        """Its own intermediate code, ready to be linked into others; without content where it is
        machine code.
        """
        self._ensure_finalized()
        if self._shared_module is None:
            if self.is_machine_code:
                self._shared_module = llvm.parse_assembly(str(self._codegen._create_empty_module(self.name)))
            else:
                self._shared_module = self._final_module.clone()
                for function in self._shared_module.functions:
                    if not function.is_declaration and function.linkage == llvm.Linkage.external:
                        function.linkage = "linkonce_odr"  # several of one name may meet, and an unused one goes
        return self._shared_module

    def _get_module_for_linking(self) -> Any:
        """For a library of numba's own, which knows nothing of callees: all in one module."""
        finish()  # numba makes machine code of its own at once
        module = self.own_module()
        if self.is_machine_code or not self.callees:
            return module
        module = module.clone()
        for each in self._all_callees()[0]:
            module.link_in(each.own_module(), preserve=True)
        return module

    def get_pointer_to_function(self, name: str) -> int:
        """Its address; 0 where there is no machine code."""
        self._ensure_finalized()
        address: int = super().get_pointer_to_function(name) if self.is_loaded else 0
        return address

    def reduce(self) -> tuple[Any, ...]:
        """What goes to disk: code, and the overloads that must be there before it is used, with the
        names of their functions.
        """
        if self.is_machine_code:
            code, needed = self._code, self._called
        else:
            code, needed = self._final_module.as_bitcode(), list(self.callees)
        wanted = [(each.overload, each._symbols) for each in needed]
        return self.name, self.overload, self.is_machine_code, code, self._symbols, wanted, self._calls

    @classmethod
    def rebuild(cls, codegen: Any, reduced: tuple[Any, ...]) -> KernelLibrary | None:
        """The library from `reduce`; None where an overload that it needs is not the one that it
        was made with: another process may have compiled it with other flags, which numba takes over
        from the first caller, or linked it where it was machine code.
        """
        name, overload, is_machine_code, code, symbols, wanted, calls = reduced
        self = cls(codegen, name, overload, is_machine_code=is_machine_code)
        self._symbols, self._calls = symbols, calls
        for each, names in wanted:
            library = each.library()
            if not set(names) <= set(library._symbols) or (is_machine_code and not library.is_machine_code):
                return None
            self.callees[library] = None
        if not is_machine_code:
            self._final_module = llvm.parse_bitcode(code)
            self._finalized = True
            return self
        finish()  # what it calls may have been compiled anew
        self._code, self._called = code, list(self.callees)
        self._load()
        return self


class _WithoutEngine:
    """A generator of code for a function that has no machine code, and so no variables to set."""

    def __init__(self, codegen: Any) -> None:
        self._codegen = codegen

    def set_env(self, name: str, environment: Any) -> None:
        """Nothing to do: done by the machine code that the function is linked into."""

    def __getattr__(self, name: str) -> Any:
        return getattr(self._codegen, name)


def register(function: Callable[..., Any], dispatcher: Any, *, is_entry: bool) -> None:
    """Let other processes' code find the overloads of a decorated function."""
    _dispatchers[function.__module__, function.__qualname__, is_entry] = dispatcher


def call_graph(libraries: Iterable[Any]) -> tuple[CallGraph, set[Call]]:
    """Calls of the functions whose libraries are given, direct or not; and those among them that
    Python calls.
    """
    entries = {
        library: call_of(library.overload)
        for library in libraries
        if isinstance(library, KernelLibrary) and library.overload is not None and library.overload.function[2]
    }
    known, waiting, edges = set(entries), list(entries), list[tuple[Call, Call]]()
    while waiting:
        library = waiting.pop()
        edges += library.calls()
        for each in (*library.callees, *library._called):
            if each not in known:
                known.add(each)
                waiting.append(each)
    roots = set(entries.values())
    return graph_of(edges, roots), roots


def finish() -> None:
    """Wait until all machine code is made and loaded, and written where a cache asked for that."""
    while _awaited:
        if not _awaited[0].is_loaded:  # an interrupt came between loading and leaving the list
            _awaited[0].load_awaited()
        del _awaited[0]
    while _when_loaded:
        _when_loaded.pop(0)()


def make_at_once() -> None:
    """In this process, without another: each kernel is on disk as soon as it is compiled."""
    _assembler.is_here = True


def when_loaded(result: Any, action: Callable[[], None]) -> None:
    """Do it at once, or after `finish` where the machine code of a compiled function is in the
    making.
    """
    library = result.library
    if isinstance(library, KernelLibrary) and library.is_machine_code and not library.is_loaded:
        _when_loaded.append(action)
    else:
        action()


def stop() -> None:
    """End the second process; it starts again where it is needed."""
    _assembler.stop()


atexit.register(stop)


def reduce(result: Any) -> tuple[Any, ...]:
    """A compiled function as plain data, for the cache on disk."""
    if not isinstance(result.library, KernelLibrary):
        return (None, *result._reduce())
    environments = result.library.environments()
    described = result.fndesc
    described.typemap = described.calltypes = None  # as numba does: only the compiler needs them
    return (
        result.library.reduce(), described, result.environment, result.signature, tuple(result.reload_init), environments,
    )  # fmt: skip


def rebuild(target: Any, payload: tuple[Any, ...]) -> Any:
    """The compiled function from `reduce`; None where it must be compiled again."""
    if payload[0] is None:
        return CompileResult._rebuild(target, *payload[1:])
    reduced, described, environment, signature, reload_init, environments = payload
    for function in reload_init:
        function()
    codegen = target.codegen()
    library = KernelLibrary.rebuild(codegen, reduced)
    if library is None:
        return None
    result = compile_result(
        typing_context=target.typing_context, target_context=target, library=library, signature=signature, fndesc=described,
        entry_point=target.get_executable(library, described, environment), environment=environment, type_annotation="",
        objectmode=False, lifted=(), reload_init=list(reload_init), referenced_envs=environments,
    )  # fmt: skip
    for each in environments:
        codegen.set_env(each.env_name, each)
    return result
