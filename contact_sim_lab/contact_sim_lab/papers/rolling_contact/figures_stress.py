"""Figures 11 to 14: stress and dangerous volumes in two planes at four instants."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy
import scipy.optimize
from numpy.typing import NDArray

from contact_sim_lab.papers.rolling_contact.figures_ellipse import SCENE
from contact_sim_lab.papers.runs import series_of
from contact_sim_lab.records.paper import Drawn, Figure, Number, Parameter, Values
from contact_sim_lab.twins.subsurface import under_ellipse, worst_under_ellipse
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact
from contact_sim_pkg.rigs.roller.theory.stress import bench_stresses
from contact_sim_pkg.rigs.roller.theory.volumes import dangerous_volumes

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["STRESS_FIGURES"]

Points = NDArray[numpy.float64]

POISSON = 0.3
CELLS = 81
COUNTED = 40  # points along each side of a quarter of the box
COUNTED_UNION = 24  # the same for the union, which takes all six components
FINE = (96, 120, 24)  # half as large in each direction as those of the scene
SHEAR_OVER_PEAK = {2.0: 0.203}  # largest |sigma_xz| over p0 in the plane y = 0
# Twelve places over the larger semi-axis: six at z = 0.3 a, six in the plane y = 0.
PLACES = numpy.array([
    (0.1, 0.2, 0.3), (-0.5, 0.3, 0.3), (0.7, -0.6, 0.3), (0.9, 0.1, 0.3), (-0.3, -1.1, 0.3), (0.0, 0.0, 0.3),
    (0.6, 0.0, 0.25), (0.8, 0.0, 0.35), (-0.9, 0.0, 0.5), (1.2, 0.0, 0.4), (0.3, 0.0, 0.8), (-0.5, 0.0, 1.5),
])  # fmt: skip


def _stresses(contact: RollingContact, points: Points) -> Points:
    """zz and xz [2, n] [Pa] at points [n, 3] [m]."""
    out = numpy.zeros((len(points), 6))
    bench_stresses(contact, None, 0.0, 0.0, POISSON, numpy.ascontiguousarray(points, dtype=float), out)
    return out[:, [2, 4]].T


def _largest_shear(contact: RollingContact, a: float) -> float:
    """Largest |sigma_xz| over p0 in the plane y = 0; a: larger semi-axis [m]."""

    def less(place: Points) -> float:
        return -float(abs(_stresses(contact, numpy.array([[place[0] * a, 0.0, abs(place[1]) * a]]))[1, 0]))

    scale = contact.peak_pressure
    found = scipy.optimize.minimize(
        lambda place: less(place) / scale, [0.8, 0.3], method="Nelder-Mead", options={"xatol": 1e-7, "fatol": 1e-9}
    )
    return -float(found.fun)


def _contact_at(time: float) -> tuple[RollingContact, dict[str, Any], Points]:
    """Contact at an instant [s], the message's scalars, and its seven volumes [m^3]."""
    found = series_of("roller/volumes", SCENE)
    rows = numpy.flatnonzero(found["time_in_message"] == time)
    scalars = {name: found[name][rows[0]] for name in found}
    names = ("along_x", "along_y", "angle", "peak_pressure", "approach", "load")
    return RollingContact(*(float(scalars[name]) for name in names)), scalars, found["volume"][rows]


class Counted(NamedTuple):
    """A dangerous volume by counting."""

    volume: float  # [m^3]
    points: int

    @property
    def tolerance(self) -> float:
        """1 %, or what so few points resolve: three times N^(-2/3), the share of a point in the area round N of them."""
        return float(max(1e-2, 3.0 * max(self.points, 1) ** (-2.0 / 3.0)))


