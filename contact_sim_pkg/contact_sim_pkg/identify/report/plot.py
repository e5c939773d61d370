"""Picture of an identification: the motion with its contacts, the impulses over mass, the inertia
that each impact identifies.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy

from contact_sim_pkg.identify.identify import Identification
from contact_sim_pkg.identify.motion.geometry import gaps
from contact_sim_pkg.report.drawing import ACCENT, MUTED, new_figure, save_picture, style

__all__ = ["write_plot"]

LEAST_RANGE = 0.02  # of the axis of the parameters: less would draw rounding at full size
COLOURS = {"stick": ACCENT, "slide": "#b8551b", "slide, reversed": "#7a3b9e"}


def write_plot(found: Identification, path: str | Path, *, overwrite: bool = False) -> Path:
    """Draw; the ending of `path` names the format. Raises FileRefusedError, see
    `drawing.save_picture`.
    """
    with style():
        figure, axes = new_figure(7.0, 3)
        figure.set_facecolor("white")
        _height(axes[0], found)
        _impulses(axes[1], found)
        axes[1].set_xlim(axes[0].get_xlim())
        _inertia(axes[2], found)
        return save_picture(figure, path, overwrite=overwrite, dpi=130, facecolor="white")


def _height(axis: Any, found: Identification) -> None:
    states, problem = found.problem.states, found.problem
    lifts = gaps(problem.shape, problem.ground, states.position, states.rotation).min(axis=1)
    axis.plot(states.time, 1e3 * lifts, color=MUTED)
    for contact in found.contacts:
        mode = "" if contact.mode is None else contact.mode.mode
        axis.axvspan(contact.begin, contact.end, color=COLOURS.get(mode, MUTED), alpha=0.6, linewidth=1.0)
    axis.set_title("Gap of the lowest point; contacts marked")
    axis.set_xlabel("time [s]")
    axis.set_ylabel("gap [mm]")


def _impulses(axis: Any, found: Identification) -> None:
    """Normal impulses as circles, tangential ones as squares, in the colour of the mode; grey where
    its point is not known.
    """
    known = [contact for contact in found.contacts if contact.normal is not None]
    # Grey points have no mode
    for mode, colour in (*COLOURS.items(), (None, MUTED)):
        chosen = [contact for contact in known if (None if contact.mode is None else contact.mode.mode) == mode]
        if not chosen:
            continue
        time = [contact.begin for contact in chosen]
        for name, marker in (("normal", "o"), ("tangential", "s")):
            values = [getattr(contact, name) for contact in chosen]
            spread = [2.0 * (getattr(contact, f"{name}_deviation") or 0.0) for contact in chosen]
            label = None if name == "tangential" else mode or "corner not known"
            axis.errorbar(time, values, spread, fmt=marker, color=colour, markersize=4, label=label)
    axis.set_title("Impulses over mass: ● normal, ■ tangential")
    axis.set_xlabel("time [s]")
    axis.set_ylabel("c/m ± 2σ [m/s]")
    if known:
        axis.legend(ncols=4, loc="lower right", bbox_to_anchor=(1.0, 1.0), fontsize=8, borderaxespad=0.2)


def _inertia(axis: Any, found: Identification) -> None:
    """Each parameter over its size, with the directions that are not identified named below."""
    scale = found.estimate.scale
    for place, parameter in enumerate(found.parameters):
        value = parameter.value / scale[place]
        if parameter.identified:
            axis.errorbar(
                [place], [value], [2.0 * parameter.deviation / scale[place]], fmt="o", color=ACCENT, markersize=5
            )
            last = place > 0 and place == len(found.parameters) - 1
            axis.annotate(
                f"{parameter.value:.5g}", (place, value), textcoords="offset points", xytext=(-7 if last else 7, 4),
                ha="right" if last else "left", fontsize=8,
            )  # fmt: skip
        else:
            axis.annotate("not identified", (place, 0.0), ha="center", fontsize=8, color=MUTED)
    axis.set_xticks(numpy.arange(len(found.parameters)), [parameter.name for parameter in found.parameters])
    axis.set_xlim(-0.6, len(found.parameters) - 0.4)
    axis.margins(y=0.25)
    low, high = axis.get_ylim()
    widen = max(0.0, 0.5 * (LEAST_RANGE - (high - low)))
    axis.set_ylim(low - widen, high + widen)
    axis.set_title("Parameters over the size of a homogeneous box (bars: two standard deviations)")
    axis.set_ylabel("value / size")
