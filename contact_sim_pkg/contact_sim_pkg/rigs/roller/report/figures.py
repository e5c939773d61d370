"""Pictures of the roller rig in time: contact, motion, spectrogram of the load, stability over load
and speed.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from contact_sim_pkg.report.drawing import ACCENT, INK, Margins, Picture, draw_series, legend_above, new_figure, picture
from contact_sim_pkg.report.signal.decimate import envelope
from contact_sim_pkg.rigs.roller.model import build_roller
from contact_sim_pkg.rigs.roller.report.series import RollerSeries
from contact_sim_pkg.rigs.roller.theory.stability import RollerError, stability
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

OTHER = "#e08a2e"
SMALL = Margins(left=1.05, shared=0.28)
"""Room for the long tick labels of small motions."""
LEAST_CHANGE = 1e-3  # of a value's mean: less is drawn as a level line
MAP_ROWS = 25
SPECTRUM_PARTS = 60


def pressure_and_volume(roller: RollerSeries) -> Picture:
    """Largest pressure and, where the scene reports it more than once, the dangerous volume of any stress over time."""
    pressure = roller.contact.peak_pressure * 1e-6
    several = len(roller.volumes) > 1
    figure, axes = new_figure(3.2 if several else 2.0, 2 if several else 1, margins=SMALL, sharex=True)
    draw_series(axes[0], roller.time, pressure, color=ACCENT, linewidth=0.9)
    axes[0].set_ylabel("p₀, MPa")
    axes[0].set_ylim(bottom=0.0)
    caption = f"Largest pressure, {pressure.min():.5g} to {pressure.max():.5g} MPa."
    if several:
        volumes = roller.dangerous_volumes() * 1e9
        axes[1].plot(
            [each.time for each in roller.volumes], volumes, color=OTHER, marker="o", markersize=3, linewidth=0.9
        )
        axes[1].set_ylabel("volume, mm³")
        axes[1].set_ylim(0.0, 1.1 * volumes.max() or None)  # a mark stands whole
        caption += f" Volume in which a stress is above its limit, measured {len(volumes)} times: at most {volumes.max():.4g} mm³."
    axes[-1].set_xlabel("simulated time, s")
    figure.align_ylabels(axes)
    return picture("roller-pressure", figure, "Largest pressure and dangerous volume over time", caption)


def contact_over_time(roller: RollerSeries) -> Picture:
    """Semi-axes, area, pressure, approach and load over time: the paper's figure 10."""
    c, time = roller.contact, roller.time
    figure, axes = new_figure(5.2, 5, margins=SMALL, sharex=True)
    for values, colour, label in ((c.along_x, ACCENT, "nearer to x"), (c.along_y, OTHER, "nearer to y")):
        axes[0].plot(*envelope(time, values * 1e3), color=colour, label=label, linewidth=0.9)
    legend_above(axes[0])
    axes[0].set_ylabel("semi-axes, mm")
    area = np.pi * c.along_x * c.along_y
    rows = (
        (area * 1e6, "S, mm²"),
        (c.peak_pressure * 1e-6, "p₀, MPa"),
        (c.approach * 1e6, "δ, µm"),
        (c.load, "load, N"),
    )
    for place, (values, label) in zip(axes[1:], rows, strict=True):
        draw_series(place, time, values, color=ACCENT, linewidth=0.9)
        place.set_ylabel(label)
        # A constant has a range of its own, or rounding would fill the panel.
        if np.ptp(values) < LEAST_CHANGE * values.mean():
            place.set_ylim(0.95 * values.mean(), 1.05 * values.mean())
    axes[-1].set_xlabel("simulated time, s")
    figure.align_ylabels(axes)
    caption = (
        f"Semi-axes of the contact, its area, largest pressure ({c.peak_pressure.max() * 1e-6:.5g} MPa at most), approach "
        f"and the load on it ({c.load.min():.5g} to {c.load.max():.5g} N)."
    )
    return picture("roller-contact", figure, "Semi-axes, area, pressure, approach and load over time", caption)


def motion_over_time(roller: RollerSeries) -> Picture | None:
    """Tilt, yaw and heave; None where nothing moves."""
    c = roller.contact
    rows = [(c.tilt * 1e3, "tilt, mrad"), (c.yaw * 1e3, "yaw, mrad"), (c.heave * 1e6, "heave, µm")]
    rows = [(values, label) for values, label in rows if np.ptp(values) > 0.0]
    if not rows:
        return None
    figure, axes = new_figure(0.8 + 1.4 * len(rows), len(rows), margins=SMALL, sharex=True)
    for place, (values, label) in zip(axes, rows, strict=True):
        draw_series(place, roller.time, values, color=ACCENT, linewidth=0.7)
        place.set_ylabel(label)
    axes[-1].set_xlabel("simulated time, s")
    figure.align_ylabels(axes)
    known = ""
    if roller.stability:
        first = roller.stability[0]
        known = f" Known before the run: growth rate {first.growth_rate:+.4g} 1/s at {first.frequency:.5g} Hz."
    return picture("roller-motion", figure, "Tilt, yaw and heave over time", f"Motion of the roller.{known}")


