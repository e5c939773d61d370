"""Report on the stability of a roller before its run."""

from __future__ import annotations

import math
from typing import Any

import numpy

from contact_sim_pkg.records.messages import RollerStability
from contact_sim_pkg.rigs.roller.model import RollerModel, build_roller
from contact_sim_pkg.rigs.roller.theory.parameters import Bending, Curvatures
from contact_sim_pkg.rigs.roller.theory.stability import RollerError, critical_damping, critical_load, stability
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

SEARCHED = 10.0
"""Times the largest load of the run: as far as a critical load is looked for."""
ANY_LOAD = 1e-5
"""Of the load: a critical load below it is rounding."""
MOST_ROWS = 200
"""Rows of a programme whose stability is looked at before the run."""


def forecast(model: RollerModel, block: int = 0) -> RollerStability | None:
    """Stability under the load at the start of a block; None where tilt and yaw are held. Raises
    RunError without static angles.
    """
    if not model.turns:
        return None
    time = block * model.timing.block_length
    curvatures = model.programme.curvatures_at(time)
    load = model.contact_load(float(model.programme.loads(numpy.array([time]))[0]), curvatures)
    return _stability(model, block, curvatures, model.bending_at(time), load)


def _stability(
    model: RollerModel, block: int, curvatures: Curvatures, bending: Bending | None, load: float
) -> RollerStability:
    case = (curvatures, bending, model.modulus)
    try:
        found = stability(model.roller, *case, load)
    except RollerError as error:
        raise RunError(str(error)) from None
    try:
        damping = critical_damping(model.roller, *case, load)
    except RollerError:
        damping = math.nan
    threshold = critical_load(model.roller, *case, SEARCHED * model.largest_load)
    return RollerStability(
        block=block, load=load, growth_rate=found.growth_rate, frequency=found.frequency, tilt=found.linear.tilt,
        yaw=found.linear.yaw, critical_load=math.nan if threshold is None else threshold, critical_damping=damping,
        root_real=numpy.array(found.roots.real), root_imaginary=numpy.array(found.roots.imag),
    )  # fmt: skip


def facts_before_run(scene: ResolvedScene) -> dict[str, Any]:
    """The forecast of a resolved scene as numbers with units in their names; empty where tilt and
    yaw are held.

    Of the start, and under `worst` of the row of the programme with the largest growth rate.
    """
    model = build_roller(scene)
    found = forecast(model)
    if found is None:
        return {}
    facts = stability_facts(found)
    times = model.programme.time[model.programme.time < model.timing.blocks * model.timing.block_length]
    if len(times) > 1:
        place, growth = _worst_row(model, len(times))
        if growth > found.growth_rate:
            facts["worst"] = {"time_s": float(times[place]), **stability_facts(_at_row(model, place))}
    return facts


def _worst_row(model: RollerModel, rows: int) -> tuple[int, float]:
    """Row of the programme with the largest growth rate [1/s], of `MOST_ROWS` of them; none is
    worse than no static angles.
    """
    places = numpy.unique(numpy.linspace(0, rows - 1, min(rows, MOST_ROWS)).round().astype(int))
    rates = []
    for place in places:
        curvatures, bending, load = _row(model, int(place))
        try:
            rates.append(stability(model.roller, curvatures, bending, model.modulus, load).growth_rate)
        except RollerError:
            rates.append(math.inf)
    worst = int(numpy.argmax(rates))
    return int(places[worst]), rates[worst]


def _row(model: RollerModel, place: int) -> tuple[Curvatures, Bending | None, float]:
    """Curvatures, bent shaft and contact load of a row."""
    curvatures = Curvatures(*(float(value) for value in model.programme.curvatures[place]))
    bending = model.bending_at(float(model.programme.time[place]))
    return curvatures, bending, model.contact_load(float(model.programme.load[place]), curvatures)


def _at_row(model: RollerModel, place: int) -> RollerStability:
    return _stability(model, 0, *_row(model, place))


def stability_facts(found: RollerStability) -> dict[str, Any]:
    """Numbers of a forecast, None where there is none."""
    return {
        "load_N": found.load,
        "stable": found.growth_rate <= 0.0,
        "growth_rate_1_s": found.growth_rate,
        "frequency_Hz": found.frequency,
        "static_tilt_rad": found.tilt,
        "static_yaw_rad": found.yaw,
        "critical_load_N": _number(found.critical_load),
        "critical_damping_N_m_s": _number(found.critical_damping),
    }


def sentence_before_run(facts: dict[str, Any]) -> str:
    """The forecast in one line."""
    worst = facts.get("worst")
    return _sentence(facts) + (f"; worst at {worst['time_s']:.5g} s: {_sentence(worst)}" if worst else "")


def _sentence(facts: dict[str, Any]) -> str:
    rate, frequency = facts["growth_rate_1_s"], facts["frequency_Hz"]
    how = "diverges" if frequency == 0.0 else f"flutters at {frequency:.5g} Hz"
    motion = (
        f"stable: decays at {-rate:.4g} 1/s" if facts["stable"] else f"unstable: {how}, growth rate {rate:+.4g} 1/s"
    )
    if rate == 0.0:
        motion = "neutral: neither grows nor decays"
    load, damping = facts["critical_load_N"], facts["critical_damping_N_m_s"]
    loads = "none found" if load is None else "none: any load" if load < ANY_LOAD * facts["load_N"] else f"{load:.5g} N"
    dampings = "none" if damping is None else f"{damping:.5g} N m s"
    return f"under {facts['load_N']:.5g} N {motion}; critical load {loads}, critical damping {dampings}"


def _number(value: float) -> float | None:
    return None if math.isnan(value) else value
