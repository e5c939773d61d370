"""Pictures of what a pressure field does: displacement of the surface, pressure over the reference,
stress below.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from contact_sim_pkg.report.drawing import (
    ACCENT,
    DISPLACEMENT_COLOURS,
    INK,
    MUTED,
    PRESSURE_COLOURS,
    STRESS_COLOURS,
    Picture,
    new_figure,
    picture,
)
from contact_sim_pkg.report.figures.maps import Quantity, loaded_window, surface_and_map, whole_window
from contact_sim_pkg.report.series import FloatArray, Snapshot
from contact_sim_pkg.rigs.vehicle.tire.report.closed_form import TireReference
from contact_sim_pkg.rigs.vehicle.tire.report.displacement import surface_displacement
from contact_sim_pkg.rigs.vehicle.tire.report.stress_plane import StressPlane, stress_plane


def displacement_picture(key: str, snapshot: Snapshot, reference: TireReference) -> Picture:
    """Surface displacement u(x, y) under the field."""
    field = snapshot.field
    raised = surface_displacement(field, reference.body) * 1e3
    quantity = Quantity(raised, "displacement u, mm", DISPLACEMENT_COLOURS)
    figure = surface_and_map(field, quantity, whole_window(field), outline=True)
    inside = raised[field.pressure > 0.0]
    caption = (
        f"Displacement of the tread's surface at the largest load, {snapshot.load:.5g} N at {snapshot.time:.3f} s: "
        f"u = (1/πE*) ∬ p/r dA of the recorded pressure on its {raised.shape[0]} × {raised.shape[1]} cells, "
        f"E* = {reference.body.modulus * 1e-6:.4g} MPa{_with_belt(reference)}, positive into the tread. "
        f"Largest {raised.max():.4g} mm, inside the "
        f"contact (white line) at least {inside.min():.4g} mm, at the edge of the grid still {_rim(raised):.3g} mm. The "
        "recorded pressure holds the share of the loss; it is taken as elastic here."
    )
    return picture(f"{key}-displacement", figure, "Displacement of the tread's surface at the largest load", caption)


def _with_belt(reference: TireReference) -> str:
    belt = reference.body.belt
    if belt is None:
        return ""
    return f", and the deflection of the belt ({belt.tension:.4g} N on {belt.foundation * 1e-6:.4g} MN/m²)"


def _rim(values: FloatArray) -> float:
    return float(max(values[0].max(), values[-1].max(), values[:, 0].max(), values[:, -1].max()))


def relative_pressure_picture(key: str, snapshot: Snapshot, reference: TireReference) -> Picture:
    """Pressure over the largest pressure of the tire at rest on a flat road."""
    field, form = snapshot.field, reference.body.form
    relative = field.pressure / reference.peak_pressure
    quantity = Quantity(relative, "p / p_ref,max", PRESSURE_COLOURS)
    figure = surface_and_map(field, quantity, loaded_window(field), outline=False)
    caption = (
        f"Pressure at the largest load, {snapshot.load:.5g} N at {snapshot.time:.3f} s, over the largest pressure of the "
        f"tire at rest on a flat road, p_ref,max = {reference.peak_pressure * 1e-3:.4g} kPa ({reference.how}, "
        f"{reference.load:.5g} N, radii {form.radius_rolling:.4g} and {form.radius_lateral:.4g} m). Largest: "
        f"{relative.max():.3f}."
    )
    if reference.body.belt is None:
        flat = (snapshot.load / reference.load) ** (1.0 / 3.0)
        caption += f" A Hertz contact under this load on a flat road would have {flat:.3f}."
    return picture(f"{key}-relative", figure, "Pressure over the reference maximum at the largest load", caption)


def stress_picture(key: str, snapshot: Snapshot, poisson_ratio: float) -> Picture | None:
    """Von Mises stress in the plane along the rolling direction, and stresses over depth below its
    largest value.

    poisson_ratio: of the tread, dimensionless.
    """
    plane = stress_plane(snapshot.field, poisson_ratio)
    if plane is None:
        return None
    figure, axes = new_figure(3.3, 1, 2, width_ratios=[3, 2])
    x, z = plane.x * 1e3, plane.z * 1e3
    mises = plane.von_mises * 1e-3
    mesh = axes[0].pcolormesh(x, z, mises, cmap=STRESS_COLOURS, shading="gouraud", vmin=0.0, rasterized=True)
    lines = axes[0].contour(x, z, mises, levels=6, colors="#ffffff", linewidths=0.5, alpha=0.7)
    lines.set_clim(0.0, mises.max())
    row, col = np.unravel_index(int(mises.argmax()), mises.shape)
    axes[0].plot([x[col]], [z[row]], marker="x", color="#b3202c", markersize=6.4, markeredgewidth=1.4, linestyle="")
    axes[0].invert_yaxis()
    axes[0].grid(visible=False)
    axes[0].set_xlabel("forward, x, mm →")
    axes[0].set_ylabel("depth, mm")
    bar = figure.colorbar(mesh, ax=axes[0], label="von Mises stress, kPa", pad=0.02, aspect=28)
    bar.ax.spines["outline"].set_visible(False)
    _draw_depth(axes[1], plane, int(col))
    return picture(
        f"{key}-stress", figure, "Stress below the tread's surface at the largest load",
        _stress_caption(snapshot, plane, poisson_ratio, (int(row), int(col))),
    )  # fmt: skip


def _draw_depth(axes: Axes, plane: StressPlane, col: int) -> None:
    z = plane.z * 1e3
    axes.plot(plane.von_mises[:, col] * 1e-3, z, color=ACCENT, label="von Mises")
    axes.plot(plane.max_shear[:, col] * 1e-3, z, color=INK, linestyle=(0, (4, 2)), label="largest shear")
    axes.plot(-plane.normal[:, col] * 1e-3, z, color=MUTED, label="compression σz")
    axes.invert_yaxis()
    axes.set_xlim(left=0.0)
    axes.set_xlabel("stress below the cross, kPa")
    axes.set_ylabel("depth, mm")
    axes.legend(loc="lower right")


def _stress_caption(snapshot: Snapshot, plane: StressPlane, poisson_ratio: float, at: tuple[int, int]) -> str:
    row, col = at
    peak = float(snapshot.field.pressure.max())
    shear_row, _ = np.unravel_index(int(plane.max_shear.argmax()), plane.max_shear.shape)
    at_the_top = (
        " The largest value lies at the upper edge of the picture: at an edge of the road it grows with finer cells."
    )
    return (
        f"Elastic half-space with ν = {poisson_ratio:g} under the field at the largest load ({snapshot.time:.3f} s), "
        f"without friction, plane y = {plane.y * 1e3:.3g} mm through the centre of pressure. Largest von Mises stress in the plane "
        f"{plane.von_mises[row, col] * 1e-3:.4g} kPa ({plane.von_mises[row, col] / peak:.3f} of the peak pressure) at x = "
        f"{plane.x[col] * 1e3:.3g} mm, {plane.z[row] * 1e3:.3g} mm deep (cross); largest shear "
        f"{plane.max_shear.max() * 1e-3:.4g} kPa, {plane.z[shear_row] * 1e3:.3g} mm deep. The first "
        f"{plane.z[0] * 1e3:.2g} mm, one cell, are left out.{at_the_top if row == 0 else ''}"
    )
