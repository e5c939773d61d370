"""Pictures of the occupant: apparent mass and seat-to-head transmissibility, beside the closed form
of the linear model.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from contact_sim_pkg.report.drawing import INK, Picture, picture
from contact_sim_pkg.report.signal.spectrum import HIGHEST_FREQUENCY, Transmissibility
from contact_sim_pkg.rigs.vehicle.seat.biodynamics import apparent_mass, seat_to_head
from contact_sim_pkg.rigs.vehicle.seat.report.figures_ride import peak_sentence, response_figure
from contact_sim_pkg.rigs.vehicle.seat.report.occupant import (
    OccupantSignals,
    apparent_mass_of,
    seat_to_head_of,
)
from contact_sim_pkg.rigs.vehicle.seat.report.response import TRUSTED_COHERENCE, trusted_part

CLOSED = np.geomspace(0.25, HIGHEST_FREQUENCY, 300)
"""[Hz] of the closed form"""


def occupant_pictures(signals: OccupantSignals) -> list[Picture]:
    """Apparent mass, and the way to the head where the model has one; none for a seat at rest."""
    found = [_apparent_mass(signals), _seat_to_head(signals)]
    return [each for each in found if each is not None]


def _apparent_mass(signals: OccupantSignals) -> Picture | None:
    result = apparent_mass_of(signals)
    return _picture(
        signals, result, apparent_mass(signals.model, CLOSED), "ride-apparent-mass", "apparent mass, kg",
        "Apparent mass of the occupant: magnitude, phase, coherence", "Force on the seat over its acceleration",
    )  # fmt: skip


def _seat_to_head(signals: OccupantSignals) -> Picture | None:
    result = seat_to_head_of(signals)
    if result is None:
        return None
    return _picture(
        signals, result, seat_to_head(signals.model, CLOSED), "ride-seat-to-head", "head / seat",
        "Transmissibility from seat to head: magnitude, phase, coherence", "Head over seat",
    )  # fmt: skip


def _picture(
    signals: OccupantSignals, result: Transmissibility, closed: NDArray[np.complex128], key: str, label: str,
    title: str, meaning: str,
) -> Picture | None:  # fmt: skip
    trusted = trusted_part(result, signals.seat, signals.sample_rate)
    if trusted is None:
        return None
    figure, axes = response_figure(result, trusted, label)
    if signals.alone:
        _draw_closed(axes, closed)
    highest = max(float(abs(closed).max()), float(result.magnitude[trusted].max(initial=0.0)))
    axes[0].set_ylim(0.0, 1.3 * highest)
    line = " Thin line: the linear model in closed form." if signals.alone else ""
    caption = (
        f"{meaning}, {signals.name} ({signals.model.source}), mean of {result.segments} segments; blue where the "
        f"coherence γ² is at least {TRUSTED_COHERENCE} (dashed) and the seat moves enough. {peak_sentence(result, trusted)}{line}"
    )
    return picture(key, figure, title, caption)


def _draw_closed(axes: list[Axes], closed: NDArray[np.complex128]) -> None:
    axes[0].semilogx(CLOSED, abs(closed), color=INK, linewidth=0.7)
    axes[1].semilogx(CLOSED, np.degrees(np.angle(closed)), color=INK, linewidth=0.7)
