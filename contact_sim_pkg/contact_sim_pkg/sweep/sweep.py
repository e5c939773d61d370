"""A sweep: many cases of one scene, run over the processors, those that ran before left as they are."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path

from contact_sim_pkg.files import FileRefusedError, new_file, wrong_name
from contact_sim_pkg.report.metrics.curve_bands import CurveBand
from contact_sim_pkg.sweep.case import FINISHED, Row, Task, scene_of, sources_hash
from contact_sim_pkg.sweep.cluster import run_on_cluster
from contact_sim_pkg.sweep.kept import NONE, read_kept, worst_cases
from contact_sim_pkg.sweep.pool import Workers, run_all
from contact_sim_pkg.sweep.table import SweepTable
from contact_sim_pkg.sweep.variation import Values, Variation

__all__ = ["TABLE", "check_folder", "processors", "sweep", "texts_of", "try_ends", "write_table"]

TABLE, PARQUET, CASES = "table.csv", "table.parquet", "cases"

Notify = Callable[[str, float], None]
"""What is being done, and how much of it is done in [0, 1]."""


def try_ends(scene: str, variations: Sequence[Variation], values: Sequence[Values]) -> None:
    """Try what would be refused in every case before the first of them runs: the keys, both ends of each range, each
    value of a list. A combination that is impossible is found by its case.

    Raises SceneError, which names the option.
    """
    scene_of(scene, texts_of(values[0]))
    usual = values[0]
    tried = {(each.key, end) for each in variations for end in each.ends} - {*usual.items()}
    for key, end in sorted(tried):
        scene_of(scene, texts_of({**usual, key: end}))


def sweep(
    scene: str,
    values: Sequence[Values],
    folder: Path,
    *,
    jobs: int | None = None,
    scheduler: str = "",
    keep_bags: str = NONE,
    bands: tuple[CurveBand, ...] = (),
    notify: Notify = lambda _text, _done: None,
) -> SweepTable:
    """Run all cases of a scene and return their table, which is written to ``table.csv`` in the folder as well.

    Args:
        scene: a name or path.
        values: of each case, what it sets.
        folder: new, empty, or of a sweep: cases that it holds do not run again.
        jobs: processes; None: as many as there are processors.
        scheduler: address of a Dask scheduler whose workers run the cases in place of processes; empty: none.
        keep_bags: which bags stay, in ``bags``; see `read_kept`. The worst run once more, when they are known.
        bands: round curves, how far beyond which a run is among its metrics.
        notify: gets what is being done.

    Raises:
        FileRefusedError: the folder is none of a sweep.
        SceneError: the first case is refused.
        SweepError: ``keep_bags`` says nothing, or no case has its metric; the table is written then.
    """
    kept = read_kept(keep_bags)
    check_folder(folder)
    (folder / CASES).mkdir(parents=True, exist_ok=True)
    count = jobs or processors()
    tasks = [
        Task(number, scene, texts_of(each), str(folder.absolute()), kept.all, sources_hash(), bands=bands)
        for number, each in enumerate(values)
    ]
    rows: list[Row] = []
    try:
        progress = _Progress(len(tasks))
        notify(f"0 of {len(tasks)} cases", 0.0)
        for row in run_on_cluster(tasks, scheduler) if scheduler else _ordered(tasks, values, count):
            rows.append(row)
            notify(progress.after(row), len(rows) / len(tasks))
        if kept.number:
            again = [tasks[number]._replace(keeps_bag=True) for number in worst_cases(kept, rows)]
            notify(f"running the {len(again)} worst with their bags", 1.0)
            for row in run_on_cluster(again, scheduler) if scheduler else run_all(again, count):
                rows.append(row)
    finally:  # interrupted as well: what has ended is there
        table = SweepTable(values, rows)
        write_table(table, folder)
    return table


def write_table(table: SweepTable, folder: Path) -> None:
    """Write ``table.csv``, and ``table.parquet`` where pyarrow is installed."""
    with new_file(folder / TABLE, overwrite=True) as file:
        file.write(table.csv().encode())
    if find_spec("pyarrow") is not None:
        with new_file(folder / PARQUET, overwrite=True) as file:
            table.write_parquet(file)


def _ordered(tasks: Sequence[Task], values: Sequence[Values], jobs: int) -> Iterator[Row]:
    """The first case of each combination of effects alone, which compiles what the others of it load; then those."""
    first: dict[tuple[tuple[str, str], ...], Task] = {}
    for task, given in zip(tasks, values, strict=True):
        first.setdefault(tuple((key, value) for key, value in given.items() if not _is_number(value)), task)
    warming = list(first.values()) if len(first) <= len(tasks) // 2 else [tasks[0]]
    began = {task.number for task in warming}
    with Workers(jobs) as workers:  # the process that has begun goes on: a start costs as much as some cases
        for task in warming:
            yield from workers.run([task])
        yield from workers.run([task for task in tasks if task.number not in began])


def check_folder(folder: Path) -> None:
    """Refuse a folder that is not new, empty, or that of a sweep, before any work is done for it. Raises FileRefusedError."""
    if reason := wrong_name(folder):
        raise FileRefusedError(folder, reason)
    if not folder.exists():
        above = next(each for each in folder.absolute().parents if each.exists())
        if not above.is_dir():
            raise FileRefusedError(folder, f"{above} is no folder; give another name")
        return
    if not folder.is_dir():
        raise FileRefusedError(folder, "exists already and is no folder; give another name")
    if any(folder.iterdir()) and not (folder / CASES).is_dir():
        raise FileRefusedError(folder, "exists already and holds something else than a sweep; give another name")


def texts_of(values: Values) -> tuple[str, ...]:
    """What a case sets, as `--set` takes it."""
    return tuple(f"{key}={value}" for key, value in values.items())


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def processors() -> int:
    """Number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class _Progress:
    """`37 of 200 cases, 2 failed, 12 had run before`; counted, for to look at all rows after each is a square of them."""

    def __init__(self, count: int) -> None:
        self._count, self._ended, self._lost, self._again = count, 0, 0, 0

    def after(self, row: Row) -> str:
        """With one more."""
        self._ended += 1
        self._lost += row["outcome"] != FINISHED
        self._again += row.get("again", False)
        parts = [f"{self._ended} of {self._count} cases"]
        parts += [f"{self._lost} failed"] if self._lost else []
        parts += [f"{self._again} had run before"] if self._again else []
        return ", ".join(parts)
