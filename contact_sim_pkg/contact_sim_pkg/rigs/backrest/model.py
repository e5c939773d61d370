"""Resolved scene of the backrest rig -> parameters, start state, mat and timing."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_energy, elastic_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import Contact, Friction
from contact_sim_pkg.pressure.mat import paraboloid_gap
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.fields import given
from contact_sim_pkg.rigs.backrest import schema
from contact_sim_pkg.rigs.backrest.cushion import build_back_cushion
from contact_sim_pkg.rigs.backrest.entries import find_point
from contact_sim_pkg.rigs.backrest.motion import memory_offset, state_count
from contact_sim_pkg.rigs.backrest.parameters import Backrest, ContactSearch
from contact_sim_pkg.rigs.backrest.shell import ShallowShell, ShellModes, crown_gap, shell_modes
from contact_sim_pkg.run.contact_laws import Cushion, elastic_law, friction, hysteresis, normal_loss
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.timing import Timing, make_timing

REFERENCE_SURFACE = 0.02  # [m^2] of the back to which the contact law belongs: a point has its part of it
USUAL_FREQUENCY = 2.0 * math.pi * 5.0  # [rad/s] velocities over displacements, for the scale of the errors
USUAL_SIZE = 1e-3  # [m] of the motion where there is no preload
USUAL_SPEED = 0.5  # [m/s] of a slap
STIFF = 0.1  # of a contact less deep than the usual size: its swings are many, and their errors add up
NEWTON_STEPS = 100


class Mat(NamedTuple):
    """Cells of the pressure map, in the contact's frame: x up, y to the right of the occupant, the crown at the origin."""

    cell_x: float  # [m]
    cell_y: float  # [m]
    x: Vector  # [rows] [m] of the cells' centres
    y: Vector  # [cols] [m]
    gap: NDArray[numpy.float64]  # [rows, cols] [m]
    by_points: bool  # each cell is that of one contact point
    bent: NDArray[numpy.float64] | None = (
        None  # [cells, modes] shapes of a shell with a moving point: the gap then follows them
    )


@dataclass(frozen=True)
class BackrestModel:
    """Everything that the simulation of one backrest scene needs."""

    rig: Backrest
    timing: Timing
    scale: Vector  # [states] error allowed per step
    start: Vector  # [states] at rest under the preload
    coordinates: tuple[str, ...]  # names of the forward coordinates of ``bench/motion``
    motion: NDArray[numpy.float64]  # [coordinates, modes] how they follow from the modes, forward positive
    mat: Mat
    cushion: Cushion | None  # whose table is the law and has the map
    point_x: Vector  # [points] [m]
    point_y: Vector  # [points] [m]


class _ModalBack(NamedTuple):
    """The back in modal form, as one mass or as a shell."""

    mass: Vector
    stiffness: Vector
    damping: Vector
    at_preload: Vector  # [modes] shapes where the preload acts
    at_shaking: Vector  # [modes] shapes where the exciting force acts
    shapes: NDArray[numpy.float64]  # [points, modes]
    slopes: NDArray[numpy.float64]  # [points, modes]
    gaps: Vector  # [points]
    shares: Vector  # [points]
    point_x: Vector
    point_y: Vector
    names: tuple[str, ...]
    motion: NDArray[numpy.float64]


