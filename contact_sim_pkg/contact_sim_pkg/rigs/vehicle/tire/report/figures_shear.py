"""Pictures of the friction of a rolling tire: forces over time and over slip, shear and stick and
slip of the cells.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.patches import Patch
from numpy.typing import NDArray

from contact_sim_pkg.records.messages import ContactShear
from contact_sim_pkg.report.drawing import ACCENT, MUTED, SHEAR_COLOURS, WIDTH, WITH_BARS, Picture, new_figure, picture
from contact_sim_pkg.report.figures.maps import Window, draw_map, loaded_window, set_window
from contact_sim_pkg.report.series import FloatArray, PressureMap
from contact_sim_pkg.report.signal.decimate import envelope
from contact_sim_pkg.rigs.vehicle.tire.report.shear_series import ShearMap, ShearSeries

APART, STICKS, SLIPS = ContactShear.APART, ContactShear.STICKS, ContactShear.SLIPS
STATE_COLOURS = ("#2f7fb5", "#e08a2e")
"""Sticks, slips: colours that everyone distinguishes."""
LEAST_SPREAD = 1e-3
"""Slip, or slip angle [rad], must vary by that much for a curve over it."""
ARROWS = 14
"""Most arrows along one side of a map."""


def friction_over_time(key: str, name: str, shear: ShearSeries) -> Picture:
    """Slip and slip angle, and what they make: forces, moment, share of slipping cells."""
    panels = [
        ("slip κ, %", 100.0 * shear.slip),
        ("slip angle α, °", np.degrees(shear.slip_angle)),
        ("Fx forward, kN", shear.force_x * 1e-3),
        ("Fy left, kN", shear.force_y * 1e-3),
        ("Mz, N m", shear.moment_z),
        ("slipping, %", 100.0 * shear.sliding_share),
    ]
    # Panels without a signal are left out.
    panels = [panel for panel in panels if np.any(panel[1])]
    figure, axes = new_figure(0.6 + 1.1 * max(1, len(panels)), max(1, len(panels)), sharex=True)
    for place, (label, values) in zip(axes, panels, strict=False):
        place.plot(*envelope(shear.time, values), color=ACCENT)
        place.axhline(0.0, color=MUTED, linewidth=0.7)
        place.set_ylabel(label)
    axes[-1].set_xlabel("simulated time, s")
    axes[-1].set_xlim(shear.time[0], max(shear.time[-1], shear.time[0] + 1e-3))
    figure.align_ylabels(axes)
    caption = (
        f"Friction of the {name} on its tread: {_largest(shear, 'force_x', 'Fx', 'N')}, {_largest(shear, 'force_y', 'Fy', 'N')}, "
        f"{_largest(shear, 'moment_z', 'Mz', 'N m')}, about the point below the wheel's centre. Slip κ = (ωR − v)/v, negative "
        f"when braking; a positive slip angle makes Fy negative (ISO 8855). {_lost(shear)}"
    )
    return picture(f"{key}-time", figure, f"Friction of the {name} over time", caption)


def _lost(shear: ShearSeries) -> str:
    lost = f"{shear.dissipated.sum():.5g} J"
    if not shear.largest[0].state.size:
        return f"Forces of the Magic Formula at slips that relax; {lost} were lost at the road."
    return f"Slipping: share of the cells in contact. Friction and bristles that leave the contact dissipated {lost}."


def friction_over_slip(key: str, name: str, shear: ShearSeries, time: FloatArray, normal: FloatArray) -> Picture | None:
    """Force over load against slip, and side force and moment against slip angle; None where slip
    does not vary. The load is ``normal`` [N] at times ``time`` [s], [instants] each.
    """
    along, across = float(np.ptp(shear.slip)) > LEAST_SPREAD, float(np.ptp(shear.slip_angle)) > LEAST_SPREAD
    if not (along or across):
        return None
    # Ratios to a load near zero mean nothing: they are left out.
    load = np.interp(shear.time, time, normal)
    touching = load > 0.05 * max(float(load.max()), 1e-9)
    share_x, share_y = (_over(force, load, touching) for force in (shear.force_x, shear.force_y))
    curves = [("slip κ, %", 100.0 * shear.slip, share_x, "Fx / Fz")] * along
    curves += [
        ("slip angle α, °", np.degrees(shear.slip_angle), share_y, "Fy / Fz"),
        ("slip angle α, °", np.degrees(shear.slip_angle), np.where(touching, shear.moment_z, np.nan), "Mz, N m"),
    ] * across
    figure, axes = new_figure(2.9, 1, max(2, len(curves)))
    for place, (label, slip, values, quantity) in zip(axes, curves, strict=False):
        place.plot(slip, values, color=ACCENT, linewidth=0.8, marker=".", markersize=2.5)
        place.axhline(0.0, color=MUTED, linewidth=0.7)
        place.axvline(0.0, color=MUTED, linewidth=0.7)
        place.set_xlabel(label)
        place.set_ylabel(quantity)
        if float(np.abs(slip).max()) > 30.0:
            _wide_slip_axis(place, slip)
    for place in axes[len(curves) :]:
        place.set_axis_off()
    # The largest friction used, for the caption.
    used = np.hypot(share_x, share_y)
    best = int(np.nanargmax(used)) if np.isfinite(used).any() else 0
    caption = (
        "Friction over the load of the same instant, in the order of time: where slip and slip angle act together, or change "
        "faster than the tire rolls through its footprint, the curve has branches. Largest resultant "
        f"{used[best]:.3f} of the load at κ = {100.0 * shear.slip[best]:.3g} %, α = {np.degrees(shear.slip_angle[best]):.3g}°."
    )
    return picture(f"{key}-slip", figure, f"Friction of the {name} over slip", caption)


def _wide_slip_axis(axes: Axes, slip: FloatArray) -> None:
    """Slips up to a locked wheel, [%]: linear up to 10, where the force rises, then logarithmic."""
    axes.set_xscale("symlog", linthresh=10.0, linscale=0.8)
    low, high = min(1.15 * float(slip.min()), -1.0), max(1.15 * float(slip.max()), 1.0)
    axes.set_xlim(low, high)
    ticks = [tick for tick in (-100, -30, -10, 0, 10, 30, 100) if low <= tick <= high]
    axes.set_xticks(ticks, [f"{tick:d}".replace("-", "−") for tick in ticks])
    axes.minorticks_off()


def shear_maps(key: str, name: str, shear: ShearSeries) -> Picture | None:
    """Shear with arrows, and which cells stick and slip, where the forces along and across are
    largest; None of forces without cells.
    """
    shown = shear.largest
    if not shown[0].state.size:
        return None
    windows = [loaded_window(_loaded(each)) for each in shown]
    height = float(np.clip(windows[0].aspect * 0.36 * WIDTH, 1.2, 3.2)) + 0.75
    figure, axes = new_figure(height * len(shown) + 0.2, len(shown), 2, WITH_BARS)
    # One row of maps for each instant: stress, state.
    for row, (each, window) in enumerate(zip(shown, windows, strict=True)):
        _draw_shear(axes[2 * row], each, window)
        _draw_state(axes[2 * row + 1], each, window)
    parts = [
        f"{each.time:.3f} s: κ = {100.0 * each.slip:.3g} %, α = {np.degrees(each.slip_angle):.3g}°, Fx = {each.force_x:.5g} N, "
        f"Fy = {each.force_y:.5g} N, Mz = {round(each.moment_z, 3):.4g} N m, {each.sliding_share:.1%} of the cells slip"
        for each in shown
    ]
    caption = (
        f"Shear on the {name} where its friction along and across is largest while some cells stick: "
        f"{'; '.join(parts)}. Left: magnitude, with arrows along the stress on the "
        "tire. Right: cells whose bristle sticks to the road or slips. Seen from above, forward is up; the tread enters at "
        "the top."
    )
    return picture(f"{key}-map", figure, f"Shear of the {name} with stick and slip", caption)


def _draw_shear(axes: Axes, shear: ShearMap, window: Window) -> None:
    magnitude = shear.grid.pressure * 1e-3
    there = shear.state != APART
    limits = Normalize(0.0, float(magnitude.max()) or 1.0)
    image = draw_map(axes, shear.grid, np.where(there, magnitude, np.nan), SHEAR_COLOURS, limits)
    set_window(axes, window)
    rows, cols = (np.flatnonzero(there.any(axis=axis)) for axis in (1, 0))
    if rows.size:
        step_row, step_col = (max(1, -(-(each[-1] - each[0] + 1) // ARROWS)) for each in (rows, cols))
        i, j = np.meshgrid(rows[step_row // 2 :: step_row], cols[step_col // 2 :: step_col], indexing="ij")
        i, j = i[there[i, j]], j[there[i, j]]
        # y counts to the left: the axis runs from right to left, and so do the arrows.
        axes.quiver(
            (shear.grid.origin_y + j * shear.grid.cell_y) * 1e3, (shear.grid.origin_x + i * shear.grid.cell_x) * 1e3,
            shear.shear_y[i, j], shear.shear_x[i, j], angles="xy", color="#ffffff", width=0.004, pivot="middle",
        )  # fmt: skip
    axes.set_title(f"shear, t = {shear.time:.3f} s")
    _label(axes)
    bar = axes.figure.colorbar(image, cax=axes.inset_axes((1.03, 0.0, 0.04, 1.0)), label="kPa")
    bar.ax.spines["outline"].set_visible(False)


def _draw_state(axes: Axes, shear: ShearMap, window: Window) -> None:
    state = np.where(shear.state == APART, np.nan, shear.state.astype(np.float64))
    draw_map(axes, shear.grid, state, _STATES, Normalize(STICKS - 0.5, SLIPS + 0.5))
    set_window(axes, window)
    axes.set_title("state of the cells")
    _label(axes)
    handles = [
        Patch(color=colour, label=label) for colour, label in zip(STATE_COLOURS, ("sticks", "slips"), strict=True)
    ]
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0), handlelength=1.0)


_STATES = ListedColormap(list(STATE_COLOURS))


def _label(axes: Axes) -> None:
    axes.set_xlabel("← left, y, mm")
    axes.set_ylabel("forward, x, mm →")


def _loaded(shear: ShearMap) -> PressureMap:
    """The grid with 1 in every cell in contact."""
    return shear.grid._replace(pressure=(shear.state != APART).astype(np.float64))


def _over(force: FloatArray, load: FloatArray, touching: NDArray[np.bool_]) -> FloatArray:
    ratio: FloatArray = np.where(touching, force, np.nan) / np.where(touching, load, 1.0)
    return ratio


def _largest(shear: ShearSeries, column: str, symbol: str, unit: str) -> str:
    values: FloatArray = getattr(shear, column)
    place = int(np.abs(values).argmax())
    return f"{symbol} {values[place]:.5g} {unit} at {shear.time[place]:.3f} s"
