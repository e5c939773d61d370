"""`python -m contact_sim_pkg.studies.benchmark [FILE]`: the bench against scipy and closed forms, in one run on this machine.

Times are medians of warm calls, one thread, no Python inside the loop of our side; scipy's right-hand sides are Python, which is
most of its time. Only ratios of one run count. Writes a table on standard output and, where FILE is given, JSON.
"""

from __future__ import annotations

import json
import math
import statistics
import sys
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy
from scipy.integrate import solve_ivp

from contact_sim_pkg.reference import impact
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.studies import hard_cases_friction, hard_cases_impact
from contact_sim_pkg.studies.accuracy_cost_field import bench_solves
from contact_sim_pkg.studies.effect_cost import absent_effect_cost
from contact_sim_pkg.studies.one_mass import integrate, seat_slap
from contact_sim_pkg.studies.scene_drive import drive_of, fast_run, load_resolved

__all__ = ["main", "study"]

REPEATS = 7
Row = dict[str, Any]


def study(progress: Callable[[str], None] | None = None) -> list[Row]:
    """All rows: what, error, time, unit, note. Takes about a minute."""
    rows: list[Row] = []
    for part in (_seat_slap, _slap_by_scipy, _impacts, _steel, _stick_slip, _rigs, _effects, _fields, _offline):
        if progress is not None:
            progress(part.__name__.strip("_"))
        rows += part()
    return rows


def _row(what: str, error: float | None, value: float, unit: str, note: str = "") -> Row:
    return {"what": what, "error": error, "time": value, "unit": unit, "note": note}


def _median(call: Callable[[], object], repeats: int = REPEATS) -> float:
    call()
    walls = []
    for _ in range(repeats):
        began = time.perf_counter()
        call()
        walls.append(time.perf_counter() - began)
    return statistics.median(walls)


def _seat_slap() -> list[Row]:
    rig, start, scales = seat_slap()
    exact = hard_cases_impact.slap_reference(rig, start)[0]
    rows = []
    for power in range(4, 13):
        call = partial(integrate, rig, start, scales * 10.0**-power, numpy.array([0.0, 4.0]))
        error = abs(float(call().states[-1, 0] - exact))
        cost = _median(call) / 4.0 * 1e6
        rows.append(_row(f"seat slap, tolerance 1e-{power}", error, cost, "us/simulated s", "error of z in m"))
    return rows


def _slap_by_scipy() -> list[Row]:
    """The same equations by scipy, without events, at the tolerance where it does best."""
    rig, start, _scales = seat_slap()
    exact = hard_cases_impact.slap_reference(rig, start)[0]
    law, amplitude, frequency = rig.elastic, rig.support_amplitude, rig.support_frequency

    def rate(t: float, y: Any) -> list[float]:
        approach = amplitude * math.sin(frequency * t) - y[0]
        if approach <= 0.0:
            return [y[1], -rig.gravity]
        closing = amplitude * frequency * math.cos(frequency * t) - y[1]
        force = law.coefficient * approach**law.exponent * max(0.0, 1.0 + closing)
        return [y[1], force / rig.mass - rig.gravity]

    rows = []
    for method in ("LSODA", "DOP853"):
        began = time.perf_counter()
        found = solve_ivp(rate, (0.0, 4.0), start, method, rtol=1e-10, atol=1e-12, max_step=0.01)
        seconds = time.perf_counter() - began
        note = "error of z in m; rtol 1e-10, Python right-hand side"
        error = abs(float(found.y[0, -1] - exact))
        rows.append(_row(f"seat slap, scipy {method}", error, seconds / 4.0 * 1e6, "us/simulated s", note))
    return rows


def _impacts() -> list[Row]:
    rows = []
    for tolerance in (1e-4, 1e-7, 1e-10):
        errors, walls = [], []
        for loss in (0.05, 0.2, 0.5, 1.0, 3.0):
            exact = impact.restitution(loss)
            errors.append(abs(hard_cases_impact.restitution_found(loss, tolerance, 0.001) - exact))
            walls.append(_impact_time(loss, tolerance))
        note = "worst error of e over 5 losses; time with the call from Python"
        rows.append(
            _row(f"Hunt-Crossley impact, tolerance {tolerance:.0e}", max(errors), statistics.median(walls), "us", note)
        )
    return rows


