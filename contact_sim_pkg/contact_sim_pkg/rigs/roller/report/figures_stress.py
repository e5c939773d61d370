"""Stress under the roller and dangerous volumes in two planes: the paper's figures 11 to 14."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from matplotlib.colors import ListedColormap

from contact_sim_pkg.pressure.closed_form.subsurface import Stress
from contact_sim_pkg.records.messages import RollerVolumes
from contact_sim_pkg.report.drawing import Margins, Picture, new_figure, picture
from contact_sim_pkg.report.series import FloatArray
from contact_sim_pkg.rigs.roller.model import RollerModel, build_roller
from contact_sim_pkg.rigs.roller.report.series import RollerSeries
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact
from contact_sim_pkg.rigs.roller.theory.stress import bench_stresses
from contact_sim_pkg.rigs.roller.theory.volumes import leaves_box
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

CELLS = 61
ZOOMS = 4
Place: TypeAlias = Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray, FloatArray]]
Plane: TypeAlias = tuple[str, FloatArray, FloatArray, str, Place]
"""Name, places across and along, label of the second, and the points they stand for."""

MAP = "RdBu_r"
OVER = "above a limit"
TONES = ("none", "other", "σ_xz", "σ_zz", "both")
"""Of the dangerous volumes of one plane: darker where both volumes of the paper's figures overlap."""
ROOM = Margins(right=0.5, across=1.08)
COLOURS = ListedColormap(["#ffffff", "#e3e1dc", "#f2b871", "#e2775c", "#7c1d2f"])
MOST = 4
"""Instants with a picture."""
DEPTH = 0.3
"""Of the larger semi-axis: the level of the first plane."""


def stress_pictures(roller: RollerSeries, scene: dict[str, Any]) -> list[Picture]:
    """One picture an instant, of the first four."""
    loaded = [each for each in roller.volumes if each.load > 0.0]
    found = [_stress_picture(each, scene) for each in loaded[:MOST]]
    if len(loaded) > MOST:
        more = f" Without a picture, in the table alone: {len(loaded) - MOST} more."
        found[-1] = found[-1]._replace(caption=found[-1].caption + more)
    return found