def _counted(contact: RollingContact, limits: tuple[float, float]) -> tuple[Counted, Counted]:
    """V_zz and V_xz [m^3] of the box: points of a quarter of it, by the twin's quadrature.

    Above 0.06 a, where the quadrature fails, zz is that of this depth and xz falls in proportion to the depth.
    """
    a, shallow = max(contact.along_x, contact.along_y), 0.06
    places = (numpy.arange(COUNTED) + 0.5) / COUNTED
    x, y, z = (
        part.ravel()
        for part in numpy.meshgrid(
            2.0 * contact.along_x * places, 2.0 * contact.along_y * places, 3.0 * a * places**1.5
        )
    )
    below = numpy.maximum(z, shallow * a)
    zz, xz = numpy.abs(under_ellipse((contact.along_x, contact.along_y), numpy.stack([x, y, below], axis=1)))
    cell = 16.0 * contact.along_x * contact.along_y / COUNTED**2
    share = cell * numpy.broadcast_to(4.5 * a / COUNTED * places**0.5, (COUNTED**2, COUNTED)).ravel()
    over = zz > limits[0] / contact.peak_pressure, xz * z / below > limits[1] / contact.peak_pressure
    zz_part, xz_part = (Counted(float(share[each].sum()), int(each.sum())) for each in over)
    return zz_part, xz_part


def _counted_union(contact: RollingContact, limits: tuple[float, float]) -> Counted:
    """V_T [m^3] of the box, by the twin's quadrature of all components."""
    a, b = max(contact.along_x, contact.along_y), min(contact.along_x, contact.along_y)
    worst, share = worst_under_ellipse(b / a, POISSON, limits, COUNTED_UNION)
    over = worst * contact.peak_pressure > 1.0
    return Counted(48.0 * a * a * b * float(share[over].sum()), int(over.sum()))


def _compute(time: float, values: Values) -> Drawn:
    contact, recorded, volumes = _contact_at(time)
    limits = values["normal_limit"], values["shear_limit"]
    peak, a = contact.peak_pressure, max(contact.along_x, contact.along_y)
    # The half-space twin takes axes along x and y: the yaw of this scene is zero.
    twin = under_ellipse((contact.along_x, contact.along_y), PLACES * a)
    error = numpy.abs(_stresses(contact, PLACES * a) / peak - twin)
    own = (recorded["normal_limit"], recorded["shear_limit"]) == limits
    # Limits of one's own may leave a volume that the scene's cells do not resolve.
    coarse = volumes if own else dangerous_volumes(contact, POISSON, limits, FINE)
    counted = (*_counted(contact, limits), _counted_union(contact, limits))
    quadrature, points = (
        "Boussinesq's point forces over the ellipse, 40 × 80 points",
        "that quadrature at 40³ points of a quarter of the box",
    )
    largest = _largest_shear(contact, a)
    numbers = [
        Number("σ_zz(0, 0, 0) over p₀", "", float(_stresses(contact, numpy.array([[0.0, 0.0, 0.0]]))[0, 0]) / peak, -1.0, 1e-6,
               "boundary condition of the surface"),
        Number("largest error of σ_zz over p₀ at 12 places", "", float(error[0].max()), 0.0, 1e-3, quadrature),
        Number("largest error of σ_xz over p₀ at 12 places", "", float(error[1].max()), 0.0, 1e-3, quadrature),
        Number("V_zz", "m³", float(coarse[2]), counted[0].volume, counted[0].tolerance, points, relative=True),
        Number("V_xz", "m³", float(coarse[4]), counted[1].volume, counted[1].tolerance, points, relative=True),
        Number("V_T", "m³", float(coarse[6]), counted[2].volume, counted[2].tolerance,
               f"that quadrature of all components at {COUNTED_UNION}³ points", relative=True),
    ]  # fmt: skip
    if time in SHEAR_OVER_PEAK:
        origin = "worked out for this ellipse (the print says 2e7 Pa and 0.3 p₀)"
        numbers.insert(1, Number("largest |σ_xz| over p₀, y = 0", "", largest, SHEAR_OVER_PEAK[time], 5e-4, origin))
        numbers.insert(
            2, Number("largest |σ_xz|, y = 0", "Pa", largest * peak, 2e7, 5e5, "text of section 5, one digit")
        )
    elif time == 0.0:
        numbers.insert(1, Number("p₀", "Pa", peak, 1.4e8, 5e6, "text of section 5, two digits"))
    return Drawn(numbers, partial(_draw, contact, a, limits), (9.0, 5.4))


