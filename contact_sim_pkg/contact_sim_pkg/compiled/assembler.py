"""A second process that optimises intermediate code and makes machine code of it, while this one
goes on with the next kernel.

Half of a compilation is Python (types, lowering), half LLVM, which llvmlite allows one thread of a
process at a time. So modules go to a process of their own, as bitcode; object code comes back. The
process knows nothing of kernels. It ends when its input ends; where it cannot be started, or dies,
this process does the work itself.
"""

# numba has no types.
# mypy: disallow-untyped-calls=False

from __future__ import annotations

import subprocess
import sys
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from typing import IO, NamedTuple

import llvmlite.binding as llvm
from numba.core.codegen import JITCPUCodegen

__all__ = ["DYNAMIC", "ENVIRONMENT", "Assembler", "Assembly", "assemble"]

ENVIRONMENT = "_ZN08NumbaEnv"
"""Leads the names of numba's variables that point to the globals of a function."""

DYNAMIC = "numba.dynamic.globals"
"""Leads the names of those that hold an address of this process: such code is not kept on disk."""

_PROGRAM = """
import sys
sys.path[:] = sys.argv[1:]
from contact_sim_pkg.python_process import disregard_current_folder
disregard_current_folder()
from contact_sim_pkg.compiled import assembler
assembler.serve(sys.stdin.buffer, sys.stdout.buffer)
"""


_LENGTH_BYTES = 8  # in front of what goes through the pipes


class Assembly(NamedTuple):
    """Machine code of a module."""

    code: bytes  # object file
    variables: tuple[str, ...]  # names of `ENVIRONMENT` and `DYNAMIC` that are left in it


class Assembler:
    """Makes machine code of one module after the other, in the order in which they were submitted."""

    def __init__(self) -> None:
        """Starts nothing yet."""
        self.is_here = False  # without a process of its own
        self._process: subprocess.Popen[bytes] | None = None
        self._queue: ThreadPoolExecutor | None = None

    def submit(self, bitcode: bytes) -> Future[Assembly]:
        """Machine code of ``bitcode``, once it is there; starts the process at the first call."""
        if self.is_here:
            done: Future[Assembly] = Future()
            done.set_result(assemble(bitcode))
            return done
        if self._queue is None:
            self._queue = ThreadPoolExecutor(1, "assembler")
            self._queue.submit(self._start)
        return self._queue.submit(self._ask, bitcode)

    def stop(self) -> None:
        """End the process, and give up what was submitted; a later `submit` starts another."""
        queue, self._queue = self._queue, None
        if queue is not None:
            queue.shutdown(wait=False, cancel_futures=True)
            self._end()
            queue.shutdown()
            self._end()  # where it was about to start

    def _start(self) -> None:
        try:
            self._process = subprocess.Popen(
                [sys.executable, "-c", _PROGRAM, *sys.path],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                start_new_session=True,  # an interrupt from the keyboard is for this process; the other follows
            )
        except OSError:
            self._process = None

    def _ask(self, bitcode: bytes) -> Assembly:
        if self._process is not None:
            assert self._process.stdin is not None
            assert self._process.stdout is not None
            try:
                _send(self._process.stdin, bitcode)
                code, names = _receive(self._process.stdout), _receive(self._process.stdout)
            except (OSError, EOFError, ValueError):
                if self._queue is None:
                    raise CancelledError from None
                self._end()
            else:
                return Assembly(code, tuple(names.decode().split()))
        return assemble(bitcode)

    def _end(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()


def assemble(bitcode: bytes) -> Assembly:
    """Optimised machine code of a module, as numba itself would make it."""
    global _codegen
    if _codegen is None:
        _codegen = JITCPUCodegen("contact_sim_pkg.compiled.assembler")
    library = _codegen.create_library("assembled")
    module = llvm.parse_bitcode(bitcode)
    library._final_module = module
    library._optimize_final_module()
    module = library._final_module
    module.verify()
    names = (variable.name for variable in module.global_variables if not variable.is_declaration)
    kept = tuple(name for name in names if name.startswith((ENVIRONMENT, DYNAMIC)))
    return Assembly(_codegen._tm.emit_object(module), kept)


_codegen: JITCPUCodegen | None = None


def serve(requests: IO[bytes], answers: IO[bytes]) -> None:
    """Answer until the input ends."""
    while True:
        try:
            bitcode = _receive(requests)
        except EOFError:
            return
        code, names = assemble(bitcode)
        _send(answers, code)
        _send(answers, " ".join(names).encode())


def _send(stream: IO[bytes], content: bytes) -> None:
    stream.write(len(content).to_bytes(_LENGTH_BYTES, "little") + content)
    stream.flush()


def _receive(stream: IO[bytes]) -> bytes:
    size = int.from_bytes(_exactly(stream, _LENGTH_BYTES), "little")
    return _exactly(stream, size)


def _exactly(stream: IO[bytes], size: int) -> bytes:
    content = stream.read(size)
    if len(content) < size:
        raise EOFError
    return content
