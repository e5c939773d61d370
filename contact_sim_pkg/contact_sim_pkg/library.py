"""The bench as a library: a scene, its run, and the series of its bag as arrays."""

from __future__ import annotations

import shutil
import tempfile
import weakref
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from contact_sim_pkg.bag.errors import BagWriteError
from contact_sim_pkg.bag.reader import Bag, open_bag
from contact_sim_pkg.report.export.table import table_of
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["Series", "load_scene", "open_bag", "run", "series"]


def load_scene(name: str | Path, *values: str) -> ResolvedScene:
    """A scene by the name of a shipped one or the path of a file, with ``values`` such as
    ``"duration=0.5"`` set, resolved: nothing is left open.

    Raises SceneError with every fault.
    """
    return load_resolved(str(name), *values)


def run(scene: ResolvedScene | str | Path, directory: str | Path | None = None) -> Bag:
    """Run a scene offline, as fast as it goes, and return its bag.

    Args:
        scene: a scene, or its name or path.
        directory: of the bag, which must not exist; None: a temporary one, removed with the bag.

    Raises:
        SceneError: the scene is faulty.
        RunError: the physics or the excitation ended the run; the bag holds the blocks before.
        BagWriteError: the bag could not be written to its end.
    """
    found = scene if isinstance(scene, ResolvedScene) else load_scene(scene)
    folder = Path(tempfile.mkdtemp(prefix="contact_bench_")) if directory is None else None
    path = folder / found.name if folder is not None else Path(str(directory))
    try:
        outcome = run_offline(found, path)
        if outcome.failure:
            raise RunError(outcome.failure)
        if outcome.loss:
            raise BagWriteError(outcome.loss)
        bag = open_bag(path)
    except BaseException:
        if folder is not None:
            shutil.rmtree(folder, ignore_errors=True)
        raise
    if folder is not None:
        weakref.finalize(bag, shutil.rmtree, folder, ignore_errors=True)
    return bag


@dataclass(frozen=True)
class Series:
    """A topic of a bag, one row a sample.

    Attributes:
        topic: its full name.
        time: of each row [s].
        columns: arrays [rows] by name.
        units: by name of the column; empty where there is none.
    """

    topic: str
    time: NDArray[Any]
    columns: dict[str, NDArray[Any]]
    units: dict[str, str]

    def __getitem__(self, column: str) -> NDArray[Any]:
        """A column. Raises KeyError, which names those that are there."""
        if column not in self.columns:
            raise KeyError(f"{self.topic} has no column {column!r}; it has {', '.join(self.columns)}")
        return self.columns[column]

    def __iter__(self) -> Iterator[str]:
        """Names of the columns."""
        return iter(self.columns)

    def __len__(self) -> int:
        """Number of rows."""
        return len(self.time)

    def to_pandas(self) -> Any:
        """A pandas DataFrame, its index the time [s]. Raises ImportError where pandas is not
        installed.
        """
        import pandas

        return pandas.DataFrame(self.columns, index=pandas.Index(self.time, name="time"))


def series(bag: Bag | str | Path, topic: str) -> Series:
    """The series of a topic of a bag, or of the bag in a directory: samples of a block are rows, each
    with its own time; the pressure of a patch is read by ``bag.columns``.

    Raises BagError where there is no such topic, or it holds no numbers.
    """
    opened = bag if isinstance(bag, Bag) else open_bag(bag)
    time, *columns = table_of(opened, topic).columns
    return Series(
        opened.topic(topic).name, time.values, {each.name: each.values for each in columns},
        {each.name: each.unit for each in columns},
    )  # fmt: skip
