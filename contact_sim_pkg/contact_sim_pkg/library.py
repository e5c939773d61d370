"""The bench as a library: a scene, its run, the series and metrics of its bag, and two bags side by side."""

from __future__ import annotations

import shutil
import tempfile
import weakref
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from contact_sim_pkg.bag import reader
from contact_sim_pkg.bag.errors import BagWriteError
from contact_sim_pkg.bag.parts.find import parts_of
from contact_sim_pkg.cli.output.working import doing, working
from contact_sim_pkg.records.table import table_html
from contact_sim_pkg.report.export.table import table_of
from contact_sim_pkg.report.export.time_series import Series, series_of
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.live_parameters import Change, block_at
from contact_sim_pkg.run.offline import RunProgress, run_offline
from contact_sim_pkg.scene.load import load_scene as load_checked
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

if TYPE_CHECKING:
    from contact_sim_pkg.answers import Answers
    from contact_sim_pkg.compare.side_by_side import ComparedMetric
    from contact_sim_pkg.records.metric import Metric
    from contact_sim_pkg.sweep.fit import Fit
    from contact_sim_pkg.sweep.table import SweepTable

__all__ = ["Bag", "Series", "compare", "fit", "load_scene", "open_bag", "run", "series", "sweep"]


def load_scene(name: str | Path, *values: str, within: Mapping[str, float] | None = None) -> ResolvedScene:
    """A scene by the name of a shipped one or the path of a file, resolved: nothing is left open.

    Args:
        name: of the scene, or its path.
        values: such as ``"duration=0.5"``.
        within: relative numerical error that metrics may have, ``{"seat.factor": 0.005}``, in place of one ``accuracy``: steps
            and cells are then as loose as they allow, found by short runs where these pay.

    Raises:
        SceneError: with every fault.
        BagError, RunError: of ``within``: the scene has no such metric, or a short run ends early.
    """

    def made(*more: str) -> ResolvedScene:
        return resolve(load_checked(str(name), [set_value(each, "the value ") for each in (*values, *more)]))

    if not within:
        return made()
    from contact_sim_pkg.studies.accuracy.by_metric import choose

    return choose(lambda accuracy: made(f"accuracy={accuracy:g}"), within, doing).scene


def open_bag(path: str | Path, *, skip_bad: bool = False) -> Bag:
    """Open the bag in a directory or a file, of the bench or of anybody; ``skip_bad`` goes on after damaged chunks.

    Raises BagError where there is none, or its texts do not hold.
    """
    return Bag(parts_of(Path(path), skip_bad=skip_bad), skip_bad)


def run(
    scene: ResolvedScene | str | Path, directory: str | Path | None = None, *, progress: bool = True,
    changes: Mapping[float, Mapping[str, float]] | None = None,
) -> Bag:  # fmt: skip
    """Run a scene offline, as fast as it goes, and return its bag.

    Args:
        scene: a scene, or its name or path.
        directory: of the bag, which must not exist; None: a temporary one, removed with the bag.
        progress: whether a run that lasts more than a second is shown on standard error, its compiling too.
        changes: values of live keys (docs/steering.md) by the time [s] from which on they hold, the start of a block.

    Raises:
        SceneError: the scene is faulty.
        ParameterError: a change is refused.
        RunError: the physics or the excitation ended the run; the bag holds the blocks before.
        BagWriteError: the bag could not be written to its end.
    """
    found = scene if isinstance(scene, ResolvedScene) else load_scene(scene)
    made = [
        Change(block_at(found, time), key, value)
        for time, values in (changes or {}).items()
        for key, value in values.items()
    ]
    folder = Path(tempfile.mkdtemp(prefix="contact_bench_")) if directory is None else None
    path = folder / found.name if folder is not None else Path(str(directory))
    try:
        with working(f"{found.name}: starting") if progress else nullcontext():
            outcome = run_offline(found, path, _show, on_set_up=doing, changes=made)
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


def _show(progress: RunProgress) -> None:
    if progress.simulated > 0.0:
        text = f"{progress.simulated:.2f} s simulated, {progress.real_time_factor:.2f}x real time"
        doing(text, progress.block / progress.blocks)


def sweep(
    scene: str | Path, directory: str | Path, *varied: str, sample: str = "grid", seeds: int = 0, sample_seed: int = 1,
    jobs: int | None = None, scheduler: str = "", keep_bags: str = "none", progress: bool = True,
) -> SweepTable:  # fmt: skip
    """Run many cases of a scene over the processors and return the table of their metrics, as `bench sweep` does.

    Args:
        scene: a name or path.
        directory: new, empty, or of a sweep: a case that it holds does not run again.
        varied: what varies, ``"travel.speed=5:20:4"``, ``"road.roughness_class=A,B,C"``; ``:log`` behind a range for
            equal ratios.
        sample: ``grid``, ``lhs:N``, ``sobol:N``, ``saltelli:N``, or a CSV file whose header names keys.
        seeds: each case so many times, with seeds from 1; 0: the seed of the scene.
        sample_seed: of what is drawn.
        jobs: processes, of one thread each; None: as many as processors.
        scheduler: ``tcp://host:8786`` of a Dask scheduler whose workers run the cases in place of processes.
        keep_bags: which bags stay, in ``bags`` of the directory: ``none``, ``all``, ``worst:3:seat.factor`` (largest),
            ``worst:3:tire.load_smallest > 300`` (which hold it least).
        progress: whether it is shown on standard error.

    Raises:
        SweepError: nothing varies, or not so.
        SceneError: a key or a value is refused; a combination that is impossible is a row that says so.
    """
    from contact_sim_pkg.sweep.sweep import sweep as run_cases
    from contact_sim_pkg.sweep.sweep import try_ends
    from contact_sim_pkg.sweep.variation import read_variation, samples_of

    variations = [read_variation(each) for each in varied]
    values = samples_of(variations, sample, seeds, sample_seed)
    try_ends(str(scene), variations, values)
    with working(f"{len(values)} cases: starting") if progress else nullcontext():
        return run_cases(
            str(scene), values, Path(str(directory)), jobs=jobs, scheduler=scheduler, keep_bags=keep_bags, notify=doing
        )