def _impact_time(loss: float, tolerance: float) -> float:
    """Microseconds an impact, the call from Python included."""
    case = hard_cases_impact
    rig = case.free_impact(case.MASS, case.LAW, loss / case.SPEED)
    depth = impact.deepest_approach(case.MASS, case.SPEED, case.LAW.coefficient, case.LAW.exponent, loss / case.SPEED)
    lasts = impact.elastic_impact(case.MASS, case.SPEED, case.LAW.coefficient, case.LAW.exponent)[0]
    end = 0.002 + lasts * (3.0 + 3.0 * loss)
    return 1e6 * _median(lambda: case.impact_speeds(rig, case.SPEED, depth, tolerance, 0.001, end), 50)


def _steel() -> list[Row]:
    duration, depth, force, steps = hard_cases_impact.steel_impact(1e-10)
    seconds = _median(lambda: hard_cases_impact.steel_impact(1e-10)) / 2.0
    note = f"worst of T, x, F; {steps} steps"
    return [_row("steel Hertz impact, 69 us", max(duration, depth, force), 1e6 * seconds, "us", note)]


def _stick_slip() -> list[Row]:
    finding = hard_cases_friction.period_of_the_rigid_law()
    exact = hard_cases_friction.period_of_rigid_law(hard_cases_friction.stick_slip(1.0, 0.0)[1])
    seconds = _median(lambda: hard_cases_friction.stick_slip_period(1.0e6, 1.0e3, 1e-9))
    note = f"closed form {exact:.6f} s, found {finding.value:.9f} s for an endless friction stiffness"
    error = abs(finding.value / exact - 1.0)
    return [_row("stick-slip period, 4 s simulated", error, 1e6 * seconds / 4.0, "us/simulated s", note)]


def _rigs() -> list[Row]:
    rows = []
    for name in ("seat_ride", "tire_bump", "car_full_bench"):
        drive = drive_of(load_resolved(name), 2.0)
        simulated = (len(drive.height) - 1) * drive.segment
        seconds = _median(partial(fast_run, drive, drive.model.scale))
        rows.append(_row(f"rig of {name}, point contacts", None, 1e6 * seconds / simulated, "us/simulated s"))
    return rows


def _effects() -> list[Row]:
    with_effect, absent, by_hand = absent_effect_cost()
    return [
        _row("loss in the scene", None, with_effect, "ns/step"),
        _row("loss absent", None, absent, "ns/step", f"{absent / by_hand - 1.0:+.1%} against the rig by hand"),
        _row("rig written by hand without loss", None, by_hand, "ns/step"),
    ]


def _fields() -> list[Row]:
    scene = load_resolved("tire_rough_road")
    rows = []
    for cells in ((48, 64), (96, 128)):
        for tolerance in (1e-2, 1e-3):
            cold, warm, error = bench_solves(scene, cells, tolerance)
            name = f"tire field {cells[0]}x{cells[1]}, tolerance {tolerance:.0e}"
            note = "error: L2 against the same grid at 1e-10"
            rows += [_row(f"{name}, cold", error, cold, "ms", note), _row(f"{name}, warm", error, warm, "ms", note)]
    return rows


def _offline() -> list[Row]:
    scene = load_resolved("car_full_bench", "duration=2.0")
    run_offline(scene, None)
    outcome = run_offline(scene, None)
    simulated = outcome.blocks * float(scene.data["block_length"])
    note = "real-time factor; start-up and bag not counted"
    return [_row("car_full_bench, offline, both fields", None, simulated / outcome.wall, "x real time", note)]


def main(path: str | None = None) -> None:
    """Run the study; table on standard output, progress on standard error, JSON to `path` if given."""
    rows = study(lambda text: sys.stderr.write(text + "\n"))
    for row in rows:
        error = "" if row["error"] is None else f"{row['error']:.1e}"
        sys.stdout.write(f"{row['what']:<48} {error:>9} {row['time']:>12.4g} {row['unit']:<15} {row['note']}\n")
    if path is not None:
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"rows": rows}, file, indent=1)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else None)
