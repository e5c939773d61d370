"""Stress under the roller and dangerous volumes in two planes: the paper's figures 11 to 14."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from contact_sim_pkg.bag.messages import RollerVolumes
from contact_sim_pkg.core.jit import thaw
from contact_sim_pkg.core.roller.ellipse import RollingContact
from contact_sim_pkg.core.roller.stress import bench_stresses
from contact_sim_pkg.core.roller.volumes import leaves_box
from contact_sim_pkg.scene.build_roller import RollerModel, build_roller

from .drawing import Picture, new_figure, picture
from .roller_pass import RollerSeries
from .series import FloatArray

CELLS = 61
Place: TypeAlias = Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray, FloatArray]]
Plane: TypeAlias = tuple[str, FloatArray, FloatArray, str, Place]
"""Name, places across and along, label of the second, and the points they stand for."""

MAP = "RdBu_r"
MOST = 4
DEPTH = 0.3
"""Of the larger semi-axis: the level of the first plane."""


def stress_pictures(roller: RollerSeries, scene: dict[str, Any]) -> list[Picture]:
    """One picture an instant, of the first four. Opens compilation: a run of this process may have closed it."""
    thaw()
    return [_stress_picture(each, scene) for each in roller.volumes[:MOST] if each.load > 0.0]


def _stress_picture(found: RollerVolumes, scene: dict[str, Any]) -> Picture:
    model = build_roller(scene)
    contact = RollingContact(found.along_x, found.along_y, found.angle, found.peak_pressure, found.approach, found.load)
    a = max(found.along_x, found.along_y)
    side: FloatArray = np.linspace(-2.0, 2.0, CELLS, dtype=np.float64) * a
    down: FloatArray = np.linspace(1e-3, 3.0, CELLS, dtype=np.float64) * a
    planes: tuple[Plane, ...] = (
        (f"z = {DEPTH} a", side, side, "y, mm", lambda u, v: (u, v, np.full_like(u, DEPTH * a))),
        ("y = 0", side, down, "z, mm", lambda u, v: (u, np.zeros_like(u), v)),
    )
    figure, axes = new_figure(4.6, 2, 3)
    largest = 0.0
    for row, (name, across, along, label, place) in enumerate(planes):
        u, v = (part.ravel() for part in np.meshgrid(across, along))
        points = np.ascontiguousarray(np.stack(place(u, v), axis=1))
        stress = _stresses(contact, model, points)
        limits = np.array([found.normal_limit] * 3 + [found.shear_limit] * 3)
        over = (np.abs(stress) > limits).any(axis=1).astype(float)
        if row == 1:
            largest = float(np.abs(stress[:, 4]).max())
        maps = ((stress[:, 2] * 1e-6, "σ_zz, MPa"), (stress[:, 4] * 1e-6, "σ_xz, MPa"), (over, "above a limit"))
        for (values, title), ax in zip(maps, axes[3 * row : 3 * row + 3], strict=True):
            size = float(np.abs(values).max()) or 1.0
            image = ax.pcolormesh(
                across * 1e3,
                along * 1e3,
                values.reshape(CELLS, CELLS),
                cmap="RdBu_r",
                vmin=-size,
                vmax=size,
                rasterized=True,
            )
            ax.set_title(f"{title}, {name}", fontsize=7.5)
            ax.set_xlabel("x, mm")
            ax.set_ylabel(label)
            ax.set_aspect("equal")
            if row == 1:
                ax.invert_yaxis()
            if title != "above a limit":
                figure.colorbar(image, ax=ax)
    caption = (
        f"At {found.time:.4g} s: p₀ = {found.peak_pressure * 1e-6:.5g} MPa, largest |σ_xz| in the plane y = 0 {largest * 1e-6:.4g} "
        f"MPa; limits {found.normal_limit * 1e-6:.4g} MPa (normal) and {found.shear_limit * 1e-6:.4g} MPa (shear), dangerous "
        f"volume {found.volume[-1] * 1e9:.4g} mm³, {100.0 * found.volume[-1] / found.working_volume:.4g} % of the working volume."
    )
    if leaves_box(contact, model.poisson_ratio, (found.normal_limit, found.shear_limit), model.traction):
        caption += " The true volume reaches beyond the box in which it is measured; higher limits tell more."
    name = f"roller-stress-{round(found.time * 1e6)}"
    return picture(name, figure, "Normal and shear stress and dangerous volume in two planes", caption)


def _stresses(contact: RollingContact, model: RollerModel, points: FloatArray) -> FloatArray:
    """Of contact and traction."""
    out = np.zeros((len(points), 6))
    bench_stresses(contact, None, *model.traction, model.poisson_ratio, points, out)
    return out