def build_backrest(scene: ResolvedScene) -> BackrestModel:
    """Parameters of a resolved scene. Raises ShellError for a shell that is not possible,
    SceneError for too deep a rest.
    """
    backrest, shell = scene.section(schema.BackrestSection), scene.effect("backrest", schema.ShellModesSection)
    mat = mat_of(backrest, shell)
    form = _one_mass(backrest) if shell is None else _shell(backrest, shell, mat)
    search = None
    if shell is not None and scene.effect("backrest", schema.ContactSearchSection) is not None:
        search = _search(backrest, shell, mat)
        mat, form = mat._replace(by_points=False, bent=form.shapes), _with_one_point(form)
    preload, sliding = given(backrest.preload), backrest.sliding
    # a shell is pressed by the weight of what is shaken
    shaken = given(backrest.mass) if shell is None else preload / GRAVITY
    cushion = build_back_cushion(scene, preload)
    modal = [form.mass, form.stiffness, form.damping, preload * form.at_preload, shaken * form.at_shaking]
    rig = Backrest(
        numpy.stack(modal), numpy.stack([form.shapes, form.slopes]), numpy.stack([form.gaps, form.shares]),
        _contact(scene, cushion, shaken, len(form.mass), len(form.gaps)), sliding.amplitude, 2.0 * math.pi * sliding.frequency,
        search,
    )  # fmt: skip
    start = resting_state(rig)
    approach = float((rig.shapes @ start[: len(form.mass)] - rig.gaps).max())
    _refuse_deep(backrest.back, preload, approach)
    scale = _scale(rig, approach, preload, given(scene.integrator.relative_tolerance))
    timing = make_timing(scene, True)
    return BackrestModel(
        rig=rig,
        timing=timing,
        scale=scale,
        start=start,
        coordinates=form.names,
        motion=form.motion,
        mat=mat,
        cushion=cushion,
        point_x=form.point_x,
        point_y=form.point_y,
    )


def _refuse_deep(back: schema.Back, preload: float, approach: float) -> None:
    """A preload that presses the back in deeper than its smaller radius: no contact law of a curved
    body reaches there.
    """
    radius = min(back.radius_up, back.radius_across)
    if approach > radius:
        sentence = (
            f"{preload:g} N press the back {approach:.3g} m into the seat back, deeper than its smaller radius of {radius:g} m; "
            "lower the preload or make the contact stiffer"
        )
        raise SceneError([Fault("scene", 0, 0, "backrest.preload", sentence)])


def _contact(scene: ResolvedScene, cushion: Cushion | None, mass: float, modes: int, points: int) -> Contact:
    """Laws of the contact; ``mass`` [kg] is what a free impact moves."""
    law = elastic_law(scene, "backrest") if cushion is None else cushion.law
    memory = hysteresis(scene, "backrest", memory_offset(modes, points))
    return Contact(law, normal_loss(scene, "backrest", law, mass), friction(scene, "backrest"), memory)


def mat_of(backrest: schema.BackrestSection, shell: schema.ShellModesSection | None = None) -> Mat:
    """Cells of the pressure map; those of the contact points of a shell."""
    back, cells = backrest.back, backrest.mat
    rows, cols = (cells.rows, cells.cols) if shell is None else (shell.points_up, shell.points_across)
    cell_x, cell_y = back.height / rows, back.width / cols
    x, y = (
        (numpy.arange(n, dtype=numpy.float64) - 0.5 * (n - 1)) * cell for n, cell in ((rows, cell_x), (cols, cell_y))
    )
    gap = paraboloid_gap(x, y, back.radius_up, back.radius_across)
    return Mat(cell_x, cell_y, x, y, gap, shell is not None)


def _one_mass(backrest: schema.BackrestSection) -> _ModalBack:
    one, none = numpy.ones(1), numpy.zeros(1)
    mass = numpy.array([given(backrest.mass)])
    return _ModalBack(
        mass=mass,
        stiffness=none,
        damping=none.copy(),
        at_preload=one,
        at_shaking=one.copy(),
        shapes=numpy.ones((1, 1)),
        slopes=numpy.zeros((1, 1)),
        gaps=none.copy(),
        shares=one.copy(),
        point_x=none.copy(),
        point_y=none.copy(),
        names=("occupant_x",),
        motion=-numpy.ones((1, 1)),
    )


def shallow_shell(backrest: schema.BackrestSection, effect: schema.ShellModesSection) -> ShallowShell:
    back = backrest.back
    return ShallowShell(
        length_1=back.width,
        length_2=back.height,
        thickness=effect.thickness,
        young=effect.young_modulus,
        poisson=effect.poisson_ratio,
        density=effect.density,
        radius_1=back.radius_across,
        radius_2=back.radius_up,
    )