def load_spectrogram(roller: RollerSeries) -> Picture | None:
    """Amplitudes of the load over frequency and time; None where it does not change or the run is
    short.
    """
    load, part = roller.contact.load, len(roller.contact.load) // SPECTRUM_PARTS
    if part < 32 or np.ptp(load) <= 1e-9 * float(load.max()):
        return None
    parts = load[: part * SPECTRUM_PARTS].reshape(SPECTRUM_PARTS, part)
    # Short-time spectra with a Hann window; amplitudes of sines in [N].
    window = np.hanning(part)
    parts = (parts - parts.mean(axis=1, keepdims=True)) * window
    sizes = 2.0 * np.abs(np.fft.rfft(parts, axis=1)) / window.sum()
    frequency = np.fft.rfftfreq(part, roller.contact.period)
    figure, (axes,) = new_figure(3.0)
    levels = np.log10(np.maximum(sizes, 1e-9 * sizes.max()))
    time = roller.time[::part][:SPECTRUM_PARTS] + 0.5 * part * roller.contact.period
    image = axes.pcolormesh(time, frequency, levels.T, cmap="magma", vmin=levels.max() - 6.0, rasterized=True)
    figure.colorbar(image, ax=axes, label="log₁₀ of the amplitude in N")
    axes.set_xlabel("simulated time, s")
    axes.set_ylabel("frequency, Hz")
    strongest = frequency[int(sizes[-1].argmax())]
    width = float(frequency[1])
    caption = (
        f"Load on the contact by frequency, in steps of {width:.3g} Hz; at the end strongest at {strongest:.0f} ± "
        f"{0.5 * width:.2g} Hz ({sizes[-1].max():.3g} N). Samples of the load at instants: what is faster than "
        f"{frequency[-1]:.6g} Hz appears below it."
    )
    return picture("roller-spectrogram", figure, "Spectrogram of the load on the contact", caption)


def stability_map(roller: RollerSeries, scene: dict[str, Any]) -> Picture | None:
    """Growth rate of tilt and yaw over load and speed; None where they are held."""
    if not roller.stability:
        return None
    model = build_roller(ResolvedScene(scene))
    at = roller.stability[0]
    curvatures = model.programme.curvatures_at(0.0)
    loads = np.linspace(0.05, 2.0, MAP_ROWS) * model.largest_load
    spins = np.linspace(0.0, 2.0, MAP_ROWS) * model.roller.spin
    growth = np.full((MAP_ROWS, MAP_ROWS), np.nan)
    for i, spin in enumerate(spins):
        for j, load in enumerate(loads):
            turned = model.roller._replace(spin=float(spin))
            # A load without static angles leaves its cell blank.
            try:
                growth[i, j] = stability(
                    turned, curvatures, model.bending_at(0.0), model.modulus, float(load)
                ).growth_rate
            except RollerError:
                continue
    figure, (axes,) = new_figure(3.0)
    largest = float(np.nanmax(np.abs(growth))) or 1.0
    turns = spins / (2.0 * np.pi)
    image = axes.pcolormesh(loads, turns, growth, cmap="RdBu_r", vmin=-largest, vmax=largest, rasterized=True)
    # The border of stability is drawn where both signs occur.
    zero = np.nanmin(growth) < -1e-6 * largest and np.nanmax(growth) > 1e-6 * largest
    if zero:
        axes.contour(loads, turns, growth, levels=[0.0], colors=INK, linewidths=1.0)
    figure.colorbar(image, ax=axes, label="growth rate, 1/s")
    axes.plot(at.load, model.roller.spin / (2.0 * np.pi), marker="o", color=INK, markersize=4)
    axes.set_xlabel("load, N")
    axes.set_ylabel("turns of the roller, 1/s")
    caption = (
        f"Growth rate of the fastest growing motion of tilt and yaw; {'the line is its zero, ' if zero else ''}the point the "
        f"start of the run ({at.growth_rate:+.4g} 1/s)."
    )
    return picture("roller-stability", figure, "Growth rate over load and speed", caption)
