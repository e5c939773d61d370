"""Work-precision studies of the sample's memory: depth under a force course, and the steady motion
of a shaken contact.

History: a standard solid under the force of an impact. Kelvin and Voigt's element of the same
complex modulus at the impact's frequency, internal variables on few and on many samples, against
the hereditary integral by quadrature.

Complex response: a sphere pressed on rubber by F0 and shaken by a part of it. Amplitude and phase
of the linearised contact, harmonic balance, time integration.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy
from scipy.optimize import root

from contact_sim_lab.records.work_precision import (
    FidelityLevel,
    Row,
    WorkPrecision,
    milliseconds,
    relative,
    row,
    timed_once,
)
from contact_sim_lab.rigs.impact.twins import hereditary, shaken_contact
from contact_sim_lab.rigs.impact.work_precision import MODULUS, SPEED, SPHERE
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.impact.theory.bodies import Material
from contact_sim_pkg.rigs.impact.theory.motion import course, solve_impact
from contact_sim_pkg.rigs.impact.theory.viscoelastic import creep
from contact_sim_pkg.rigs.impact.theory.viscoelastic.hereditary import hereditary_integral

__all__ = ["HISTORY_PART", "RESPONSE_PART", "WORK_PRECISION", "history_rows", "response_rows"]

HISTORY_PART = "viscoelastic history"
HISTORY_REFERENCE = "hereditary integral by Gauss quadrature, 400 samples"
QUANTITY = "depth at the turning point"
SAMPLES = 401
RESPONSE_PART = "complex response"
RESPONSE_REFERENCE = "scipy's DOP853 at 1e-12 over 100 periods"
LOAD = 20.0  # [N]
PARTS = (0.05, 0.3)
RATIO = 0.7  # of the driving frequency over that of the linearised contact
POINTS = 64  # instants a period


def history_rows() -> list[Row]:
    """Retarded compliance small and large against the instant one; depth at the turning point and
    at its largest.
    """
    found = []
    impact = solve_impact(SPHERE, Material(MODULUS, 0.2), SPEED)
    times: Vector = numpy.linspace(0.0, impact.compression_time, SAMPLES, dtype=numpy.float64)
    force = course(impact, times).force
    modulus = 0.25 * impact.shape * MODULUS  # shear modulus whose elastic limit is that of the impact at nu = 1/2
    for ratio in (4.0, 1.0):
        solid = creep.standard_solid(modulus, ratio * modulus, 1.0 / impact.frequency)
        expected = _depth(float(hereditary.integral(functools.partial(creep.compliance, solid), times, force)[-1]))
        ways: dict[str, Callable[[], float]] = {
            "Kelvin-Voigt force": functools.partial(_same_modulus, solid, impact.frequency, times, force),
            "internal variables, 20 samples": functools.partial(_inner, solid, times[::20], force[::20]),
            "internal variables, 400 samples": functools.partial(_inner, solid, times, force),
        }
        case = f"standard solid, retarded over instant compliance {1.0 / ratio:g}"
        for name, way in ways.items():
            value, fidelity = way(), FidelityLevel(name, milliseconds(way))
            error = relative(value, expected)
            found.append(
                row(HISTORY_PART, case, QUANTITY, fidelity, HISTORY_REFERENCE, error, value=value, expected=expected)
            )
        call = functools.partial(hereditary.integral, functools.partial(creep.compliance, solid), times, force)
        spent = timed_once(call)[1]
        found.append(
            row(HISTORY_PART, case, QUANTITY, FidelityLevel("quadrature", spent), HISTORY_REFERENCE, 0.0,
                value=expected, expected=expected)
        )  # fmt: skip
    return found


def response_rows() -> list[Row]:
    """Small and large shaking: half the range of the depth, and phase of its first harmonic behind
    the force.
    """
    found = []
    elastic, viscous, frequency = _contact()
    for part in PARTS:
        reference = functools.partial(
            shaken_contact.last_period, SPHERE.mass, elastic, viscous, LOAD, part, frequency, 100, POINTS, 1e-12
        )
        expected = _reading(reference())
        ways = {
            "amplitude and phase": functools.partial(_linear, part),
            "harmonic balance, 1 harmonic": functools.partial(_balanced, part, 1),
            "harmonic balance, 3 harmonics": functools.partial(_balanced, part, 3),
            "harmonic balance, 6 harmonics": functools.partial(_balanced, part, 6),
            "time integration over 50 periods": functools.partial(
                shaken_contact.last_period, SPHERE.mass, elastic, viscous, LOAD, part, frequency, 50, POINTS, 1e-8
            ),
        }
        for name, way in ways.items():
            depth, spent = timed_once(way)
            fidelity = FidelityLevel(name, milliseconds(way) if spent < 50.0 else spent)
            for quantity, value, true in zip(
                ("half range of the depth", "phase"), _reading(depth), expected, strict=True
            ):
                error = relative(value, true)
                found.append(
                    row(RESPONSE_PART, f"shaken by {part:g} of the load", quantity, fidelity, RESPONSE_REFERENCE, error,
                        value=value, expected=true)
                )  # fmt: skip
    return found


def _depth(cube: float) -> float:
    """Depth [m] of ``x^1.5 = 3 (1 - nu)/(8 sqrt R) I`` at nu = 1/2."""
    return float((0.1875 / math.sqrt(SPHERE.radius) * cube) ** (2.0 / 3.0))


def _inner(solid: creep.Creep, times: Vector, force: Vector) -> float:
    return _depth(float(hereditary_integral(solid, times, force)[-1]))


def _same_modulus(solid: creep.Creep, frequency: float, times: Vector, force: Vector) -> float:
    """By Kelvin and Voigt's element with the complex modulus of the solid at ``frequency``."""
    modulus = 1.0 / creep.complex_compliance(solid, frequency)
    element = creep.kelvin_voigt(modulus.real, modulus.imag / modulus.real / frequency)
    return _inner(element, times, force)


