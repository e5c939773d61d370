"""System *axes*: the three principal moments of a body whose principal axes are known, from its impacts
(Identifiability eqs 19 to 31, corrected): one impact suffices.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.driver_seat.system_distance import rotation_about
from contact_sim_lab.records.paper import PaperError, SystemResult, Values
from contact_sim_pkg.identify.contact.coulomb import impact_equations
from contact_sim_pkg.identify.identify import Identification, Setup, identify
from contact_sim_pkg.identify.motion.geometry import arm, box
from contact_sim_pkg.identify.readers.body_states import read_body_states

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

__all__ = ["Moments", "axes", "moments_of"]

Array = NDArray[numpy.float64]

RANK = 1e-6  # of the largest singular value: directions below are not identified
SHARE = 0.1  # of such a direction above which an axis is not identified


class Moments(NamedTuple):
    """Principal moments over the mass."""

    values: Array  # [3] [m^2]
    deviations: Array  # [3] from what is left of the equations; infinite where not identified
    rank: int
    left: Array  # [impacts, 3] of the equations, over the moment of the impulse


def axes(path: Path | None, values: Values) -> SystemResult:
    """Principal moments from a bag with the motion of a box.

    Raises PaperError without an impact, BagError and IdentificationError as `bench identify`.
    """
    assert path is not None
    lengths = numpy.array(values["box"], float)
    turn = numpy.array(values["axes"], float)
    if lengths.shape != (3,) or turn.shape != (3,):
        raise PaperError("box and axes take three numbers each, as --set box=0.1,0.1,0.1")
    found = identify(read_body_states(path).states, Setup(box(lengths), gravity=float(values["gravity"])))
    equations = _equations(found, rotation_about(turn))
    if not equations:
        raise PaperError(f"{path}: no impact between two flights was found, from which the moments could follow")
    result = moments_of([matrix for matrix, _ in equations], [right for _, right in equations])
    rows = [
        {"axis": name, "I_over_m_m2": float(value) if numpy.isfinite(deviation) else None,
         "deviation_m2": float(deviation) if numpy.isfinite(deviation) else None,
         "m_over_I_1_m2": float(1.0 / value) if numpy.isfinite(deviation) and value != 0.0 else None}
        for name, value, deviation in zip("xyz", result.values, result.deviations, strict=True)
    ]  # fmt: skip
    note = f"rank {result.rank} of 3 from {len(equations)} impacts; the general search finds rank {found.rank} of {found.unknowns}"
    if result.rank < 3:
        note += "\nnot identified: axes about which no impulse turned the body, or that only turned together"
    return SystemResult(rows, lambda canvas: _draw(canvas, result), note)


def moments_of(matrices: list[Array], rights: list[Array]) -> Moments:
    """Least squares of equations [3, 3] and right sides [3] of each impact, each weighted by the size of its moment."""
    sizes = [float(numpy.linalg.norm(right)) or 1.0 for right in rights]
    matrix = numpy.concatenate([each / size for each, size in zip(matrices, sizes, strict=True)])
    right = numpy.concatenate([each / size for each, size in zip(rights, sizes, strict=True)])
    left, singular, directions = numpy.linalg.svd(matrix, full_matrices=False)
    rank = int((singular > RANK * singular[0]).sum()) if singular[0] > 0.0 else 0
    values = directions[:rank].T @ ((left.T @ right)[:rank] / singular[:rank])
    rest = right - matrix @ values
    spread = numpy.linalg.norm(directions[:rank].T / singular[:rank], axis=1)
    deviations = spread * float(numpy.sqrt(rest @ rest / max(len(rest) - rank, 1)))
    deviations[numpy.linalg.norm(directions[rank:], axis=0) > SHARE] = numpy.inf
    return Moments(values, deviations, rank, rest.reshape(-1, 3))


def _equations(found: Identification, turn: Array) -> list[tuple[Array, Array]]:
    """Equations of each impact that the identification uses, at its located instant.

    turn: columns are the principal axes, in body axes.
    """
    problem, equations = found.problem, []
    basis = numpy.einsum("ik,jk->kij", turn, turn)
    for contact, (before, after) in zip(problem.contacts, found.estimate.sides, strict=True):
        if contact.end != contact.begin:
            continue
        state, then = before.state, after.state
        reach = arm(problem.shape, problem.ground, state.rotation, contact.point)
        speeds = (state.velocity, state.angular_velocity), (then.velocity, then.angular_velocity)
        # Along the principal axes each equation holds one moment.
        matrix, right = impact_equations(basis, state.rotation, *speeds, reach)
        equations.append((turn.T @ matrix, turn.T @ right))
    return equations


def _draw(canvas: Canvas, result: Moments) -> None:
    left, right = canvas.subplots(1, 2)
    known = numpy.isfinite(result.deviations)
    left.bar(numpy.flatnonzero(known), result.values[known], yerr=result.deviations[known], color="#136f96", width=0.5)
    left.set_xticks(range(3), ["x", "y", "z"])
    left.set_xlim(-0.6, 2.6)
    left.set_xlabel("principal axis")
    left.set_ylabel("I/m, m²")
    for place, (name, colour) in enumerate(zip("xyz", ("#136f96", "#e08a2e", "#6b6b66"), strict=True)):
        right.plot(
            numpy.arange(1, len(result.left) + 1),
            result.left[:, place],
            color=colour,
            marker="o",
            markersize=4,
            label=name,
        )
    right.set_xlabel("impact")
    right.set_ylabel("left of its equation, over its moment")
    right.legend()
