"""Hard cases of the pressure field by every way in: static, windowed, rolling; load and
approach given.

Each value is the worst over all of them.
"""

from __future__ import annotations

import functools
import math

import numpy
from numpy.typing import NDArray

from contact_sim_lab.field.field_entries import ENTRIES, SolveRequest, holds_load
from contact_sim_lab.field.hard_cases_field import CELL, MODULUS, SIDE, bowl, dense, grid
from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, exactly
from contact_sim_lab.twins import halfspace as reference
from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.solver import BAD_INPUT, CONVERGED, EDGE, NOT_CONVERGED

Field = NDArray[numpy.float64]
TOLERANCE = 1e-11


def exact(gap: Field, approach: float) -> tuple[Field, float]:
    """Pressure [rows, cols] [Pa] and load [N] by dense non-negative least squares; gap: [rows,
    cols] [m], approach: [m]."""
    pressure = reference.pressure_at_approach(dense(), gap, approach)
    return pressure, float(pressure.sum()) * CELL**2


def worst_error(gap: Field, approach: float, expected: Field | None = None, status: int = CONVERGED) -> float:
    """Largest relative L2 distance [1] to `expected` (dense least squares), infinite where a status
    is another.

    gap: [rows, cols] [m]; approach: [m]; expected: [rows, cols] [Pa].
    """
    pressure_expected = exact(gap, approach)[0] if expected is None else expected
    request = SolveRequest(float(pressure_expected.sum()) * CELL**2, approach, TOLERANCE)
    worst = 0.0
    for solve in ENTRIES.values():
        pressure, result = solve(grid(), gap, request)
        if result.status != status:
            return math.inf
        error = numpy.linalg.norm(pressure - pressure_expected) / numpy.linalg.norm(pressure_expected)
        worst = max(worst, float(error))
    return worst


def _at_rim(pressure: Field) -> int:
    return int((pressure > 0.0).sum() - (pressure[1:-1, 1:-1] > 0.0).sum())


def zero_load() -> Finding:
    """Sum of all loads and pressures at load 0, and at the approach of first contact."""
    gap, load = bowl(), 0.0
    total = 0.0
    for solve in ENTRIES.values():
        pressure, result = solve(grid(), gap, SolveRequest(load, float(gap.min())))
        total += result.load + float(pressure.sum()) + (0.0 if result.status == CONVERGED else math.inf)
    return exactly(total, 0.0, hard=load)


def spike() -> Finding:
    """One cell stands out by 20 mm."""
    gap = bowl()
    gap[2, 21] -= 0.02
    return at_most(worst_error(gap, 0.004), 1e-8, hard=(bowl() - gap).max() / 0.004)


def flat() -> Finding:
    """A level gap is a square punch; the dense system is solved as it stands."""
    expected = numpy.linalg.solve(dense(), numpy.full(SIDE * SIDE, 1e-3)).reshape(SIDE, SIDE)
    return at_most(worst_error(numpy.zeros((SIDE, SIDE)), 1e-3, expected, EDGE), 1e-6, hard=_at_rim(expected))


def full_contact() -> Finding:
    """Waves of 10 um pressed by 2 mm."""
    wave = 1e-5 * numpy.cos(0.9 * numpy.arange(SIDE))[:, None] * numpy.cos(0.6 * numpy.arange(SIDE))[None, :]
    expected = numpy.linalg.solve(dense(), (2e-3 - wave).ravel()).reshape(SIDE, SIDE)
    return at_most(worst_error(wave, 2e-3, expected, EDGE), 1e-6, hard=_at_rim(expected))


def one_cell() -> Finding:
    """The cell's own closed form."""
    gap, expected = numpy.full((SIDE, SIDE), 0.5), numpy.zeros((SIDE, SIDE))
    gap[20, 3] = 0.0
    expected[20, 3] = 1e-3 / (4.0 * CELL * math.log(1.0 + math.sqrt(2.0)) / (math.pi * MODULUS))
    return at_most(worst_error(gap, 1e-3, expected), 1e-10, hard=(expected > 0.0).sum())


def punch() -> Finding:
    """11 x 11 level cells, nothing around."""
    gap = numpy.full((SIDE, SIDE), 1.0)
    gap[6:17, 8:19] = 0.0
    return at_most(worst_error(gap, 1e-3), 1e-6, hard=numpy.ptp(gap) / 1e-3)