def fit(
    scene: str | Path, to: str | Path, *free: str, directory: str | Path, metrics: Sequence[str] = (),
    series: str | Sequence[str] = "",
    fixed: Sequence[str] = (), shift: float = 0.02, by: str = "series", jobs: int | None = None, progress: bool = True,
) -> Fit:  # fmt: skip
    """Fit keys of a scene to what was measured, as `bench fit` does.

    Args:
        scene: a name or path.
        to: a table of points with ``metrics``, a bag or a table over time with ``series``, T(f) over frequency.
        free: keys with their ranges, ``"tire.suspension_damping=500:4000:log"``.
        directory: new, empty, or of this fit; ``fitted.yaml`` is written there.
        metrics: columns of the points, metrics by their keys.
        series: ``topic.column`` of a run that is compared over time; by ``transmissibility`` the accelerations of floor
            and seat in the recording, none of a table over frequency or a bag of the bench.
        fixed: set in every run, ``"duration=2"``.
        by: what of a series is compared: ``series`` its samples, ``spectrum`` its densities; ``transmissibility`` that of
            a seat.
        shift: [s] most that a recording may be late or early; 0 holds it.
        jobs: processes; None: as many as processors.
        progress: whether it is shown on standard error.

    Raises:
        SweepError: it cannot be fitted so, or a run failed.
        SceneError: a key or the end of a range is refused.
    """
    from contact_sim_pkg.sweep.fit import fit as fit_keys
    from contact_sim_pkg.sweep.measured import read_measured
    from contact_sim_pkg.sweep.variation import read_variation

    found = [read_variation(each, "") for each in free]
    named = (series,) if isinstance(series, str) and series else tuple(series)
    measured = read_measured(Path(str(to)), metrics, named, by)
    given = {key.strip(): value.strip() for key, _, value in (each.partition("=") for each in fixed)}
    with working("fit: starting") if progress else nullcontext():
        return fit_keys(
            str(scene),
            measured,
            found,
            Path(str(directory)),
            fixed=given,
            jobs=jobs,
            most_shift=shift,
            by_spectrum=by == "spectrum",
            notify=doing,
        )


class Bag(reader.Bag):
    """A bag that is read, with the answers of the bench on it. In a notebook it shows its topics."""

    def metrics(self) -> Answers[Metric]:
        """The metrics of the run with their bands and verdicts, those of `bench metrics`; of a bag of anybody what its
        vibration gives. Raises BagError where there is nothing to measure.
        """
        from contact_sim_pkg.answers import metrics

        return metrics(self)

    def report(self, out: str | Path | None = None, *, check: bool = False, overwrite: bool = False) -> Path:
        """Write the report of the bag, one HTML page that needs nothing beside it: that of `bench report`.

        Args:
            out: file to write; None: `report.html` beside the bag, which goes with a temporary bag.
            check: whether a finer run is made beside parts of it, so that the page has the accuracy that was delivered.
            overwrite: whether another file of that name is replaced; a page of the bench is made again anyway.

        Returns:
            Where the page is.

        Raises:
            BagError: the bag cannot be read, or was not made by a run.
            FileRefusedError: `out` is another file, or part of the bag.
        """
        from contact_sim_pkg.report.reading import scenes_fit
        from contact_sim_pkg.report.report import write_report

        checked = None
        if check:
            from contact_sim_pkg.compare.delivered import check_bag

            checked = check_bag(self.path, doing)
        with scenes_fit([self]):
            return write_report(self, None if out is None else Path(out), check=checked, overwrite=overwrite)

    def _repr_html_(self) -> str:
        rows = [
            {"topic": name, "type": row.type, "messages": self.count(name)}
            for name, row in self.topics.items() if self.count(name)
        ]  # fmt: skip
        return table_html(rows, f"{self.path}: {'complete' if self.complete else '; '.join(self.notes)}")


def compare(*bags: Bag | str | Path) -> Answers[ComparedMetric]:
    """The metrics of bags of one rig side by side, what moved most first: those of `bench compare`.

    Raises BagError where they are of different rigs, or have no metrics.
    """
    from contact_sim_pkg import answers

    return answers.compare(*(each if isinstance(each, Bag) else open_bag(each) for each in bags))


def series(bag: reader.Bag | str | Path, topic: str) -> Series:
    """The series of a topic of a bag, or of the bag in a directory: samples of a block are rows, each
    with its own time; the pressure of a patch is read by ``bag.columns``.

    Raises BagError where there is no such topic, or it holds no numbers.
    """
    return series_of(table_of(bag if isinstance(bag, reader.Bag) else open_bag(bag), topic))
