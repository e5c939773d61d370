"""Metrics of the impacts of a sphere: restitution, contact time, force and stress, and the material that they
are read from; beside them Hertz's elastic impact.
"""

from __future__ import annotations

import math
from typing import Any

from contact_sim_pkg.records.messages import ImpactEvents
from contact_sim_pkg.records.metric import EVENT, LIMIT, USUAL_RANGE, Band, Metric
from contact_sim_pkg.report.metrics.maker import Maker, at_most, near
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.impact.material.estimate import EstimatedValue
from contact_sim_pkg.rigs.impact.report.material import material_of_run
from contact_sim_pkg.rigs.impact.report.series import hertz_pressure, impacts_of

IMPACT = "impact"
CONTACT_TIME = 2.9432
"""2 int_0^1 (1 - x^(5/2))^(-1/2) dx: time of Hertz's elastic impact over depth by speed (Johnson, 11.4)"""
LARGEST_LOSS = 0.1
"""Loss tangent up to which the elastic impact is a closed form of the lossy one."""


def impact_metrics(recording: Recording) -> list[Metric]:
    """The list of the impacts; where none ended, their number alone."""
    impacts = impacts_of(recording)
    make = Maker(IMPACT, f"{IMPACT}/events", (0.0, recording.duration), basis=EVENT).make
    if impacts is None:
        return [make("count", "impacts", 0, "", broken=("too short: no impact ended",))] if _drops(recording) else []
    events = impacts.events
    depth, duration, force = _elastic(events)
    lossless = float(events.loss_tangent[0]) <= LARGEST_LOSS
    spans = {
        name: f"{scale * getattr(events, name).min():.4g} to {scale * getattr(events, name).max():.4g}"
        for name, scale in (("restitution", 1.0), ("duration", 1e3), ("peak_force", 1.0))
    }
    count = len(events.number)
    first, lost = _first(events), -float(events.compression_work[0] + events.restitution_work[0])
    stress = 1e-6 * float(
        hertz_pressure(events.peak_force, events.shape_factor * events.storage_modulus, events.radius)[0]
    )

    def elastic(value: float) -> Band | None:
        return near(value, 0.05 + float(events.loss_tangent[0]), "Hertz's elastic impact") if lossless else None

    found = [
        make("restitution", "restitution e of the first", first["restitution"], "", count=count,
             band=Band(0.0, 1.0, USUAL_RANGE, "no impact gains energy"), remark=spans["restitution"]),
        make("duration", "contact time of the first", 1e3 * first["duration"], "ms", band=elastic(1e3 * duration), count=count,
             remark=spans["duration"]),
        make("force", "peak force of the first", first["peak_force"], "N", band=elastic(force), count=count,
             remark=spans["peak_force"]),
        make("stress", "peak Hertz stress of the first", stress, "MPa", band=_below_yield(recording), count=count),
        make("depth", "indentation of the first", 1e3 * first["depth"], "mm", count=count,
             band=elastic(1e3 * depth) or at_most(1e3 * depth, "Hertz's elastic impact, which loss stops earlier")),
        make("speed", "speed of the first", first["speed"], "m/s", band=_drop_speed(recording, events), count=count),
        make("energy", "energy lost by the first", 1e3 * lost, "mJ", count=count,
             band=near(1e3 * _lost(first), 0.02, "m V² (1 − e²) / 2")),
        make("count", "impacts", count, ""),
    ]  # fmt: skip
    return [*found, *_material(make, recording)]


def _drops(recording: Recording) -> bool:
    return recording.scene.get("rig") == IMPACT


def _first(events: ImpactEvents) -> dict[str, float]:
    return {name: float(getattr(events, name)[0]) for name in
            ("restitution", "duration", "peak_force", "depth", "speed", "mass")}  # fmt: skip


def _lost(first: dict[str, float]) -> float:
    """Energy [J] that an impact takes by its speeds, m V^2 (1 - e^2) / 2."""
    return 0.5 * first["mass"] * first["speed"] ** 2 * (1.0 - first["restitution"] ** 2)


def _elastic(events: ImpactEvents) -> tuple[float, float, float]:
    """Depth [m], contact time [s] and force [N] of Hertz's elastic impact at the speed of the first impact:
    x = (15 m V^2 / (16 E* R^(1/2)))^(2/5), t = 2.94 x / V, F = 4/3 E* R^(1/2) x^(3/2).
    """
    mass, speed, radius, modulus = (
        float(each[0])
        for each in (events.mass, events.speed, events.radius, events.shape_factor * events.storage_modulus)
    )
    depth = (15.0 * mass * speed**2 / (16.0 * modulus * math.sqrt(radius))) ** 0.4
    return depth, CONTACT_TIME * depth / speed, 4.0 / 3.0 * modulus * math.sqrt(radius) * depth**1.5


def _below_yield(recording: Recording) -> Band | None:
    strength = ((recording.scene.get(IMPACT) or {}).get("sample") or {}).get("yield_strength")
    return None if strength is None else at_most(1.6e-6 * float(strength), "first yield, 1.60 Y (Johnson, 6.1)", LIMIT)


def _drop_speed(recording: Recording, events: ImpactEvents) -> Band | None:
    """The speed that the scene releases the sphere for."""
    speeds = (recording.scene.get(IMPACT) or {}).get("speeds")
    return near(float(speeds[0]), 1e-3, "speed of the release") if speeds and int(events.release[0]) == 0 else None


def _material(make: Any, recording: Recording) -> list[Metric]:
    """E' and tan beta as `bench material` reads them from the impacts, beside those of the scene."""
    impacts = impacts_of(recording)
    assert impacts is not None
    read, events = material_of_run(impacts, recording.scene), impacts.events
    if read is None:
        return []
    first = read.estimates[0]
    found = first.storage_modulus, first.loss_tangent
    law = 1e-6 * float(events.storage_modulus[0]), float(events.loss_tangent[0])
    return [
        make("storage_modulus", "E′ read from the impacts", 1e-6 * found[0].value, "MPa", count=first.impacts,
             band=near(law[0], 0.05, "E′ of the sample"), spread=1e-6 * _spread(found[0])),
        make("loss_tangent", "tan β read from the impacts", found[1].value, "", count=first.impacts,
             band=near(law[1], 0.1, "tan β of the sample"), spread=_spread(found[1])),
    ]  # fmt: skip


def _spread(found: EstimatedValue) -> float:
    return math.nan if found.low is None or found.high is None else 0.5 * (found.high - found.low)
