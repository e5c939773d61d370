"""Processes that run cases, and what becomes of a case that takes its process with it."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import connection, resource_tracker
from threading import Thread
from typing import Any

from contact_sim_pkg.sweep.case import Numbered, Row, failed, run_case

__all__ = ["Workers", "run_all"]

ONE_THREAD = ("NUMBA_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")
ALONE = 2
"""Times that a case whose process ended is tried by itself."""

Work = Callable[[Any], Row]
"""Of what is `Numbered`."""


def run_all(tasks: Sequence[Numbered], jobs: int, work: Work = run_case) -> Iterator[Row]:
    """The rows of cases as they end, of ``jobs`` processes that begin and end with them; see `Workers`."""
    with Workers(jobs, work) as workers:
        yield from workers.run(tasks)


class Workers:
    """Processes of one thread each that run cases, until the block of code ends.

    As many cases are in the processes as there are of them: where one ends, killed or out of memory, these are suspects.
    Each is tried alone, `ALONE` times, and is a row that failed then.
    """

    def __init__(self, jobs: int, work: Work = run_case) -> None:
        """So many processes, begun with the first case."""
        self._jobs, self._work = jobs, work
        self._pool: ProcessPoolExecutor | None = None

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, *_error: object) -> None:
        if self._pool is not None:
            for process in list(
                (self._pool._processes or {}).values()
            ):  # whatever they are at: finished cases are kept
                process.kill()
            self._pool.shutdown(wait=False, cancel_futures=True)
            self._pool = None

    def run(self, tasks: Sequence[Numbered]) -> Iterator[Row]:
        """The rows of cases as they end."""
        waiting, deaths = deque(tasks), dict.fromkeys((task.number for task in tasks), 0)
        suspects: deque[Numbered] = deque()
        flying: dict[Future[Row], Numbered] = {}
        while waiting or suspects or flying:
            # Suspects fly alone, after those that were in the air
            while len(flying) < self._jobs and waiting and not suspects:
                task = waiting.popleft()
                flying[self._submit(task)] = task
            if not flying and suspects:
                task = suspects.popleft()
                flying[self._submit(task)] = task
            ended, _ = wait(flying, return_when=FIRST_COMPLETED)
            lost = []
            for future in ended:
                task = flying.pop(future)
                try:
                    yield future.result()
                except BrokenProcessPool:
                    lost.append(task)
            if lost:
                lost += flying.values()  # the pool has gone, with all of them
                alone = len(lost) == 1
                flying.clear()
                self.__exit__()
                for task in lost:
                    deaths[task.number] += alone
                    if deaths[task.number] >= ALONE:
                        yield failed(task, f"its process was killed or ran out of memory, {ALONE} times alone")
                    else:
                        suspects.append(task)

    def _submit(self, task: Numbered) -> Future[Row]:
        if self._pool is None:
            self._pool = _pool(self._jobs)
        with _one_thread(), _main_hidden(), _interrupt_held():
            try:
                return self._pool.submit(self._work, task)
            except BrokenProcessPool as error:  # one ended where no case was: this case is as one that was in the air
                broken: Future[Row] = Future()
                broken.set_exception(error)
                return broken


def _pool(jobs: int) -> ProcessPoolExecutor:
    """Begun anew, not forked: threads of compilers and of DDS do not survive a fork."""
    return ProcessPoolExecutor(jobs, multiprocessing.get_context("spawn"), _begin)


def _begin() -> None:
    """Who interrupts means the process that waits for this one, which ends it: the signal is held since this one began. Where
    that process has gone without a word, killed, this one goes too: it would wait for a case for ever.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        Thread(target=_end_after, args=(parent.sentinel,), daemon=True).start()


def _end_after(sentinel: int) -> None:
    connection.wait([sentinel])
    os._exit(1)


@contextmanager
def _one_thread() -> Iterator[None]:
    """While processes begin: each has one thread."""
    before = {name: os.environ.get(name) for name in ONE_THREAD}
    os.environ.update(dict.fromkeys(ONE_THREAD, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


@contextmanager
def _interrupt_held() -> Iterator[None]:
    """While processes begin: the interrupt of a terminal, which goes to all of them, does not end one that cannot ignore it
    yet. It reaches this process afterwards.
    """
    resource_tracker.ensure_running()  # its own start would let them through
    before = signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT,))
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _main_hidden() -> Iterator[None]:
    """While a process begins: it does not run the caller's own program again, which may have no guard against that."""
    main = vars(sys.modules["__main__"])
    kept: dict[str, Any] = {name: main.pop(name) for name in ("__file__", "__spec__") if name in main}
    main["__spec__"] = None
    try:
        yield
    finally:
        main.update(kept)