@functools.lru_cache(maxsize=1)
def _contact() -> tuple[float, float, float]:
    """A, B and the driving frequency [rad/s], which is also that of the loss."""
    impact = solve_impact(SPHERE, Material(MODULUS, 0.2), SPEED)
    rest = (LOAD / impact.elastic) ** (2.0 / 3.0)
    frequency = RATIO * math.sqrt(1.5 * impact.elastic * math.sqrt(rest) / SPHERE.mass)
    return impact.elastic, 3.0 * impact.elastic * 0.2 / frequency, frequency


def _reading(depth: Vector) -> tuple[float, float]:
    """Half the range, and the phase by which the first harmonic lags the force."""
    first = numpy.fft.rfft(depth)[1]
    return 0.5 * float(depth.max() - depth.min()), float(-numpy.angle(first))


def _linear(part: float) -> Vector:
    """The contact linearised at the static depth."""
    elastic, viscous, frequency = _contact()
    rest = (LOAD / elastic) ** (2.0 / 3.0)
    stiffness = 1.5 * elastic * math.sqrt(rest) + 1.0j * frequency * viscous * math.sqrt(rest)
    answer = part * LOAD / (stiffness - SPHERE.mass * frequency**2)
    angle = 2.0 * math.pi * numpy.arange(POINTS) / POINTS
    depth: Vector = rest + numpy.real(answer * numpy.exp(1.0j * angle))
    return depth


def _balanced(part: float, harmonics: int) -> Vector:
    """Fourier coefficients for which the equation of motion holds in ``harmonics`` harmonics and
    the mean.
    """
    elastic, viscous, frequency = _contact()
    angle = 2.0 * math.pi * numpy.arange(POINTS) / POINTS
    orders = numpy.arange(harmonics + 1)
    rest = (LOAD / elastic) ** (2.0 / 3.0)
    wave = numpy.exp(1.0j * numpy.outer(angle, orders))

    # Depth and its derivatives from the Fourier coefficients, scaled by the static depth.
    def depth_of(unknowns: Vector) -> tuple[Vector, Vector, Vector]:
        terms = rest * (unknowns[: harmonics + 1] + 1.0j * numpy.r_[0.0, unknowns[harmonics + 1 :]])
        moving = [numpy.real(wave @ (terms * (1.0j * orders * frequency) ** power)) for power in range(3)]
        return moving[0], moving[1], moving[2]

    def residual(unknowns: Vector) -> Vector:
        depth, speed, acceleration = depth_of(unknowns)
        root_depth = numpy.sqrt(numpy.maximum(depth, 0.0))
        force = SPHERE.mass * acceleration + elastic * depth * root_depth + viscous * root_depth * speed
        terms = numpy.fft.rfft(force / LOAD - 1.0 - part * numpy.cos(angle))[: harmonics + 1] / POINTS
        parts: Vector = numpy.concatenate([terms.real, terms.imag[1:]])
        return parts

    # Start from the static depth.
    guess = numpy.zeros(2 * harmonics + 1)
    guess[0] = 1.0
    depth: Vector = depth_of(root(residual, guess, tol=1e-12).x)[0]
    return depth


WORK_PRECISION = (
    WorkPrecision(HISTORY_PART, history_rows),
    WorkPrecision(RESPONSE_PART, response_rows),
)
