"""From sampled states to inertia, impulses, and the parameters that are not identifiable."""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.contacts import ContactFinding, findings
from contact_sim_pkg.identify.contact.coulomb import along_the_cone
from contact_sim_pkg.identify.contact.noise import first_guess, limited, roundings
from contact_sim_pkg.identify.contact.slides import slides_of
from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.flight import FlightModel
from contact_sim_pkg.identify.motion.geometry import GroundPlane, Shape, flattened, gaps, plane
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.segments import (
    body_axis,
    gap_uncertainty,
    inverse_mass_guess,
    plane_of_motion,
    segments,
    tumbling_start,
    velocity_noise,
)
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise, checked, refuse_jumps
from contact_sim_pkg.identify.motion.wrench import NO_WRENCH, ExternalWrench
from contact_sim_pkg.identify.naming import hidden_by_noise, parameter_names, unobservable
from contact_sim_pkg.identify.problem import IdentificationProblem, planar_basis, spatial_basis, starting_parameters
from contact_sim_pkg.identify.search import Search
from contact_sim_pkg.identify.turning import rate_of_turn
from contact_sim_pkg.identify.warnings import HIDDEN, against_the_wrench, consistency_warnings, made_up

__all__ = ["Identification", "Parameter", "Setup", "identify"]


AXIS = 5.0  # times its deviation: how far the axis of the plane, a mean over all samples, may be wrong
SLOWEST = 0.1  # of the recorded spin: slower rotations contradict it, whatever noise and axes do
LARGEST = 1e6  # gravity, friction coefficient, noise: beyond it a number is a mistake


class Setup(NamedTuple):
    """Known quantities besides the states."""

    shape: Shape
    ground: GroundPlane = plane()
    wrench: ExternalWrench = NO_WRENCH
    gravity: float = 9.81  # [m/s^2]
    noise: SampleNoise | None = None  # None: taken from the flights
    planar: bool | None = None  # None: found from the motion
    friction: float | None = None  # known coefficient; None: unknown, a result


class Parameter(NamedTuple):
    """One parameter."""

    name: str
    unit: str
    value: float
    deviation: float  # standard deviation, same unit
    identified: bool


class Identification(NamedTuple):
    """Result of an identification."""

    parameters: list[Parameter]
    unobservable: list[str]
    warnings: list[str]  # consistency warnings
    rank: int
    unknowns: int
    contacts: list[ContactFinding]
    noise: SampleNoise
    flights: int
    axis: Array | None  # normal of the plane of motion, None in space
    converged: bool
    estimate: ParameterEstimate
    problem: IdentificationProblem


def identify(states: BodyStates, setup: Setup) -> Identification:
    """Identify inertia over mass, impulses over mass and, with a known wrench, the mass.

    Raises:
        IdentificationError: states that cannot be used, a wrench that does not cover them, no
        flight, no contact.
    """
    states = checked(states)
    _check_setup(setup)
    _check_wrench(states, setup.wrench)
    guess = setup.noise or first_guess(states)
    _check_spin(states, guess)
    refuse_jumps(states, guess, setup.gravity)
    # A planar motion has one inertia, about the normal of its plane
    axis = None if setup.planar is False else plane_of_motion(states, setup.ground, guess)
    if setup.planar and axis is None:
        raise IdentificationError("the motion is not planar: its spin changes axis, or it drifts out of the plane")
    own_axis = None if axis is None else body_axis(states, axis, guess)
    axis_error = AXIS * guess.rotation / float(numpy.sqrt(len(states.time)))
    shape = setup.shape if own_axis is None else flattened(setup.shape, own_axis, axis_error)
    rounding = roundings(states)
    speed_noise = max(setup.noise.velocity if setup.noise else velocity_noise(states), rounding.velocity)
    # Flights and contacts, the model of a flight, and where the search starts
    parts = segments(states, shape, setup.ground, setup.wrench, setup.gravity, speed_noise, guess[:2])
    basis = spatial_basis() if axis is None else planar_basis()
    model = FlightModel(basis, setup.wrench.present, setup.wrench, setup.gravity)
    lifts = gaps(shape, setup.ground, states.position, states.rotation).min(axis=1)
    inverse_mass = inverse_mass_guess(states, lifts, setup.wrench, setup.gravity, gap_uncertainty(shape, guess[:2]))
    start, scale = starting_parameters(shape, model, own_axis, inverse_mass)
    noise = limited(guess, states)
    problem = IdentificationProblem(
        states=states,
        flights=[],
        contacts=[],
        shape=shape,
        ground=setup.ground,
        model=model,
        noise=noise,
        axis=axis,
        rounding=rounding,
        friction=setup.friction,
    )
    starts = [start]
    if axis is None:
        tumbling = tumbling_start(states, parts.flights, model, noise, start)
        starts = [start] if tumbling is None else [tumbling, start]
    search = Search(problem, parts, setup.noise, starts, scale)
    return _result(search.run(), search)


