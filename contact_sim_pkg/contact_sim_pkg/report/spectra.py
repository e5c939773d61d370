"""Tables of a bag behind its metrics: third-octave bands and rainflow cycles of its columns, and what its rig adds."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.records.table import Section
from contact_sim_pkg.report.export.table import table_of
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.rig_reports import reports_of
from contact_sim_pkg.report.signal.cycles import rainflow_cycles
from contact_sim_pkg.report.signal.thirds import NOMINAL, third_octaves

__all__ = ["KINDS", "band_rows", "facts_of", "tables_of"]

BINS = 20
"""of the ranges of cycles"""
EVEN = 0.01
"""of the period, by which samples may lie beside their place"""
TWICE = 1e-9
"""[s] between samples of one instant"""
EXPONENTS = (3.0, 5.0)
"""of Basquin's law: welds, base metal"""


def tables_of(kind: str, bag: Bag, columns: Sequence[str]) -> list[Section]:
    """The tables of a kind, of ``columns`` named `TOPIC.NAME`; where none is named, of what its rig has for it, or the
    contact forces.

    Raises BagError where the bag has no such column, or nothing for the table.
    """
    if columns and kind not in KINDS:
        raise BagError(f"--column: {kind} is a table of the rig, and takes no column")
    if columns:
        return [KINDS[kind](*_signal(bag, each)) for each in columns]
    recording = read_recording(bag)
    places = [each.tables[kind] for each in reports_of(recording) if kind in each.tables]
    found = [section for place in places for section in load(place)(recording)]
    forces = [row.relative_name or row.name for row in bag.topics.values() if row.type.endswith("/ContactForce")]
    if not found and kind in KINDS:
        found = [KINDS[kind](*_signal(bag, f"{name}.normal")) for name in forces]
    if not found:
        known = {*KINDS, *(name for each in reports_of(recording) for name in each.tables)}
        raise BagError(f"{bag.path} has nothing for a table {kind}; tables of it are {', '.join(sorted(known))}")
    return found


def band_rows(signals: Mapping[str, NDArray[np.float64]], rate: float) -> Section:
    """Root mean square by band, not weighted, of ``signals`` [samples] by their header at a ``rate`` [Hz]."""
    bands = {name: third_octaves(values, rate) for name, values in signals.items()}
    rows = [
        {"band [Hz]": centre} | {name: float(each[place]) for name, each in bands.items()}
        for place, centre in enumerate(NOMINAL) if any(np.isfinite(each[place]) for each in bands.values())
    ]  # fmt: skip
    return Section("third-octave bands, root mean square", rows, "not weighted; bands of IEC 61260-1")


def _bands(name: str, values: NDArray[np.float64], rate: float) -> Section:
    return band_rows({name: values}, rate)


def _cycles(name: str, values: NDArray[np.float64], _rate: float) -> Section:
    """Cycles by range, and the ranges that do the same damage."""
    cycles = rainflow_cycles(values)
    if not cycles.ranges.size:
        raise BagError(f"{name} does not vary: it has no cycles")
    edges = np.linspace(0.0, float(cycles.ranges.max()), BINS + 1)
    place = np.minimum(np.searchsorted(edges, cycles.ranges, side="left"), BINS).clip(1) - 1
    counts = np.bincount(place, cycles.counts, BINS)
    sums = np.bincount(place, cycles.counts * cycles.means, BINS)
    rows = [
        {"range from": float(edges[k]), "to": float(edges[k + 1]), "cycles": float(counts[k]), "mean": float(sums[k] / counts[k])}
        for k in range(BINS) if counts[k] > 0.0
    ]  # fmt: skip
    total = float(cycles.counts.sum())
    same = ", ".join(f"{cycles.equivalent(each, total):.4g} for exponent {each:g}" for each in EXPONENTS)
    return Section(
        f"rainflow cycles of {name}", rows, f"{total:g} cycles (ASTM E1049); as many of one range do the same: {same}"
    )


def _signal(bag: Bag, column: str) -> tuple[str, NDArray[np.float64], float]:
    """Header of a column `TOPIC.NAME`, its values, and its rate [Hz]."""
    topics = sorted((row.relative_name or row.name.lstrip("/") for row in bag.topics.values()), key=len, reverse=True)
    topic = next((each for each in topics if column.lstrip("/").startswith(f"{each}.")), None)
    if topic is None:
        raise BagError(
            f"--column {column}: no topic of {bag.path} begins it; write TOPIC.NAME, of {', '.join(sorted(topics))}"
        )
    time, *others = table_of(bag, topic).columns
    name = column.lstrip("/").removeprefix(f"{topic}.")
    known = {each.name: each for each in others}
    if name not in known or np.asarray(known[name].values).dtype.kind not in "fiu":
        numbers = [key for key, each in known.items() if np.asarray(each.values).dtype.kind in "fiu"]
        raise BagError(f"--column {column}: {topic} has no numbers {name}; it has {', '.join(numbers)}")
    instants = np.asarray(time.values, dtype=np.float64)
    new = np.append(True, np.diff(instants) > TWICE)  # blocks of excitation share the instant between them
    values, period = np.asarray(known[name].values, dtype=np.float64)[new], np.diff(instants[new])
    if values.size < 16 or not np.isfinite(values).all():
        raise BagError(
            f"--column {column}: {values.size} samples, {int((~np.isfinite(values)).sum())} of them no number"
        )
    if float(np.ptp(period)) > EVEN * float(np.median(period)):
        raise BagError(
            f"--column {column}: its samples are not evenly spaced ({period.min():.4g} to {period.max():.4g} s)"
        )
    return f"{topic}.{known[name].header}", values, 1.0 / float(period.mean())


KINDS: dict[str, Callable[[str, NDArray[np.float64], float], Section]] = {"third-octaves": _bands, "rainflow": _cycles}
"""By name on the command line"""


def facts_of(sections: Sequence[Section]) -> dict[str, Any]:
    """The tables as plain values."""
    return {"tables": [{"title": each.title, "rows": [*each.rows], "note": each.note} for each in sections]}
