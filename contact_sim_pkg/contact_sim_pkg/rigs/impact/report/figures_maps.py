"""Maps of one impact: stress over the contact radius in time, and the surface wave as a space-time
picture.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import TwoSlopeNorm

from contact_sim_pkg.report.drawing import INK, PRESSURE_COLOURS, Margins, Picture, new_figure, picture
from contact_sim_pkg.report.series import FloatArray
from contact_sim_pkg.rigs.impact.report.series import ImpactSeries

DIVERGING = "RdBu_r"
RADII = 121
LIMIT = 2.0  # of the colours over the largest elastic stress; the viscous one has no bound towards the touch


def stress_over_radius(impacts: ImpactSeries) -> Picture | None:
    """Elastic, viscous and whole stress over place and time in the first impact."""
    stress = impacts.stress
    if stress is None:
        return None
    figure, axes = new_figure(2.8, 1, 3, Margins(right=0.6, across=0.4), sharey=True)
    reach: FloatArray = np.linspace(0.0, float(stress.radius.max()), RADII, dtype=np.float64)
    parts = (("elastic", stress.elastic), ("viscous", stress.viscous), ("sum", stress.elastic + stress.viscous))
    usual = LIMIT * float(stress.elastic.max()) * 1e-6 or 1.0
    for place, (title, values) in zip(axes, parts, strict=True):
        over = _on_radii(values, stress.place, stress.radius, reach) * 1e-6
        largest = usual
        signed = title != "elastic"
        norm = TwoSlopeNorm(0.0, -largest, largest) if signed else None
        mesh = place.pcolormesh(
            stress.time * 1e3, reach * 1e3, over.T, cmap=DIVERGING if signed else PRESSURE_COLOURS, norm=norm,
            shading="nearest", rasterized=True,
        )  # fmt: skip
        place.plot(stress.time * 1e3, stress.radius * 1e3, color=INK, linewidth=0.8)
        place.set_title(title)
        place.set_xlabel("time, ms")
        place.grid(visible=False)
        _bar(place, mesh, "MPa", beyond=bool(np.nanmax(over) > largest) and signed)
    axes[0].set_ylabel("distance from the centre, mm")
    limited = int(stress.limited.sum())
    caption = (
        f"Impact {stress.number}: stress in the contact, compression positive, shape {stress.shape}; line: border of the contact, "
        f"up to {stress.radius.max() * 1e3:.4g} mm. Largest elastic stress {stress.elastic.max() * 1e-6:.4g} MPa, largest sum "
        f"{(stress.elastic + stress.viscous).max() * 1e-6:.4g} MPa. The viscous stress has no bound towards the touch: in the "
        f"first {limited} of {len(stress.time)} instants it is that of the depth at which the wave front is as fast as the shear "
        "wave."
    )
    return picture("impact-stress", figure, "Stress over the contact radius in time", caption)


def wave_in_space_and_time(impacts: ImpactSeries) -> Picture | None:
    """Height of the surface around the first impact."""
    wave = impacts.wave
    if wave is None:
        return None
    figure, (axes,) = new_figure(3.6)
    height = np.where(wave.height == 0.0, np.nan, wave.height) * 1e3
    largest = float(np.nanmax(np.abs(height))) if np.isfinite(height).any() else 1.0
    mesh = axes.pcolormesh(
        wave.radius * 1e3, wave.time * 1e3, height, cmap=DIVERGING, norm=TwoSlopeNorm(0.0, -largest, largest),
        shading="nearest", rasterized=True,
    )  # fmt: skip
    times = wave.time[wave.time >= wave.start_time]
    axes.plot((wave.start_radius + wave.speed * (times - wave.start_time)) * 1e3, times * 1e3, color=INK, linewidth=0.9)
    axes.set_xlim(0.0, float(wave.radius[-1]) * 1e3)
    axes.set_xlabel("distance from the impact's centre, mm")
    axes.set_ylabel("time from the touch, ms")
    axes.grid(visible=False)
    _bar(axes, mesh, "height, mm")
    decay = f"falls to 1/e in {1e3 / wave.damping:.4g} ms" if wave.damping > 0.0 else "does not decay"
    caption = (
        f"Surface around impact {wave.number}: it starts at the turning point, {wave.start_time * 1e3:.4g} ms, from a radius of "
        f"{wave.start_radius * 1e3:.4g} mm with {wave.amplitude * 1e3:.4g} mm, a length of {wave.length * 1e3:.4g} mm and runs at "
        f"{wave.speed:.4g} m/s (line: its front), {wave.relative_speed:.3g} of the free surface wave's speed; it {decay}. The area "
        f"of the ring around the contact is {wave.ring_ratio:.4g} of that of the contact at the largest force. Blank: not reached."
    )
    return picture("impact-wave", figure, "Surface wave around an impact over distance and time", caption)


def _on_radii(values: FloatArray, place: FloatArray, radius: FloatArray, reach: FloatArray) -> FloatArray:
    """[instants, radii]: the stress at fixed distances; nan outside the contact."""
    out: FloatArray = np.full((len(radius), len(reach)), np.nan)
    for i, border in enumerate(radius):
        if border > 0.0:
            inside = reach <= border
            out[i, inside] = np.interp(reach[inside] / border, place, values[i])
    return out


def _bar(axes: Axes, mesh: object, label: str, *, beyond: bool = False) -> None:
    extend = "max" if beyond else "neither"
    bar = axes.figure.colorbar(mesh, ax=axes, label=label, pad=0.02, extend=extend)  # type: ignore[arg-type]
    bar.ax.spines["outline"].set_visible(False)