def white_noise() -> Finding:
    """No cell knows its neighbour; the rim stays free, so that the status is the same
    everywhere.
    """
    gap = numpy.full((SIDE, SIDE), 1.0)
    gap[1:-1, 1:-1] = 1e-3 * numpy.random.default_rng(6).standard_normal((SIDE - 2, SIDE - 2))
    return at_most(
        worst_error(gap, 1e-3), 1e-6, hard=abs(numpy.corrcoef(gap[1:-1, 1:-2].ravel(), gap[1:-1, 2:-1].ravel())[0, 1])
    )


def curvatures() -> Finding:
    """A bowl of 2e-3 1/m with 120 spikes of 2e-3 to 2e3 1/m."""
    random = numpy.random.default_rng(9)
    gap, inner = bowl() / 1e3, numpy.zeros((SIDE - 2, SIDE - 2))
    inner.ravel()[random.permutation(inner.size)[:120]] = 10.0 ** random.uniform(-7.0, -1.0, 120)
    gap[1:-1, 1:-1] -= inner
    return at_most(worst_error(gap, -0.01), 1e-6, hard=inner.max() / inner[inner > 0.0].min())


def at_each_edge() -> Finding:
    """Ways in and edges where a contact at the edge is not reported."""
    x = (numpy.arange(SIDE) - 0.5 * (SIDE - 1)) * CELL
    missed, at_rim = 0, SIDE
    for row, col in ((10, 0), (-10, 0), (0, 10), (0, -10)):
        gap = (x[:, None] - row * CELL) ** 2 + (x[None, :] - col * CELL) ** 2
        pressure, load = exact(gap, 0.004)
        at_rim, request = min(at_rim, _at_rim(pressure)), SolveRequest(load, 0.004)
        missed += sum(solve(grid(), gap, request)[1].status != EDGE for solve in ENTRIES.values())
    return exactly(missed, 0, hard=at_rim)


def not_finite() -> Finding:
    """Ways in that take a NaN or an infinite height, load or approach."""
    taken, bads = 0, (math.nan, math.inf, -math.inf)
    for bad in bads:
        gap = bowl()
        gap[23, 5] = bad
        for solve in ENTRIES.values():
            taken += solve(grid(), gap, SolveRequest(100.0, 0.004))[1].status != BAD_INPUT
            taken += solve(grid(), bowl(), SolveRequest(bad, bad))[1].status != BAD_INPUT
    return exactly(taken, 0, hard=len(bads) - sum(map(math.isfinite, bads)))


def verified() -> Finding:
    """Largest true residual over the requested one, by the dense matrix from the returned field
    alone.
    """
    gap, worst = bowl() + 1e-3 * numpy.random.default_rng(3).standard_normal((SIDE, SIDE)), 0.0
    load, tolerances = exact(gap, 0.005)[1], (1e-1, 1e-3, 1e-6)
    for tolerance in tolerances:
        for solve in ENTRIES.values():
            pressure, result = solve(grid(), gap, SolveRequest(load, 0.005, tolerance))
            displacement = reference.displacement(dense(), pressure)
            clearance = displacement + gap - result.approach
            penetration = max(0.0, -float(clearance[pressure == 0.0].min(initial=0.0)))
            residual = float((pressure * abs(clearance)).sum()) + penetration * float(pressure.sum())
            worst = max(worst, residual / float((pressure * displacement).sum()) / tolerance)
    return at_most(worst, 1.001, hard=max(tolerances) / min(tolerances))


def capped() -> Finding:
    """Ways in that call one iteration at 1e-13 converged."""
    gap = bowl() + 2e-3 * numpy.random.default_rng(5).standard_normal((SIDE, SIDE))
    request = SolveRequest(exact(gap, 0.005)[1], 0.005, 1e-13, 1)
    needed = min(solve(grid(), gap, request._replace(cap=2000))[1].iterations for solve in ENTRIES.values())
    return exactly(
        sum(solve(grid(), gap, request)[1].status != NOT_CONVERGED for solve in ENTRIES.values()), 0, hard=needed
    )


def incompressible() -> Finding:
    """Poisson's ratio 0.5: pressure over contact modulus is that of any other ratio."""
    expected, load = exact(bowl(), 0.004)
    poisson = 0.5
    modulus = 3e6 / (1.0 - poisson**2)
    half_space, ratio, worst = make_half_space(SIDE, SIDE, CELL, CELL, modulus), modulus / MODULUS, 0.0
    for solve in ENTRIES.values():
        pressure, result = solve(half_space, bowl(), SolveRequest(ratio * load, 0.004, TOLERANCE))
        error = numpy.linalg.norm(pressure / ratio - expected) / numpy.linalg.norm(expected)
        worst = max(worst, float(error) if result.status == CONVERGED else math.inf)
    return at_most(worst, 1e-8, hard=1.0 - 2.0 * poisson)