def _shell(backrest: schema.BackrestSection, effect: schema.ShellModesSection, mat: Mat) -> _ModalBack:
    shell = shallow_shell(backrest, effect)
    width, height = shell.length_1, shell.length_2
    point_x, point_y = (grid.ravel() for grid in numpy.meshgrid(mat.x, mat.y, indexing="ij"))
    places = numpy.column_stack([point_y + 0.5 * width, point_x + 0.5 * height])
    middle = (0.5 * width, 0.5 * height)
    exciter = (effect.shaken_across * width, effect.shaken_up * height)
    # Modal shapes at the cells of the mat, in the middle (preload) and at the exciter.
    modes = shell_modes(shell, effect.modes, places)
    at_middle, at_exciter = shell_modes(shell, effect.modes, numpy.array([middle, exciter])).shapes
    # Each cell carries the law of the whole contact times its share of the reference surface.
    share = mat.cell_x * mat.cell_y / REFERENCE_SURFACE
    mass = numpy.full(len(modes.frequencies), modes.modal_mass)
    return _ModalBack(
        mass=mass,
        stiffness=mass * modes.frequencies**2,
        damping=2.0 * effect.damping_ratio * mass * modes.frequencies,
        at_preload=at_middle,
        at_shaking=at_exciter,
        shapes=modes.shapes,
        slopes=0.5 * shell.thickness * modes.slopes_y,
        gaps=crown_gap(shell, places),
        shares=numpy.full(len(places), share),
        point_x=point_x,
        point_y=point_y,
        names=("crown_x", *_mode_names(modes)),
        motion=-numpy.vstack([at_middle, numpy.eye(len(mass))]),
    )


def _search(backrest: schema.BackrestSection, effect: schema.ShellModesSection, mat: Mat) -> ContactSearch:
    """Search over the cells' centres and the sides."""
    shell = shallow_shell(backrest, effect)
    width, height = shell.length_1, shell.length_2
    # Candidates: the centres of the cells, and the edges of the shell.
    up, across = (
        numpy.clip(numpy.concatenate([[0.0], middle + 0.5 * side, [side]]), 0.0, side)
        for middle, side in ((mat.x, height), (mat.y, width))
    )
    places = numpy.stack(numpy.meshgrid(up, across, indexing="ij")[::-1], axis=-1).reshape(-1, 2)
    modes = shell_modes(shell, effect.modes, places)
    # A rim below every depth, so that a crest on the edge is found as one inside.
    rim = numpy.full((len(up) + 2, len(across) + 2), -numpy.inf)
    return ContactSearch(
        length_1=width,
        length_2=height,
        curvature_1=1.0 / shell.radius_1,
        curvature_2=1.0 / shell.radius_2,
        lever=0.5 * shell.thickness,
        side=math.isqrt(len(modes.frequencies)),
        places=places,
        candidates=modes.shapes,
        gaps=crown_gap(shell, places),
        depths=rim,
    )


def _with_one_point(form: _ModalBack) -> _ModalBack:
    """The shell with a point in its middle, which the search then moves; it carries the
    whole law.
    """
    modes, origin = len(form.mass), numpy.zeros(1)
    return form._replace(
        shapes=form.at_preload.reshape(1, modes).copy(), slopes=numpy.zeros((1, modes)), gaps=origin, shares=numpy.ones(1),
        point_x=origin, point_y=origin,
    )  # fmt: skip


def _mode_names(modes: ShellModes) -> tuple[str, ...]:
    return tuple(f"mode_{m}_{n}_x" for m, n in modes.orders)


def _spring_scale(friction: Friction | None, size: float, preload: float) -> float:
    """Deflection [m] of the friction spring: what it reaches under the preload, at most
    ``size``.
    """
    if friction is None:
        return numpy.inf
    reached = friction.coefficient_static * preload / friction.stiffness
    return min(size, reached) if reached > 0.0 else size