def _check_setup(setup: Setup) -> None:
    if not 0.0 <= setup.gravity <= LARGEST:
        raise IdentificationError(f"gravity acts downward and is 0 to {LARGEST:g} m/s^2, not {setup.gravity:g}")
    if setup.friction is not None and not 0.0 <= setup.friction <= LARGEST:
        raise IdentificationError(f"a friction coefficient is 0 to {LARGEST:g}, not {setup.friction:g}")
    for name, value in (setup.noise._asdict() if setup.noise else {}).items():
        if not 0.0 <= value <= LARGEST:
            raise IdentificationError(f"the noise of the {name.replace('_', ' ')} is 0 to {LARGEST:g}, not {value:g}")


def _check_spin(states: BodyStates, noise: SampleNoise) -> None:
    rate = rate_of_turn(states, noise.angular_velocity)
    if rate is not None and not SLOWEST <= abs(rate) <= 1.0 / SLOWEST:
        raise IdentificationError(
            f"the rotations turn {rate:.3g} times as fast as the angular velocities say: give these in "
            "rad/s (in degrees it would be 0.0175) and in the axes in which they are recorded, no sample "
            "twice, and none rounded so much that the body stands still"
        )


def _check_wrench(states: BodyStates, wrench: ExternalWrench) -> None:
    first, last = float(states.time[0]), float(states.time[-1])
    slack = 2.0 * float(numpy.median(numpy.diff(states.time)))
    if wrench.present and (first < wrench.begin - slack or last > wrench.end + slack):
        raise IdentificationError(
            f"the external wrench is known from {wrench.begin:.6g} to {wrench.end:.6g} s, the states go from {first:.6g} to "
            f"{last:.6g} s; give a wrench that covers the states"
        )


def _why_no_mass(search: Search, found: ParameterEstimate) -> str:
    """Why a slide under a known force does not identify the mass; empty where there is none, or it
    does.
    """
    problem = search.problem
    if problem.model.wrench.force is None:
        return ""
    pairs = zip(problem.contacts, found.sides, strict=True)
    edges = [along_the_cone(problem, contact, sides) for contact, sides in pairs if contact.slides]
    if edges and all(edges):
        return "the known force lies along the edge of the friction cone, where it looks like more contact"
    if not edges and slides_of(problem, search.parts):
        return "a slide under a known force identifies it only where the friction coefficient is known too"
    return ""


def _result(found: ParameterEstimate, search: Search) -> Identification:
    problem, missing = search.problem, found.directions.missing
    spatial, model = problem.axis is None, problem.model
    names = parameter_names(spatial, model.with_mass)
    deviations = numpy.sqrt(numpy.diag(found.covariance))
    # Not identifiable: outside the rank, or not above the noise
    hidden, unsure = abs(missing).max(axis=0, initial=0.0) >= HIDDEN, made_up(found, problem)
    parameters = [
        Parameter(name, "1/kg" if name == "1/m" else "m^2", float(value), float(deviation), not lost)
        for name, value, deviation, lost in zip(names, found.parameters, deviations, hidden | unsure, strict=True)
    ]
    words = unobservable(missing, found.parameters, found.scale, spatial, model.with_mass, _why_no_mass(search, found))
    wrong_way = against_the_wrench(found, problem)
    words += hidden_by_noise(
        [name for name, lost in zip(names, unsure & ~hidden, strict=True) if lost], wrong_way=wrong_way
    )
    contacts = findings(problem, found, search.parts, search.places, search.notes)
    warnings = consistency_warnings(found, search.notes.values(), problem)
    return Identification(
        parameters=parameters,
        unobservable=words,
        warnings=warnings,
        rank=found.directions.rank,
        unknowns=model.unknowns,
        contacts=contacts,
        noise=problem.noise,
        flights=search.flights,
        axis=problem.axis,
        converged=found.converged,
        estimate=found,
        problem=problem,
    )
