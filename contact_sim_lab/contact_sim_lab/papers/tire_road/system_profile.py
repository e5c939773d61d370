"""System *profile*: pressure, approach and load of a shape of one's own, by Sneddon's integrals for a
rigid axisymmetric tip and by the forms of a Lamé domain for an outline (Tire/Road Contact eqs 5-9).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy
from numpy.typing import NDArray

from contact_sim_lab.closed_form.axisymmetric import (
    approach_at_radius,
    load_at_radius,
    pressure,
    radius_at_load,
)
from contact_sim_lab.closed_form.axisymmetric_profile import (
    AxisymmetricError,
    SlopeProfile,
    tabulated_profile,
)
from contact_sim_lab.closed_form.lame_domain import lame_boundary
from contact_sim_lab.closed_form.lame_points import fit_points
from contact_sim_lab.closed_form.lame_pressure import (
    LamePressure,
    LamePressureError,
    ansatz_on_domain,
    equivalent_ellipse,
    lame_pressure,
)
from contact_sim_lab.papers.inputs import read_table
from contact_sim_lab.records.paper import PaperError, SystemResult, Values
from contact_sim_pkg.pressure.closed_form.lame import LameFit, lame_area

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["profile"]

Array = NDArray[numpy.float64]

FEWEST = 5  # points on the hull of an outline
LOADS = (0.1, 0.25, 0.5, 1.0)  # shares of the load
PLACES = 200
ROWS = 11  # from the centre to the border


def profile(path: Path | None, values: Values) -> SystemResult:
    """Contact of the shape in a CSV file: a tip by columns r, height, or an outline by columns x, y.

    Raises PaperError for a shape without such a contact.
    """
    assert path is not None
    table = read_table(path, ("r", "height"), ("x", "y"), fewest=3)
    try:
        return _tip(table, values) if "r" in table else _outline(table, values)
    except (AxisymmetricError, LamePressureError) as error:
        raise PaperError(f"{path}: {error}") from None


def _tip(table: dict[str, Array], values: Values) -> SystemResult:
    modulus, load = float(values["modulus"]), float(values["load"])
    shape = tabulated_profile(table["r"], table["height"])
    radii = [radius_at_load(shape, modulus, share * load) for share in LOADS]
    rows = [
        {"load_N": load_at_radius(shape, modulus, radius), "approach_m": approach_at_radius(shape, radius),
         "contact_radius_m": radius, "mean_pressure_Pa": share * load / (numpy.pi * radius**2),
         "centre_pressure_Pa": float(pressure(shape, modulus, radius, numpy.zeros(1))[0])}
        for share, radius in zip(LOADS, radii, strict=True)
    ]  # fmt: skip
    note = "Sneddon's integrals for a rigid tip in an elastic half-space; between the points of the profile cubic polynomials"
    course = [
        {"load_N": share * load, "r_m": float(r), "pressure_Pa": float(p)}
        for share, radius in zip(LOADS, radii, strict=True)
        for r, p in _over(radius, partial(pressure, shape, modulus, radius))
    ]
    return SystemResult(rows, lambda canvas: _draw_tip(canvas, table, shape, modulus, radii), note, course=course)


def _over(border: float, pressures: Callable[[Array], Array]) -> Iterator[tuple[float, float]]:
    """Places from the centre to the border [m], and the pressures [Pa] there."""
    places: Array = border * numpy.linspace(0.0, 1.0, ROWS, dtype=numpy.float64)
    return zip(places, pressures(places), strict=True)


def _draw_tip(canvas: Canvas, table: dict[str, Array], shape: SlopeProfile, modulus: float, radii: list[float]) -> None:
    left, right = canvas.subplots(1, 2)
    left.plot(table["r"] * 1e3, table["height"] * 1e3, color="#333333", marker="o", markersize=3)
    left.set_xlabel("r, mm")
    left.set_ylabel("height of the tip, mm")
    for share, radius in zip(LOADS, radii, strict=True):
        # The centre of a pointed tip has no finite pressure.
        r: Array = radius * numpy.linspace(1e-3, 1.0, PLACES, dtype=numpy.float64)
        right.plot(r * 1e3, pressure(shape, modulus, radius, r) * 1e-3, label=f"{share:g} of the load", alpha=0.4 + 0.6 * share,
                   color="#136f96")  # fmt: skip
        left.axvline(radius * 1e3, color="#136f96", alpha=0.4 + 0.6 * share, linewidth=0.8)
    right.set_xlabel("r, mm")
    right.set_ylabel("pressure, kPa")
    right.legend()


def _outline(table: dict[str, Array], values: Values) -> SystemResult:
    modulus, load = float(values["modulus"]), float(values["load"])
    fit = fit_points(numpy.stack([table["x"], table["y"]], axis=1))
    if not fit.fitted:
        raise LamePressureError(
            f"{len(table['x'])} points, fewer than {FEWEST} of them around the contact, fix no Lamé curve"
        )
    ansatz = ansatz_on_domain(fit.a, fit.b, fit.exponent, modulus, load)
    ellipse = equivalent_ellipse(fit.a, fit.b, fit.exponent, modulus, load)
    rows = [_row("Lamé ansatz p₀ √(1 − ρⁿ)", ansatz), _row("equivalent ellipse of Hertz", ellipse)]
    note = (
        f"Lamé curve of the outline: a {fit.a:.6g} m, b {fit.b:.6g} m, n {fit.exponent:.4g}, area "
        f"{lame_area(fit.a, fit.b, fit.exponent):.6g} m², rms deviation {fit.deviation:.2g} of the radius. For n above 2 the "
        "largest pressure lies near the edge, the ansatz is up to 60 % high in the centre and 15 % low in the approach"
    )
    course = [
        {"form": row["form"], "x_m": float(x), "pressure_Pa": float(p)}
        for row, contact in zip(rows, (ansatz, ellipse), strict=True)
        for x, p in _over(contact.a, partial(_along, contact))
    ]
    return SystemResult(rows, lambda canvas: _draw_outline(canvas, table, fit, (ansatz, ellipse)), note, course=course)


def _along(contact: LamePressure, x: Array) -> Array:
    """Pressure [Pa] along x through the centre."""
    found: Array = lame_pressure(contact, x, numpy.zeros(1))
    return found


def _row(name: str, contact: LamePressure) -> dict[str, float | str]:
    return {
        "form": name, "a_m": contact.a, "b_m": contact.b, "n": contact.exponent, "centre_pressure_Pa": contact.peak_pressure,
        "approach_m": contact.approach,
    }  # fmt: skip


def _draw_outline(
    canvas: Canvas, table: dict[str, Array], fit: LameFit, contacts: tuple[LamePressure, LamePressure]
) -> None:
    left, right = canvas.subplots(1, 2)
    x, y = lame_boundary(fit.a, fit.b, fit.exponent, 4 * PLACES)
    left.plot(table["x"] * 1e3, table["y"] * 1e3, color="#333333", linestyle="none", marker="o", markersize=3)
    left.plot((fit.centre_x + x) * 1e3, (fit.centre_y + y) * 1e3, color="#136f96", label=f"Lamé, n {fit.exponent:.3g}")
    left.set_aspect("equal")
    left.set_xlabel("x, mm")
    left.set_ylabel("y, mm")
    left.legend()
    for contact, colour, name in zip(contacts, ("#136f96", "#e08a2e"), ("Lamé ansatz", "ellipse"), strict=True):
        along: Array = contact.a * numpy.linspace(-1.0, 1.0, PLACES, dtype=numpy.float64)
        right.plot(along * 1e3, lame_pressure(contact, along, numpy.zeros(1)) * 1e-3, color=colour, label=name)
    right.set_xlabel("x from the centre, mm")
    right.set_ylabel("pressure, kPa")
    right.legend()
