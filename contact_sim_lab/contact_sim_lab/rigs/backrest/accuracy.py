"""Accuracy and cost of the backrest rig: the requested tolerance, and for a shell the number of
modes.

Errors are relative: *motion* is the largest error of a point's approach over the largest excursion
of any, *normal force* and *friction* are the largest over the largest value, *instants of touch*
the largest over the mean time between touches.
"""

from __future__ import annotations

import copy
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy

from contact_sim_lab.records.accuracy import INTEGRATOR, AccuracyPart, AccuracyStudy
from contact_sim_lab.rigs.backrest.drive import BackrestMotion, DrivenBackrest, drive_of, fast_run, slow_run
from contact_sim_pkg.rigs.backrest.schema_rules import MOST_SEARCHED
from contact_sim_pkg.rigs.backrest.shell import MODE_COUNTS
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["ACCURACY", "mode_rows", "tolerance_rows"]

DURATION, SHELL_DURATION = 2.0, 0.5  # [s] of the scene
TOLERANCES = tuple(10.0**-power for power in range(3, 12))
TIGHT = 1e-13
REPEATS, LONG = 7, 0.5  # runs that are timed, and the time [s] from which one is enough
TWIN = "scipy DOP853, no shared code"
OWN = f"own code, tolerance {TIGHT:.0e}"
Row = dict[str, Any]
Notify = Callable[[str], None]


def tolerance_rows(_scene_name: str, scene: ResolvedScene, notify: Notify) -> list[Row]:
    """Motion, forces and instants of touch for each tolerance: against scipy, else against own
    code.
    """
    shell = _shell(scene) is not None
    drive = drive_of(scene, SHELL_DURATION if shell else DURATION)
    notify(f"integrator: reference for {(len(drive.acceleration) - 1) * drive.segment:g} s")
    twin = slow_run(drive)
    rubs = drive.model.rig.contact.friction is not None
    # Friction, and all that the twin lacks, is compared with own code at a tight tolerance.
    own = fast_run(drive, _scale(scene, drive, TIGHT)) if twin is None or rubs else None
    rows = []
    for tolerance in TOLERANCES:
        notify(f"integrator: tolerance {tolerance:.0e}")
        found, cost = _timed(drive, _scale(scene, drive, tolerance))
        head = {"part": "integrator", "level": "", "grid": "", "tolerance": tolerance, "ms_per_simulated_s": cost}
        exact = own if twin is None else twin
        assert exact is not None
        errors = _errors(found, exact)
        rows += [_row(head, name, error, OWN if twin is None else TWIN) for name, error in errors.items()]
        if rubs and own is not None:
            rows.append(_row(head, "friction", _largest(found.friction, own.friction), OWN))
    return rows


def mode_rows(_scene_name: str, scene: ResolvedScene, notify: Notify) -> list[Row]:
    """The same quantities for each number of modes, against the most modes at a tight tolerance."""
    if _shell(scene) is None:
        return []
    searched = scene.data["effects"]["backrest"].get("contact_search") is not None
    # A search of the contact point allows fewer modes.
    counts = tuple(count for count in MODE_COUNTS if not searched or count <= MOST_SEARCHED)
    most = f"{counts[-1]} modes"
    notify(f"modes: reference, {most}")
    finest = drive_of(_with_modes(scene, counts[-1]), SHELL_DURATION)
    exact = fast_run(finest, _scale(scene, finest, TIGHT))
    tolerance = float(scene.data["integrator"]["relative_tolerance"])
    rows = []
    for count in counts:
        notify(f"modes: {count}")
        drive = drive_of(_with_modes(scene, count), SHELL_DURATION)
        found, cost = _timed(drive, drive.model.scale)
        fidelity = f"{count} mode{'s' if count > 1 else ''}"
        head = {"part": "modes", "level": fidelity, "grid": "", "tolerance": tolerance, "ms_per_simulated_s": cost}
        rows += [_row(head, name, error, f"{most}, {OWN}") for name, error in _errors(found, exact).items()]
    return rows


def _shell(scene: ResolvedScene) -> dict[str, Any] | None:
    shell: dict[str, Any] | None = scene.data["effects"]["backrest"].get("shell_modes")
    return shell


def _with_modes(scene: ResolvedScene, count: int) -> ResolvedScene:
    data = copy.deepcopy(scene.data)
    data["effects"]["backrest"]["shell_modes"]["modes"] = count
    return ResolvedScene(data, scene.files)


def _scale(scene: ResolvedScene, drive: DrivenBackrest, tolerance: float) -> Any:
    return drive.model.scale * (tolerance / float(scene.data["integrator"]["relative_tolerance"]))


def _timed(drive: DrivenBackrest, scale: Any) -> tuple[BackrestMotion, float]:
    """A run, and the shortest processor time of some [ms] per simulated second."""
    run = partial(fast_run, drive, scale)
    found = run()
    times: list[float] = []
    while len(times) < REPEATS and sum(times) < LONG:
        began = time.process_time()
        found = run()
        times.append(time.process_time() - began)
    return found, 1e3 * min(times) / (len(drive.acceleration) - 1) / drive.segment


def _errors(found: BackrestMotion, exact: BackrestMotion) -> dict[str, float]:
    excursion = numpy.abs(exact.approach - exact.approach[0]).max()
    errors = {
        "motion": float(numpy.abs(found.approach - exact.approach).max() / excursion),
        "normal force": _largest(found.normal, exact.normal),
    }
    if len(exact.touches) > 1:
        between = float(numpy.diff(exact.touches).mean())
        errors["instants of touch"] = _latest(found.touches, exact.touches) / between
    return errors


def _latest(found: Any, exact: Any) -> float:
    """Largest difference [s] of a touch from the nearest one found."""
    if len(found) == 0:
        return float(exact[-1])
    return max(float(numpy.abs(found - instant).min()) for instant in exact)


def _largest(found: Any, exact: Any) -> float:
    return float(numpy.abs(found - exact).max() / numpy.abs(exact).max())


def _row(head: Row, quantity: str, error: float, reference: str) -> Row:
    return {"quantity": quantity, "error": error, "reference": reference, **head}


_MODES = AccuracyPart("modes", "modes of the shell: error", "modes of the shell, tolerance of the scene", "modes")

ACCURACY = (AccuracyStudy(tolerance_rows, (INTEGRATOR,)), AccuracyStudy(mode_rows, (_MODES,)))
