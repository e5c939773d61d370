"""Sentences about parameters that are not identified."""

from __future__ import annotations

import numpy

from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.problem import AXES, PAIRS

__all__ = ["hidden_by_noise", "parameter_names", "unobservable"]

PART = 1e-6  # a component of a direction below this is none
FLAT = 0.02  # an eigenvalue below this part of the largest is zero: noise turns the directions a little
NO_TRACE = "the known wrench leaves no trace in the motion that is large against the noise"
WRONG_WAY = "the body moves against the known wrench"
ALIKE = 1e-3  # of 1 - |cos|: two directions closer than that are one


def parameter_names(spatial: bool, with_mass: bool) -> list[str]:
    """Names of the parameters in their order."""
    inertia = [f"I{AXES[row]}{AXES[col]}/m" for row, col in PAIRS] if spatial else ["J/m"]
    return [*inertia, *(["1/m"] if with_mass else [])]


def unobservable(
    missing: Array, parameters: Array, scale: Array, spatial: bool, with_mass: bool, reason: str = ""
) -> list[str]:
    """One sentence for each thing that is not identified.

    Args:
        missing: orthonormal directions in parameters over `scale`, [k, p].
        parameters: the estimate, [p].
        scale: size of each parameter, [p].
        spatial: six inertia parameters, else one.
        with_mass: 1/m is the last parameter.
        reason: why the mass is not identified, where more is known of it than that.
    """
    found = [] if with_mass else [_no_wrench()]
    if not len(missing):
        return found
    inertia_count = 6 if spatial else 1
    mass = numpy.zeros(missing.shape[1])
    if with_mass:
        mass[-1] = 1.0
        rest, only = _without(missing, mass)
        if only:
            found.append(f"mass is not identifiable: {reason or NO_TRACE}")
            missing = rest
    if with_mass and len(missing) and abs(missing[:, -1]).max() > PART:
        return [*found, *_mixed(missing, parameters, scale, spatial, reason)]
    inertia = missing[:, :inertia_count] * scale[:inertia_count]
    return [*found, *(_inertia_sentences(inertia, parameters[:inertia_count]) if len(inertia) else [])] if spatial else [
        *found,
        *(["the moment of inertia is not identifiable: no impact changed the spin by a moment about the centre of mass"]
          if len(missing) else []),
    ]  # fmt: skip


def hidden_by_noise(names: list[str], *, wrong_way: bool) -> list[str]:
    """One sentence for each parameter that the equations identify, but not above their noise.

    ``wrong_way``: 1/m is below zero by more than that.
    """
    return [
        f"mass is not identifiable: {WRONG_WAY if wrong_way else NO_TRACE}"
        if name == "1/m"
        else f"{name} is not identifiable: noise could have made up its value"
        for name in names
    ]


def _no_wrench() -> str:
    return (
        "mass is not identifiable without an external force: only I0/m and impulses over m follow from the motion, "
        "since every equation can be divided by m"
    )


def _without(missing: Array, direction: Array) -> tuple[Array, bool]:
    """The directions without a given one, and whether it lay among them."""
    inside = missing.T @ (missing @ direction)
    if numpy.linalg.norm(inside - direction) > PART:
        return missing, False
    rest = missing - numpy.outer(missing @ direction, direction)
    _, values, right = numpy.linalg.svd(rest, full_matrices=False)
    return right[values > 0.5], True


def _mixed(missing: Array, parameters: Array, scale: Array, spatial: bool, reason: str) -> list[str]:
    """Directions in which mass and inertia move together."""
    ray = parameters / scale
    inside = missing.T @ (missing @ ray)
    if len(missing) == 1 and numpy.linalg.norm(inside - ray) < 1e-3 * numpy.linalg.norm(ray):
        return [
            "mass is not identifiable: the torque identifies I0 = m (I0/m) alone, and neither a force nor an impact the mass"
        ]
    names = parameter_names(spatial, with_mass=True)
    why = f"; {reason}" if reason else ""
    return [
        f"mass and inertia cannot be separated: {_combination(line, names)} is free (one equation for two unknowns{why})"
        for line in _fewest(missing)
    ]


def _fewest(missing: Array) -> Array:
    """Other directions of the same space, each with a parameter of its own and as few others as
    that leaves: Gauss and Jordan.
    """
    rows = missing.copy()
    for place in range(len(rows)):
        left = abs(rows[place:])  # 0 in the columns of earlier ones
        row, column = divmod(int(left.argmax()), left.shape[1])
        rows[[place, place + row]] = rows[[place + row, place]]
        rows[place] /= rows[place, column]
        others = numpy.arange(len(rows)) != place
        rows[others] -= numpy.outer(rows[others, column], rows[place])
        rows[others, column], rows[place, column] = 0.0, 1.0
    return rows


def _inertia_sentences(missing: Array, inertia: Array) -> list[str]:
    """Sentences for directions [k, 6] in the elements of I0/m."""
    matrices = [_matrix(line) for line in missing]
    if len(matrices) == 6:
        return ["I0/m is not identifiable: no impact changed the spin by a moment about the centre of mass"]
    if len(matrices) == 1:
        return [_single(matrices[0], _matrix(inertia))]
    stacked = numpy.concatenate(matrices)
    _, values, right = numpy.linalg.svd(stacked)
    known = right[values < FLAT * values.max()]
    if len(known) == 1 and len(matrices) == 3:
        axis = _axis(known[0])
        return [
            f"of I0/m only the column of the body axis {axis}, about which the spin changed, is identifiable; the rest is not"
        ]
    names = parameter_names(True, False)
    return [f"not identifiable: {_combination(line, names)}" for line in _fewest(missing)]


def _single(matrix: Array, inertia: Array) -> str:
    values, vectors = numpy.linalg.eigh(matrix)
    largest = int(abs(values).argmax())
    others = numpy.delete(values, largest)
    if abs(others).max() < FLAT * abs(values[largest]):
        axis = _axis(vectors[:, largest])
        return (
            f"the moment of inertia about the body axis {axis} is not identifiable: no impact turned the body about it"
        )
    ray = inertia / numpy.linalg.norm(inertia)
    if abs(abs(numpy.sum(ray * matrix)) / numpy.linalg.norm(matrix) - 1.0) < ALIKE:
        return (
            "the size of I0/m is not identifiable: free tumbling identifies only the ratios of the moments of inertia"
        )
    names = parameter_names(True, False)
    line = numpy.array([matrix[row, col] for row, col in PAIRS])
    return f"not identifiable: {_combination(line / numpy.linalg.norm(line), names)}"


def _matrix(line: Array) -> Array:
    matrix = numpy.zeros((3, 3))
    for value, (row, col) in zip(line, PAIRS, strict=True):
        matrix[row, col] = matrix[col, row] = value
    return matrix


def _axis(vector: Array) -> str:
    """A body axis by name where it is one, else by components."""
    vector = vector * numpy.sign(vector[abs(vector).argmax()])
    if abs(vector).max() > 1.0 - 1e-9:
        return AXES[int(abs(vector).argmax())]
    return "(" + ", ".join(f"{value:.4g}" for value in numpy.where(abs(vector) < PART, 0.0, vector)) + ")"


def _combination(line: Array, names: list[str]) -> str:
    kept = [(value, name) for value, name in zip(line, names, strict=True) if abs(value) > PART * abs(line).max()]
    if len(kept) == 1:
        return kept[0][1]
    parts = [f"{value:+.3g} {name}" for value, name in kept]
    return " ".join(parts).removeprefix("+")