def quarter_of_the_box() -> Finding:
    """Sphere whose contact radius is a quarter of the box: load, or approach, against Hertz."""
    cells, semi_axis = 64, 0.25
    half_space = make_half_space(cells, cells, 1 / cells, 1 / cells, 1.0)
    x = (numpy.arange(cells) - 0.5 * (cells - 1)) / cells
    gap = 0.5 * (x[:, None] ** 2 + x[None, :] ** 2)
    load, approach, worst = 4.0 / 3.0 * semi_axis**3, semi_axis**2, 0.0
    for name, solve in ENTRIES.items():
        result = solve(half_space, gap, SolveRequest(load, approach, 1e-8))[1]
        error = result.approach / approach - 1.0 if holds_load(name) else result.load / load - 1.0
        worst = max(worst, abs(error))
    return at_most(worst, 1e-3, hard=semi_axis)


def loads_held() -> Finding:
    """Largest relative difference of a field's integral from the requested load, from 1e-9 N to 1
    MN.
    """
    worst, loads = 0.0, (1e-9, 1.0, 1e3, 1e6)
    for name in filter(holds_load, ENTRIES):
        for load in loads:
            pressure = ENTRIES[name](grid(), bowl(), SolveRequest(load, 1e-3, 1e-6))[0]
            worst = max(worst, abs(float(pressure.sum()) * CELL**2 / load - 1.0))
    return at_most(worst, 1e-8, hard=max(loads) / min(loads))


def whole_cells() -> Finding:
    """Change of the field when the whole gap moves by whole cells, over the peak."""
    gap, worst = numpy.full((SIDE, SIDE), 1.0), 0.0
    rough = bowl() + 1e-3 * numpy.random.default_rng(8).standard_normal((SIDE, SIDE))
    gap[6:18, 6:18] = rough[6:18, 6:18]
    moves = ((4, -3), (-4, 2))
    request = SolveRequest(exact(gap, 0.002)[1], 0.002, TOLERANCE)
    for solve in ENTRIES.values():
        pressure = solve(grid(), gap, request)[0]
        for move in moves:
            moved = solve(grid(), numpy.roll(gap, move, (0, 1)), request)[0]
            difference = abs(moved - numpy.roll(pressure, move, (0, 1))).max() / pressure.max()
            worst = max(worst, float(difference))
    return at_most(worst, 1e-6, hard=len(moves) * (gap < 1.0).sum())


WAYS = f"{len(ENTRIES)} ways in"

CASES = tuple(
    HardCase(model, f"{case} ({WAYS})", functools.cache(find), is_hard)
    for model, case, find, is_hard in (
        ("halfspace", "load 0 and first contact: loads and pressures", zero_load, guard.zero("load [N]")),
        ("halfspace", "perfectly flat, full contact: error against the dense solve", flat,
            guard.grid_left(4 * (SIDE - 1))),
        ("halfspace", "wavy, full contact: error against the dense solve", full_contact,
            guard.grid_left(4 * (SIDE - 1))),
        ("halfspace", "one cell: error against its closed form", one_cell, guard.at_most("loaded cells", 1)),
        ("halfspace", "sharp-edged punch: error against dense NNLS", punch,
            guard.scales("step of the gap and approach", 1e3)),
        ("halfspace", "contact at each edge: not reported", at_each_edge, guard.grid_left()),
        ("halfspace", "NaN or infinity in a height, load, approach: taken", not_finite,
            guard.at_least("values that are not finite", 3)),
        ("halfspace", "certified residual against the dense matrix: ratio", verified, guard.scales("tolerances", 9e4)),
        ("halfspace", "one iteration: called converged", capped, guard.at_least("iterations that it takes", 2)),
        ("halfspace", "contact radius a quarter of the box: error against Hertz", quarter_of_the_box,
            guard.at_least("contact radius over box", 0.25)),
        ("halfspace", "load from 1e-9 N to 1 MN: relative error", loads_held, guard.scales("loads", 1e15)),
        ("halfspace", "gap moved by whole cells: change of the field", whole_cells,
            guard.at_least("rough cells that are moved", 100)),
        ("moduli", "Poisson's ratio 0.5: error of the field", incompressible, guard.zero("1 - 2 ν")),
        ("rough road", "one cell 20 mm high: error against dense NNLS", spike,
            guard.at_least("height of one cell over the approach", 4.0)),
        ("rough road", "white noise: error against dense NNLS", white_noise,
            guard.at_most("correlation of neighbouring cells", 0.1)),
        ("rough road", "curvatures 1 to 1e6: error against dense NNLS", curvatures, guard.scales("curvatures", 1e5)),
    )
)  # fmt: skip