def _planes(a: float) -> list[tuple[str, str, Points, Points, Callable[[Points, Points], Points]]]:
    side: Points = numpy.linspace(-2.0, 2.0, CELLS, dtype=float) * a
    down: Points = numpy.linspace(1e-3, 2.0, CELLS, dtype=float) * a
    return [
        ("z = 0.3 a", "y, mm", side, side, lambda u, v: numpy.stack([u, v, numpy.full_like(u, 0.3 * a)], axis=1)),
        ("y = 0", "z, mm", side, down, lambda u, v: numpy.stack([u, numpy.zeros_like(u), v], axis=1)),
    ]


def _draw(contact: RollingContact, a: float, limits: tuple[float, float], canvas: Canvas) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    axes = canvas.subplots(2, 3)
    colours = ["white", "#9ecae1", "#fdae6b", "#6a51a3"]
    names = ["", "|σ_zz| beyond its limit", "|σ_xz| beyond its limit", "both"]
    for row, (name, label, across, along, place) in enumerate(_planes(a)):
        u, v = (part.ravel() for part in numpy.meshgrid(across, along))
        stress = _stresses(contact, place(u, v))
        over = (numpy.abs(stress) > numpy.array(limits)[:, None]) * numpy.array([[1], [2]])
        x, y = across * 1e3, along * 1e3
        for ax, values, title in zip(axes[row], stress * 1e-6, ("σ_zz, 10⁶ Pa", "σ_xz, 10⁶ Pa"), strict=False):
            size = float(numpy.abs(values).max())
            image = ax.pcolormesh(
                x, y, values.reshape(CELLS, CELLS), cmap="RdBu_r", vmin=-size, vmax=size, rasterized=True
            )
            canvas.colorbar(image, ax=ax, shrink=0.8)
            ax.set_title(f"{title}, {name}")
        axes[row][2].pcolormesh(
            x,
            y,
            over.sum(axis=0).reshape(CELLS, CELLS),
            cmap=ListedColormap(colours),
            vmin=-0.5,
            vmax=3.5,
            rasterized=True,
        )
        axes[row][2].set_title(f"dangerous, {name}")
        for ax in axes[row]:
            ax.set(xlabel="x, mm", ylabel=label, aspect="equal")
            ax.grid(visible=False)
            if row == 1:
                ax.invert_yaxis()
    handles = [Patch(color=colour, label=text) for colour, text in zip(colours[1:], names[1:], strict=True)]
    canvas.legend(handles=handles, loc="outside lower center", ncols=3)


LIMITS = (
    Parameter("normal_limit", "Pa", 4.0e7, above=0.0, help="limit of normal stress"),
    Parameter("shear_limit", "Pa", 1.0e7, above=0.0, help="limit of shear stress"),
)
STRESS_FIGURES = tuple(
    Figure(
        str(11 + k), f"σ_zz, σ_xz and dangerous volumes at t = {time:g} s, in the planes z = 0.3 a and y = 0",
        (
            f"scene {SCENE}", "contact_sim_pkg.rigs.roller.theory.stress:bench_stresses",
            "contact_sim_pkg.rigs.roller.theory.volumes:dangerous_volumes",
        ),
        "stress at 12 places by quadrature, 1e-3 p₀; volumes by that quadrature, 1 %, more where few points are dangerous"
        + ("; largest |σ_xz| 0.203 p₀" if time in SHEAR_OVER_PEAK else ""),
        partial(_compute, time), parameters=LIMITS,
    )
    for k, time in enumerate((0.0, 2.0, 4.0, 6.0))
)  # fmt: skip
