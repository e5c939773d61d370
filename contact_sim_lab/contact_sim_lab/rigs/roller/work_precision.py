"""Work-precision studies of the roller rig: stress under the contact, dangerous volume, tilt and
yaw in time, load split, growth of a wave.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy
import scipy.integrate
import scipy.optimize
from numpy.typing import NDArray

from contact_sim_lab.records.work_precision import (
    FidelityLevel,
    Row,
    WorkPrecision,
    milliseconds,
    relative,
    row,
    timed_once,
)
from contact_sim_lab.rigs.roller import twin as reference
from contact_sim_lab.rigs.roller.paper_bench import (
    BENDING_COMPLIANCE,
    CURVATURES,
    LIMITS,
    LOAD,
    MASS,
    MODULUS,
    POISSON,
    ROLLER,
    SHAFT_RADIUS,
)
from contact_sim_pkg.pressure.closed_form.hertz_stress import EllipseLoad, ellipse_stress
from contact_sim_pkg.rigs.roller.theory.corrugation import growth_of_wave, make_track, run_intervals
from contact_sim_pkg.rigs.roller.theory.ellipse import contact_of_rollers
from contact_sim_pkg.rigs.roller.theory.heave import make_heave
from contact_sim_pkg.rigs.roller.theory.load_split import load_of_approach, parallel_contact_load
from contact_sim_pkg.rigs.roller.theory.motion import gauss_rule, integrate_tilt_yaw
from contact_sim_pkg.rigs.roller.theory.stability import linearise
from contact_sim_pkg.rigs.roller.theory.volumes import COUNTED, INTERPOLATED, dangerous_volumes

__all__ = [
    "MOTION_PART",
    "SPLIT_PART",
    "STRESS_PART",
    "VOLUME_PART",
    "WAVE_PART",
    "WORK_PRECISION",
    "motion_rows",
    "split_rows",
    "stress_rows",
    "volume_rows",
    "wave_rows",
]

STRESS_PART = "stress under the contact"
VOLUME_PART = "dangerous volume"
MOTION_PART = "tilt and yaw in time"
SPLIT_PART = "load split"
WAVE_PART = "growth of a wave on the track"

Values = NDArray[numpy.float64]

FORCES = "point forces, 800 x 1600, no shared code"
DEPTHS = (0.05, 0.2, 0.5, 1.0)  # of the smaller semi-axis
CUBATURES = ((24, 48), (80, 160))


@functools.cache
def _bench() -> EllipseLoad:
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, LOAD)
    return EllipseLoad(contact.along_x, contact.along_y, 1.0, 0.0, 0.1)


def _circle(load: EllipseLoad, points: Values) -> Values:
    """On the axis of a circle of the same area, without traction: Johnson (1985), eq 3.45."""
    depth = points[:, 2] / math.sqrt(load.a * load.b)
    zz = -1.0 / (1.0 + depth**2)
    xx = -(1.0 + POISSON) * (1.0 - depth * numpy.arctan2(1.0, depth)) - 0.5 * zz
    zero = 0.0 * depth
    return numpy.stack([xx, xx, zz, zero, zero, zero], axis=1)


def _stress_ways(load: EllipseLoad, points: Values) -> list[tuple[str, Callable[[], Values]]]:
    """Ways to the stresses [n, 6] at points; the first knows the first point alone."""

    def summed(radii: int, angles: int) -> Values:
        axes, traction = (load.a, load.b), (load.traction_x, load.traction_y)
        return numpy.array([reference.ellipse_stress(axes, traction, POISSON, p, radii, angles) for p in points])

    return [
        ("circle of the same area, on the axis", lambda: _circle(load, points[:1])),
        *((f"point forces, {n} x {m}", functools.partial(summed, n, m)) for n, m in CUBATURES),
        ("one integral a point", lambda: ellipse_stress(load, POISSON, points)),
    ]


def stress_rows() -> list[Row]:
    """Worst component at a depth, on the axis and beside it, over the peak pressure."""
    load, found = _bench(), list[Row]()
    axes = (load.a, load.b)
    for depth in DEPTHS:
        points = numpy.array(
            [(x * load.a, y * load.b, depth * load.b) for x, y in ((0.0, 0.0), (0.5, 0.4), (0.9, 0.9))]
        )
        right = numpy.array([reference.ellipse_stress(axes, (0.0, 0.1), POISSON, p, 800, 1600) for p in points])
        for name, way in _stress_ways(load, points):
            value = way()
            error = float(abs(value - right[: len(value)]).max())
            fidelity = FidelityLevel(name, milliseconds(way) / len(value))
            found.append(row(STRESS_PART, f"z = {depth:g} b", "largest error over p0", fidelity, FORCES, error))
    return found


def volume_rows() -> list[Row]:
    """Union of the components of the bench under its load."""
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, LOAD)
    finest = (144, 144, 144)

    def measure(cells: tuple[int, int, int], kind: int) -> float:
        return dangerous_volumes(contact, POISSON, LIMITS, cells, kind=kind).any

    measure((2, 2, 2), COUNTED)
    right, ms = timed_once(lambda: measure(finest, COUNTED))
    found = []
    for cells, kind, name in (
        ((32, 32, 32), COUNTED, "count"), ((16, 20, 12), INTERPOLATED, "depth between two middles"),
        ((32, 40, 16), INTERPOLATED, "depth between two middles"), ((64, 64, 48), INTERPOLATED, "depth between two middles"),
    ):  # fmt: skip
        value, cost = timed_once(lambda cells=cells, kind=kind: measure(cells, kind))  # type: ignore[misc]
        fidelity = FidelityLevel(name, cost, "x".join(map(str, cells)))
        reference_name = f"count, {'x'.join(map(str, finest))} ({1e-3 * ms:.0f} s)"
        found.append(row(
            VOLUME_PART, f"{LOAD:g} N", "V_T", fidelity, reference_name, relative(value, right), value=value, expected=right,
        ))  # fmt: skip
    return found


def motion_rows() -> list[Row]:
    """A large swing of the undamped roller under 300 N for 0.1 s: 30 periods of the faster
    motion.
    """
    span, start = 0.1, numpy.array([0.05, -0.03, 0.0, 0.0])
    linear = linearise(ROLLER, CURVATURES, None, MODULUS, 300.0)
    inverse = numpy.linalg.inv(linear.inertia)

    def slope(_t: float, y: Values) -> Values:
        arm = 300.0 * ROLLER.radius * math.sin(y[0])
        gyro = ROLLER.inertia_spin * ROLLER.spin
        torque = (arm - 60.0 * y[0] - gyro * y[3], 0.01 * arm - 50.0 * y[1] + gyro * y[2])
        return numpy.concatenate([y[2:], inverse @ torque])

    def eigenmodes() -> Values:
        matrix = numpy.block(
            [[numpy.zeros((2, 2)), numpy.eye(2)], [-inverse @ linear.stiffness, -inverse @ linear.damping]]
        )
        values, vectors = numpy.linalg.eig(matrix)
        return numpy.real(vectors @ (numpy.exp(values * span) * numpy.linalg.solve(vectors, start.astype(complex))))

    def nonlinear(stages: int, steps: int) -> Values:
        state, record = start.copy(), numpy.empty((2, 4))
        integrate_tilt_yaw(
            ROLLER,
            CURVATURES,
            None,
            MODULUS,
            numpy.full(steps + 1, 300.0),
            span / steps,
            gauss_rule(stages),
            state,
            record,
        )
        return state

    right = scipy.integrate.solve_ivp(slope, (0.0, span), start, method="DOP853", rtol=3e-14, atol=1e-15).y[:, -1]
    ways = [(FidelityLevel("eigenvalues, linear", milliseconds(eigenmodes)), eigenmodes())]
    for stages, steps in ((1, 1000), (1, 10000), (2, 500), (2, 2000), (3, 500), (3, 2000)):
        name = ("implicit midpoint", "Gauss, order 4", "Gauss, order 6")[stages - 1]
        cost = milliseconds(lambda stages=stages, steps=steps: nonlinear(stages, steps))  # type: ignore[misc]
        ways.append((FidelityLevel(name, cost, f"{steps} steps"), nonlinear(stages, steps)))
    return [
        row(MOTION_PART, "0.05 rad, 0.1 s", "angles", fidelity, "scipy DOP853 at 3e-14",
            float(abs(value[:2] - right[:2]).max() / 0.05))
        for fidelity, value in ways
    ]  # fmt: skip


def split_rows() -> list[Row]:
    """Contact load of the bench by both modes; the parallel one against the least complementary
    energy.
    """
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, LOAD)
    k_c = contact.approach / LOAD ** (2.0 / 3.0)

    def energy(share: float) -> float:
        f = share * LOAD
        return float(0.6 * k_c * f ** (5.0 / 3.0) + 0.5 * BENDING_COMPLIANCE * (LOAD - f) ** 2)

    right = (
        LOAD * scipy.optimize.minimize_scalar(energy, bounds=(0.0, 1.0), method="bounded", options={"xatol": 1e-12}).x
    )
    series = load_of_approach(k_c, BENDING_COMPLIANCE, k_c * LOAD ** (2.0 / 3.0) + BENDING_COMPLIANCE * LOAD)
    found = []
    for name, value, against, cost in (
        ("series", series, LOAD, milliseconds(lambda: load_of_approach(k_c, BENDING_COMPLIANCE, 1e-5))),
        ("parallel, root", parallel_contact_load(k_c, BENDING_COMPLIANCE, LOAD), right,
         milliseconds(lambda: parallel_contact_load(k_c, BENDING_COMPLIANCE, LOAD))),
    ):  # fmt: skip
        reference_name = "the load itself" if name == "series" else "least energy, scipy"
        error = relative(value, against)
        found.append(
            row(
                SPLIT_PART,
                f"{LOAD:g} N",
                "contact load",
                FidelityLevel(name, cost),
                reference_name,
                error,
                value=value,
                expected=against,
            )
        )
    return found


def wave_rows() -> list[Row]:
    """A wave of 0.1 nm, two round the track, share (F/F_N)^3: growth a turn by cells of the track
    and turns an interval.
    """
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, LOAD)
    heave = make_heave(MASS, 0.05, LOAD, contact.approach / LOAD ** (2.0 / 3.0), BENDING_COMPLIANCE)
    loads = numpy.linspace(0.0, 4.0 * LOAD, 4001, dtype=numpy.float64)
    found = []
    for cells, turns in ((64, 1), (256, 1), (1024, 1), (256, 4), (256, 16)):
        track = make_track(SHAFT_RADIUS, 1.0 / 200.0, cells, 0.0, 5e-3, contact.approach, (loads, (loads / LOAD) ** 3))
        right = growth_of_wave(heave, track, 2, 3.0, cells)
        heights = 1e-10 * numpy.cos(4.0 * math.pi * numpy.arange(cells) / cells)
        state, mean, moved = numpy.zeros(2), numpy.zeros(cells), numpy.zeros((cells, 2))
        run_intervals(heave, track._replace(gain=0.0), 1, 200, heights, state, mean, moved)
        first, count = abs(numpy.fft.rfft(heights)[2]), 320 // turns
        _, cost = timed_once(
            lambda track=track, turns=turns, count=count, heights=heights, state=state, mean=mean, moved=moved: (
                run_intervals(  # type: ignore[misc]
                    heave, track, turns, count, heights, state, mean, moved
                )
            )
        )
        value = math.log(abs(numpy.fft.rfft(heights)[2]) / first) / (count * turns)
        fidelity = FidelityLevel(f"{turns} turns an interval", cost / 320.0, f"{cells} cells")
        found.append(row(
            WAVE_PART, "two waves", "growth a turn", fidelity, "linear theory", relative(value, right), value=value, expected=right,
        ))  # fmt: skip
    return found


WORK_PRECISION = (
    WorkPrecision(STRESS_PART, stress_rows),
    WorkPrecision(VOLUME_PART, volume_rows),
    WorkPrecision(MOTION_PART, motion_rows),
    WorkPrecision(SPLIT_PART, split_rows),
    WorkPrecision(WAVE_PART, wave_rows),
)
