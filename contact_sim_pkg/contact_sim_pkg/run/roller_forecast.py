"""What is told of a roller's stability before its run."""

from __future__ import annotations

import math
from typing import Any

import numpy

from contact_sim_pkg.bag.messages import RollerStability
from contact_sim_pkg.core.roller.stability import RollerError, critical_damping, critical_load, stability
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.scene.build_roller import RollerModel, build_roller

SEARCHED = 10.0
"""Times the largest load of the run: as far as a critical load is looked for."""


def forecast(model: RollerModel, block: int = 0) -> RollerStability | None:
    """Stability under the load at the start of a block; None where tilt and yaw are held. Raises RunError without static angles."""
    if model.effects.get("tilt_yaw") is None:
        return None
    time = block * model.timing.block_length
    curvatures = model.programme.curvatures_at(time)
    load = model.contact_load(float(model.programme.loads(numpy.array([time]))[0]), curvatures)
    case = (curvatures, model.bending, model.modulus)
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
        block, load, found.growth_rate, found.frequency, found.linear.tilt, found.linear.yaw,
        math.nan if threshold is None else threshold, damping,
        numpy.array(found.roots.real), numpy.array(found.roots.imag),
    )  # fmt: skip


def facts_before_run(scene: dict[str, Any]) -> dict[str, Any]:
    """The forecast of a resolved scene as numbers with units in their names; empty where tilt and yaw are held."""
    found = forecast(build_roller(scene))
    return {} if found is None else stability_facts(found)


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
    rate, frequency = facts["growth_rate_1_s"], facts["frequency_Hz"]
    how = "diverges" if frequency == 0.0 else f"flutters at {frequency:.5g} Hz"
    motion = (
        f"stable: decays at {-rate:.4g} 1/s" if facts["stable"] else f"unstable: {how}, growth rate {rate:+.4g} 1/s"
    )
    if rate == 0.0:
        motion = "neutral: neither grows nor decays"
    load, damping = facts["critical_load_N"], facts["critical_damping_N_m_s"]
    loads = "none found" if load is None else "none: any load" if load < 1e-5 * facts["load_N"] else f"{load:.5g} N"
    dampings = "none" if damping is None else f"{damping:.5g} N m s"
    return f"under {facts['load_N']:.5g} N {motion}; critical load {loads}, critical damping {dampings}"


def _number(value: float) -> float | None:
    return None if math.isnan(value) else value