def _stress_picture(found: RollerVolumes, scene: dict[str, Any]) -> Picture:
    model = build_roller(ResolvedScene(scene))
    contact = RollingContact(found.along_x, found.along_y, found.angle, found.peak_pressure, found.approach, found.load)
    a = max(found.along_x, found.along_y)
    side: FloatArray = np.linspace(-2.0, 2.0, CELLS, dtype=np.float64) * a
    down: FloatArray = np.linspace(1e-3, 3.0, CELLS, dtype=np.float64) * a
    # Two planes: below the surface, and through the axis along rolling.
    planes: tuple[Plane, ...] = (
        (f"z = {DEPTH} a", side, side, "y, mm", lambda u, v: (u, v, np.full_like(u, DEPTH * a))),
        ("y = 0", side, down, "z, mm", lambda u, v: (u, np.zeros_like(u), v)),
    )
    figure, axes = new_figure(4.0, 2, 3, margins=ROOM)
    for row, (name, across, along, label, place) in enumerate(planes):
        u, v = (part.ravel() for part in np.meshgrid(across, along))
        points = np.ascontiguousarray(np.stack(place(u, v), axis=1))
        stress, bent = (
            _stresses(contact, model, points),
            _stresses(contact, model, points, found.time, with_bending=True),
        )
        limits = np.array([found.normal_limit] * 3 + [found.shear_limit] * 3)
        over = components_above(stress, bent, limits)
        maps = ((stress[:, 2] * 1e-6, "σ_zz, MPa"), (stress[:, 4] * 1e-6, "σ_xz, MPa"), (over, OVER))
        for (values, title), ax in zip(maps, axes[3 * row : 3 * row + 3], strict=True):
            size = float(np.abs(values).max()) or 1.0
            tones: dict[str, Any] = {"cmap": MAP, "vmin": -size, "vmax": size}
            if title == OVER:
                tones = {"cmap": COLOURS, "vmin": -0.5, "vmax": len(TONES) - 0.5}
            image = ax.pcolormesh(across * 1e3, along * 1e3, values.reshape(CELLS, CELLS), rasterized=True, **tones)
            ax.set_title(f"{title}, {name}")
            ax.set_xlabel("x, mm")
            ax.set_ylabel(label)
            ax.set_aspect("equal")
            ax.locator_params(axis="x", nbins=3)
            if row == 1:
                ax.invert_yaxis()
            bar = figure.colorbar(image, ax=ax, shrink=0.7)
            if title == OVER:
                bar.set_ticks(range(len(TONES)), labels=TONES)
    largest = _largest_shear(contact, model, a)
    caption = (
        f"At {found.time:.4g} s: p₀ = {found.peak_pressure * 1e-6:.5g} MPa, largest |σ_xz| in the plane y = 0 {largest * 1e-6:.4g} "
        f"MPa; limits {found.normal_limit * 1e-6:.4g} MPa (normal) and {found.shear_limit * 1e-6:.4g} MPa (shear), dangerous "
        f"volume {found.volume[-1] * 1e9:.4g} mm³, {100.0 * found.volume[-1] / found.working_volume:.4g} % of the working volume "
        f"(contact and traction, without bending)."
    )
    if model.bending is not None and len(found.with_bending):
        caption += (
            f" The bending of the shaft adds to σ_xx alone, another stress of the maps; with it the volume is "
            f"{found.with_bending[-1] * 1e9:.4g} mm³, {100.0 * found.with_bending[-1] / found.working_volume:.4g} %."
        )
    volume = dict(zip(Stress._fields, found.volume, strict=False))
    caption += f" Of σ_zz alone {volume['zz'] * 1e9:.4g} mm³, of σ_xz {volume['xz'] * 1e9:.4g} mm³; dark: both above their limits."
    if leaves_box(contact, model.poisson_ratio, (found.normal_limit, found.shear_limit), model.traction):
        caption += " The true volume reaches beyond the box in which it is measured; higher limits show more."
    name = f"roller-stress-{round(found.time * 1e6)}"
    return picture(name, figure, "Normal and shear stress and dangerous volume in two planes", caption)


def components_above(stress: FloatArray, bent: FloatArray, limits: FloatArray) -> FloatArray:
    """Place in `TONES` of each point [n]: which of sigma_xz and sigma_zz exceeds its limit, or one
    of the other stresses.

    stress, bent [n, 6] [Pa]: of the contact, and with the bending of the shaft; limits [6] [Pa].
    """
    above = np.abs(stress) > limits
    other = above.any(axis=1) | (np.abs(bent) > limits).any(axis=1)
    pair = above[:, 4] + 2 * above[:, 2]
    return np.where(pair > 0, pair + 1, other).astype(np.float64)


def _stresses(
    contact: RollingContact, model: RollerModel, points: FloatArray, time: float = 0.0, with_bending: bool = False
) -> FloatArray:
    """Of contact and traction, and of the shaft's bending where it is requested and the scene has
    it.
    """
    out = np.zeros((len(points), 6))
    bending = model.bending_at(time) if with_bending else None
    bench_stresses(contact, bending, *model.traction, model.poisson_ratio, points, out)
    return out


def _largest_shear(contact: RollingContact, model: RollerModel, a: float) -> float:
    """Largest |sigma_xz| in the plane y = 0 [Pa]: of a grid, then of ever smaller ones about its
    largest.
    """
    x, z, reach = 0.0, a, np.array([2.0 * a, a])
    largest = 0.0
    for _ in range(ZOOMS):
        across = x + np.linspace(-1.0, 1.0, CELLS) * reach[0]
        down = np.maximum(z + np.linspace(-1.0, 1.0, CELLS) * reach[1], 0.0)
        u, v = (part.ravel() for part in np.meshgrid(across, down))
        shear = np.abs(_stresses(contact, model, np.stack([u, np.zeros_like(u), v], axis=1))[:, 4])
        place = int(shear.argmax())
        x, z, largest, reach = float(u[place]), float(v[place]), float(shear[place]), 0.1 * reach
    return largest