def _size_and_frequency(rig: Backrest, approach: float, preload: float) -> tuple[float, float]:
    """Size in [m] and frequency in [rad/s] of the motion: of a swing about the ``approach`` [m] at
    rest, or of a slap.

    A stiff contact turns a small error of place into a large one of force.
    """
    mass, size = float(rig.mass.max()), approach
    if approach <= 0.0:
        size = USUAL_SIZE
        while elastic_force(rig.contact.elastic, size) * size > mass * USUAL_SPEED**2:
            size *= 0.5
    if size >= USUAL_SIZE:
        return size, USUAL_FREQUENCY
    frequency = USUAL_SPEED / size if approach <= 0.0 else math.sqrt(preload / (size * mass))
    return STIFF * size, max(USUAL_FREQUENCY, frequency)


def _scale(rig: Backrest, approach: float, preload: float, tolerance: float) -> Vector:
    """Error allowed per step and state: displacements relative to the approach at rest, works to
    that of the preload on it.
    """
    modes, points = len(rig.mass), len(rig.gaps)
    size, frequency = _size_and_frequency(rig, approach, preload)
    position, velocity = size * tolerance, size * frequency * tolerance
    kinetic = 0.5 * float(rig.mass.max()) * (size * frequency) ** 2
    work = max(preload * size, kinetic) * tolerance
    spring = _spring_scale(rig.contact.friction, size, preload) * tolerance
    parts = [numpy.full(modes, position), numpy.full(modes, velocity), numpy.full(points, spring)]
    parts.append(numpy.full(2 * points, work))
    if rig.contact.hysteresis is not None:
        parts.append(numpy.full(points, tolerance))  # the hysteresis variable lies between -1 and 1
    return numpy.concatenate([*parts, numpy.full(2, work)])


def resting_state(rig: Backrest) -> Vector:
    """State [states] at rest under the preload: minimum of a convex energy.

    Energy: ``q K q / 2 - P q + sum_c share A d**(n+1) / (n+1)``.
    """
    modes, law = len(rig.mass), rig.contact.elastic
    q = numpy.zeros(modes)
    # A rigid back starts at the depth of its law.
    if not rig.stiffness.any():
        q[0] = approach_of_force(law, float(rig.preload[0]))
    for _ in range(NEWTON_STEPS):
        slope, curvature, energy = _energy_at(rig, q)
        if numpy.abs(slope).max() <= 1e-13 * numpy.abs(rig.preload).max():
            break
        step = numpy.linalg.solve(curvature, -slope)
        # Newton step, halved until the energy falls (Armijo).
        part = 1.0
        while part > 1e-6 and _energy_at(rig, q + part * step)[2] > energy + 1e-4 * part * float(slope @ step):
            part *= 0.5
        q = q + part * step
    state = numpy.zeros(state_count(modes, len(rig.gaps), rig.contact.hysteresis is not None))
    state[:modes] = q
    return state


def _energy_at(rig: Backrest, q: Vector) -> tuple[Vector, NDArray[numpy.float64], float]:
    """Gradient [N], Hessian [N/m] and value [J] of the energy."""
    law = rig.contact.elastic
    if rig.search is not None:
        find_point(rig, q)
    depth = numpy.maximum(rig.shapes @ q - rig.gaps, 0.0)
    force, stiffness, stored = (
        rig.shares * numpy.array([part(law, x) for x in depth])
        for part in (elastic_force, elastic_stiffness, elastic_energy)
    )
    slope = rig.stiffness * q - rig.preload + rig.shapes.T @ force
    curvature = numpy.diag(rig.stiffness) + rig.shapes.T @ (stiffness[:, None] * rig.shapes)
    energy = 0.5 * rig.stiffness @ q**2 - rig.preload @ q + stored.sum()
    return slope, curvature, float(energy)
