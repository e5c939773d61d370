"""Cases on the workers of a Dask scheduler: the same tasks as of the processes of one machine."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator, Sequence
from importlib import import_module
from importlib.util import find_spec
from typing import Any
from urllib.parse import urlsplit

from contact_sim_pkg.sweep.case import Row, Task, failed, machine, run_case, sources_hash
from contact_sim_pkg.sweep.variation import SweepError

__all__ = ["run_on_cluster"]

WAIT = 3.0
"""[s] that a scheduler has to answer."""


def run_on_cluster(tasks: Sequence[Task], address: str) -> Iterator[Row]:
    """The rows of cases as they end, of the workers of the scheduler at ``tcp://host:port``.

    As many cases are out as there are workers, each released when its row is here. Dask tries a case of a worker that ended
    on others, as often as its ``distributed.scheduler.allowed-failures`` says; then it is a row that failed. The folder of
    the sweep has to be one that all workers see.

    Raises SweepError: Dask is not installed, nobody answers within 3 s, there is no worker, or a worker has other sources of
    the bench.
    """
    client = _client(address)
    try:
        distributed = import_module("distributed")
        workers = _workers(client, address)
        waiting = iter(tasks)
        out: dict[Any, Task] = {}

        def submit() -> Any:
            task = next(waiting, None)
            if task is None:
                return None
            future = client.submit(run_case, task, pure=False)
            out[future] = task
            return future

        first = [future for _ in range(workers) if (future := submit()) is not None]
        running = distributed.as_completed(first, loop=client.loop)
        for future in running:
            task = out.pop(future)
            error = future.exception()
            yield future.result() if error is None else failed(task, _sentence(error))
            # What has been fetched would be computed again where its worker dies
            future.release()
            after = submit()
            if after is not None:
                running.add(after)
    finally:
        client.close()


def _client(address: str) -> Any:
    parts = urlsplit(address)
    try:
        port = parts.port
    except ValueError:
        port = None
    if parts.scheme not in ("tcp", "tls") or not parts.hostname or port is None:
        raise SweepError(f"--scheduler {address}: is not of the form tcp://host:8786")
    try:  # before Dask is loaded, which takes as long
        socket.create_connection((parts.hostname, port), timeout=WAIT).close()
    except OSError as error:
        raise SweepError(
            f"--scheduler {address}: nobody answers there ({error}); start it by `dask scheduler`"
        ) from None
    if find_spec("distributed") is None:
        raise SweepError("--scheduler needs Dask, which is not installed; pip install distributed, or leave it out")
    try:
        return import_module("distributed").Client(address, timeout=WAIT, set_as_default=False)
    except (OSError, TimeoutError, ValueError, MemoryError) as error:
        raise SweepError(
            f"--scheduler {address}: is no scheduler of Dask that answers within {WAIT:g} s ({error})"
        ) from None


def _workers(client: Any, address: str) -> int:
    """Number of cases that run at once. Raises SweepError where there is none, or their bench is another one."""
    threads: dict[str, int] = client.nthreads()
    if not threads:
        raise SweepError(f"--scheduler {address}: has no worker; start some by `dask worker {address} --nthreads 1`")
    many = sorted(each for each, count in threads.items() if count != 1)
    if many:
        raise SweepError(
            f"--scheduler {address}: the worker {many[0]} has {threads[many[0]]} threads; give it --nthreads 1"
        )
    try:
        sources: dict[str, str] = client.run(sources_hash)
        machines: dict[str, str] = client.run(machine)
    except (ImportError, AttributeError) as error:
        raise SweepError(f"--scheduler {address}: a worker lacks the bench, or has another version: {error}") from None
    others = sorted(each for each, found in sources.items() if found != sources_hash())
    if others:
        raise SweepError(
            f"--scheduler {address}: the worker {others[0]} has other sources of the bench than this process"
        )
    kinds = sorted({*machines.values()})
    if len(kinds) > 1:
        raise SweepError(
            f"--scheduler {address}: the workers are unlike ({'; '.join(kinds)}), so that bits would hang on who ran a case"
        )
    return len(threads)


def _sentence(error: BaseException) -> str:
    if type(error).__name__ == "KilledWorker":
        return "the workers that ran it were killed or ran out of memory"
    return f"{type(error).__name__}: {error}".replace(os.linesep, " ")
