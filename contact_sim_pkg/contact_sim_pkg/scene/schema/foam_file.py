"""A test of a foam or cushion, force over deflection, as stress over strain of loading and unloading.

The deflection rises to its largest value, the loading, and falls again, the unloading; a file may end with the
loading. A point is (strain, stress while loading, stress while unloading). The points lie at the strains of the
loading; the unloading is taken to them by the monotone cubic (PCHIP) through its samples and the origin, and above its
first sample its ratio to the loading stays. Of more than 100 samples of a branch those within a hundredth of the
largest strain become their mean. Noise is a force that sinks by less than half a percent of itself and a thousandth of
the largest one, a deflection that steps back by less than a thousandth of the largest.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple, NoReturn

import numpy
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.recorded_csv import RecordedTable
from contact_sim_pkg.excitation.table_files import read_recording
from contact_sim_pkg.excitation.table_words import UNITS, factor_of, si_unit
from contact_sim_pkg.scene.schema.foam_points import FEWEST_POINTS, Points, point_fault

__all__ = ["read_foam_file"]

MOST_POINTS = 100
OWN_NOISE, NOISE = 5e-3, 1e-3  # of a stress itself; of the largest stress or strain
WAYS = {"m": ("deflection", "indentation", "compression", "displacement", "deformation", "travel", "stroke"),
        "1": ("strain",)}  # fmt: skip
LOADS = {"N": ("force", "load"), "Pa": ("stress", "pressure")}
EXAMPLES = {"m": "mm", "1": "%", "N": "N", "Pa": "kPa"}
"""SI unit of a column -> a usual one"""

Array = NDArray[numpy.float64]


class Branch(NamedTuple):
    """One way of the test, its strain rising."""

    strain: Array
    stress: Array  # [Pa]


class _Column(NamedTuple):
    name: str
    unit: str  # of SI
    values: Array


def read_foam_file(path: Path, area: float | None, thickness: float, header_line: int | None, where: str) -> Points:
    """The points of a file of deflection or strain and force or stress, each with its unit: `deflection [mm]`,
    `deflection_mm`, or a row of units.

    Args:
        path: of the file, any table that a recording may be.
        area: [m^2] that the force acts on; not needed beside a stress.
        thickness: [m] of the specimen; not needed beside a strain.
        header_line: number of the line that names the columns; None: the first that is no comment.
        where: dotted path of the section, which sentences name.

    Raises:
        ExcitationError: columns or units that cannot be told apart, a curve that folds back, an unloading above the
            loading, a strain of 1 or more, fewer than 5 points of a branch, with file, line, value and cure.
    """
    table = read_recording(path, header_line, section=where)
    way, load = _column(table, WAYS), _column(table, LOADS)
    if load.unit == "N" and area is None:
        raise ExcitationError(f"{path}: '{load.name}' is a force; give the area that it acts on in m^2, {where}.area")
    size = thickness if way.unit == "m" else 1.0
    test = _Test(table, way, load, way.values / size, load.values / (area or 1.0 if load.unit == "N" else 1.0))
    test.refuse_signs(thickness, where)
    peak = int(numpy.argmax(test.strain))
    left = test.strain[peak:] != test.strain[peak]
    last = peak + int(numpy.argmax(left)) - 1 if left.any() else len(left) + peak - 1  # that is held at the largest
    test.refuse_folds(numpy.arange(peak + 1), loading=True)
    back = numpy.arange(last if last > peak else peak + 1, len(test.strain))
    loading = test.branch(numpy.arange(peak + 1), rising=True)
    if len(loading.strain) < FEWEST_POINTS:
        test.refuse_few("loading", len(loading.strain))
    if not len(back) or back[0] == len(test.strain) - 1 == last:  # held at the end, without unloading
        return _points(path, loading.strain, loading.stress)
    test.refuse_folds(back, loading=False)
    test.refuse_above(back, loading)
    unloading = test.branch(back[::-1], rising=False)
    if len(back) < FEWEST_POINTS:
        test.refuse_few("unloading", len(back))
    return _points(path, loading.strain, loading.stress, _unloading_at(loading, unloading))


class _Test(NamedTuple):
    """The samples of a test, in the order of the file."""

    table: RecordedTable
    way: _Column
    load: _Column
    strain: Array
    stress: Array  # [Pa]

    def branch(self, samples: NDArray[numpy.int64], *, rising: bool) -> Branch:
        """Samples of rising strain, thinned; `rising`: without those whose stress does not rise."""
        strain = numpy.maximum.accumulate(self.strain[samples])
        stress = numpy.maximum.accumulate(numpy.maximum(self.stress[samples], 0.0))
        if len(samples) > MOST_POINTS:
            bins = numpy.minimum((strain / strain[-1] * MOST_POINTS).astype(int), MOST_POINTS - 1)
            count = numpy.bincount(bins)
            filled = count > 0
            means = [numpy.bincount(bins, each)[filled] / count[filled] for each in (strain, stress)]
            strain, stress = numpy.append(means[0][:-1], strain[-1]), numpy.append(means[1][:-1], stress[-1])
        kept = strain > numpy.append(0.0, strain[:-1])
        if rising:
            kept &= stress > numpy.append(0.0, stress[:-1])
        return Branch(strain[kept], stress[kept])

    def _noise(self, stress: Array | float) -> Array:
        """Of a stress, both in [Pa]."""
        return numpy.asarray(OWN_NOISE * numpy.abs(stress) + NOISE * float(numpy.abs(self.stress).max()))

    def refuse_signs(self, thickness: float, where: str) -> None:
        """Tension, a deflection out of the foam or through it, a load before the deflection begins."""
        largest = float(numpy.abs(self.strain).max())
        if (wrong := numpy.flatnonzero(self.strain < -NOISE * largest)).size:
            self._refuse(wrong[0], self.way, "compression is counted positive, from first contact on; turn its sign")
        zero = OWN_NOISE * float(numpy.abs(self.stress).max())
        if (wrong := numpy.flatnonzero(self.stress < -zero)).size:
            self._refuse(wrong[0], self.load, "compression is counted positive; turn its sign, or take the zero off")
        if (wrong := numpy.flatnonzero(self.strain >= 1.0)).size:
            if self.way.unit == "m":
                cure = f"it is not below the thickness of {1e3 * thickness:.4g} mm; give that of the specimen, {where}.thickness"
            else:
                cure = "a strain is below 1; one in percent has the unit %"
            self._refuse(wrong[0], self.way, cure)
        if (wrong := numpy.flatnonzero((self.strain <= 0.0) & (self.stress > zero))).size:
            self._refuse(
                wrong[0], self.load, "without deflection it is 0; take a preload off, or count from first contact"
            )

    def refuse_folds(self, samples: NDArray[numpy.int64], *, loading: bool) -> None:
        """A deflection that turns back within a branch, a force that falls as it grows."""
        sign, word, branch = (1.0, "falls back", "loading") if loading else (-1.0, "rises again", "unloading")
        way, load = self.strain[samples], self.stress[samples]
        cycles = "give one loading and one unloading, cut other cycles"
        folds = "the curve folds back; that of a foam rises throughout, smooth it or cut it there"
        for values, noise, column, cure in (
            (sign * way, numpy.full(len(way), NOISE * float(self.strain.max())), self.way, cycles),
            (sign * load, self._noise(load), self.load, folds),
        ):
            highest = numpy.maximum.accumulate(values)
            if (wrong := numpy.flatnonzero(values < highest - noise)).size:
                at = int(wrong[0])
                before = samples[int(numpy.argmax(values[: at + 1]))]
                self._refuse(
                    samples[at], column, f"while {branch} it {word} from {self._shown(before, column)}; {cure}"
                )

    def refuse_above(self, samples: NDArray[numpy.int64], loading: Branch) -> None:
        """An unloading above the loading."""
        there = numpy.interp(self.strain[samples], numpy.append(0.0, loading.strain), numpy.append(0.0, loading.stress))
        if (wrong := numpy.flatnonzero(self.stress[samples] > there + self._noise(there))).size:
            at = int(wrong[0])
            ratio = self.load.values[samples[at]] / self.stress[samples[at]]
            expected = f"{there[at] * ratio:.4g} {self.load.unit}"
            self._refuse(
                samples[at], self.load,
                f"while unloading it is above the loading, {expected} there; loading stands first, then unloading",
            )  # fmt: skip

    def refuse_few(self, branch: str, count: int) -> NoReturn:
        """Fewer points than a curve needs."""
        raise ExcitationError(
            f"{self.table.file}: the {branch} has {count} points that rise, at least {FEWEST_POINTS} are needed; record more"
        )

    def _refuse(self, sample: int, column: _Column, sentence: str) -> NoReturn:
        raise ExcitationError(
            f"{self.table.file}, line {self.table.lines[sample]}: '{column.name}' is {self._shown(sample, column)}; {sentence}"
        )

    def _shown(self, sample: int, column: _Column) -> str:
        value = float(column.values[sample])
        return f"{1e3 * value:.4g} mm" if column.unit == "m" else f"{value:.4g} {column.unit}".removesuffix(" 1")


def _column(table: RecordedTable, kinds: Mapping[str, tuple[str, ...]]) -> _Column:
    """The only column of a kind, in SI units: by its name, or, where no name is usual, by its unit."""
    known = list(_columns_with_unit(table))
    usual = [each for each in known if each.unit in kinds and each.name in kinds[each.unit]]
    found = usual or [each for each in known if each.unit in kinds and each.unit != "1"]
    names = [name for each in kinds.values() for name in each]
    wanted = " or ".join(f"{each[0]} [{EXAMPLES[unit]}]" for unit, each in kinds.items())
    if len(found) == 1:
        return found[0]
    if found:
        raise ExcitationError(
            f"{table.file}: {' and '.join(each.name for each in found)} may each be meant; name one alone {wanted}"
        )
    bare = next((name for name in table.columns if name.partition("_")[0] in names), None)
    if bare is not None:
        raise ExcitationError(
            f"{table.file}: column '{bare}' has no unit that fits; write it behind the name, as {wanted} or as "
            f"{bare.partition('_')[0]}_{EXAMPLES[next(iter(kinds))]}"
        )
    raise ExcitationError(f"{table.file}: there is no column {wanted}; the header names {', '.join(table.columns)}")


def _columns_with_unit(table: RecordedTable) -> Iterator[_Column]:
    """Columns whose unit stands in the header, or behind the name after an underscore."""
    for name in table.columns:
        first, _, last = name.rpartition("_")
        if name in table.units:
            yield _Column(name, table.units[name], table.column(name))
        elif first and last in UNITS and name not in table.texts:
            yield _Column(first, si_unit(last), table.column(name) * (factor_of(last) or 1.0))


def _unloading_at(loading: Branch, unloading: Branch) -> Array:
    """Stress [Pa] while unloading at the strains of the loading."""
    if not len(unloading.strain):  # below the noise throughout
        return numpy.zeros(len(loading.strain))
    curve = PchipInterpolator(numpy.append(0.0, unloading.strain), numpy.append(0.0, unloading.stress))
    first = min(float(unloading.strain[-1]), float(loading.strain[-1]))
    at_first = numpy.interp(first, numpy.append(0.0, loading.strain), numpy.append(0.0, loading.stress))
    ratio = min(float(curve(first)) / float(at_first), 1.0)
    stress = numpy.where(loading.strain <= first, curve(numpy.minimum(loading.strain, first)), ratio * loading.stress)
    return numpy.minimum(numpy.maximum.accumulate(numpy.maximum(stress, 0.0)), loading.stress)


def _points(path: Path, *columns: Array) -> Points:
    """Points with ten digits, judged as those that a scene holds."""
    points = [[float(f"{value:.10g}") for value in row] for row in numpy.column_stack(columns)]
    if sentence := point_fault(points):
        raise ExcitationError(f"{path}: {sentence}")
    return points
