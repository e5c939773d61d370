"""Hard cases of the roller rig: separation, divergence, flutter, mass matrix, resonance, axes that
swap, surface, limits.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
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
from contact_sim_pkg.rigs.roller.theory.corrugation import make_track, run_intervals
from contact_sim_pkg.rigs.roller.theory.ellipse import contact_of_rollers
from contact_sim_pkg.rigs.roller.theory.heave import Heave, closed_path, make_heave, natural_frequency, ride
from contact_sim_pkg.rigs.roller.theory.load_split import load_of_approach
from contact_sim_pkg.rigs.roller.theory.moments import moments
from contact_sim_pkg.rigs.roller.theory.motion import DIVERGED, LARGEST_TILT, energy, gauss_rule, integrate_tilt_yaw
from contact_sim_pkg.rigs.roller.theory.parameters import Bending, Curvatures
from contact_sim_pkg.rigs.roller.theory.stability import RollerError, critical_damping, stability
from contact_sim_pkg.rigs.roller.theory.volumes import box_volume, dangerous_volumes, fills_box, leaves_box

__all__ = ["CASES"]

ROLLING, BELOW = "roller", "stress below the surface"
BENDING = Bending(225.0, 0.060, 0.158, SHAFT_RADIUS, 0.25 * math.pi * SHAFT_RADIUS**4, 0.1)
CELLS = 256


def _heave(damping_ratio: float = 0.05) -> Heave:
    approach = contact_of_rollers(CURVATURES, 0.0, MODULUS, LOAD).approach
    return make_heave(MASS, damping_ratio, LOAD, approach / LOAD ** (2.0 / 3.0), BENDING_COMPLIANCE)


def no_contact() -> Finding:
    """Load, moments and volumes for approaches from 0 down, and the contact of no load."""
    free = contact_of_rollers(CURVATURES, 0.3, MODULUS, 0.0)
    approaches = (0.0, -0.0, -1e-300, -1.0, -math.inf)
    values = [load_of_approach(4e-7, 7e-7, x) for x in approaches]
    values += [*free, *moments(ROLLER, CURVATURES, BENDING, MODULUS, 0.0, 0.1, 0.1)]
    values += [*dangerous_volumes(free, POISSON, LIMITS, (4, 4, 4))]
    return exactly(float(numpy.abs(values).max()), 0.0, hard=max(free.load, *approaches))


def separation_is_reported() -> Finding:
    """A wave of 1 mm throws the roller off: share of the time without contact, all values
    finite.
    """
    track = 1e-3 * numpy.cos(4.0 * math.pi * numpy.arange(CELLS) / CELLS)
    state, loads = numpy.zeros(2), numpy.zeros(CELLS)
    heave = _heave()
    free = ride(heave, closed_path(heave, track), 1.0 / 200.0 / CELLS, 5, state, loads, numpy.zeros((CELLS, 2)))
    finite = bool(numpy.isfinite(state).all() and numpy.isfinite(loads).all() and (loads >= 0.0).all())
    return close_to(free if finite else math.nan, 0.75, 0.25, hard=(loads == 0.0).sum())


def divergence_is_reported() -> Finding:
    """F R above k_psi, no spin: status, and the last tilt finite."""
    still, state = ROLLER._replace(spin=0.0, rolling_friction=0.0), numpy.array([1e-6, 0.0, 0.0, 0.0])
    record = numpy.empty((2, 4))
    status = integrate_tilt_yaw(
        still, CURVATURES, None, MODULUS, numpy.full(400_001, 3100.0), 1e-5, gauss_rule(2), state, record
    )
    return exactly(
        float(status) if LARGEST_TILT < abs(state[0]) < 1.0 else math.nan,
        float(DIVERGED),
        hard=3100.0 * still.radius / still.stiffness_tilt,
    )


def energy_is_kept() -> Finding:
    """No friction, 1e4 spin periods: largest relative change of the energy."""
    free, state = ROLLER._replace(rolling_friction=0.0), numpy.array([1e-3, -5e-4, 0.1, 0.2])
    steps, record = 1_000_000, numpy.empty((201, 4))
    integrate_tilt_yaw(
        free, CURVATURES, None, MODULUS, numpy.full(steps + 1, 300.0), 200.0 / steps, gauss_rule(2), state, record
    )
    energies = numpy.array([energy(free, 300.0, each) for each in record])
    return at_most(float(abs(energies / energies[0] - 1.0).max()), 1e-6, hard=free.spin * 200.0 / (2.0 * math.pi))


def flutter_grows_as_its_root() -> Finding:
    """Spin and rolling friction without damping: growth over 2 s over that of the root, in the
    mode's own coordinate.
    """
    found = stability(ROLLER, CURVATURES, None, MODULUS, 300.0)
    inverse = numpy.linalg.inv(found.linear.inertia)
    matrix = numpy.block([
        [numpy.zeros((2, 2)), numpy.eye(2)], [-inverse @ found.linear.stiffness, -inverse @ found.linear.damping]
    ])  # fmt: skip
    values, vectors = numpy.linalg.eig(matrix.T)
    left, state, record = vectors[:, values.real.argmax()], numpy.array([1e-7, 2e-7, 0.0, 0.0]), numpy.empty((2, 4))
    first = abs(left @ state)
    integrate_tilt_yaw(ROLLER, CURVATURES, None, MODULUS, numpy.full(40_001, 300.0), 5e-5, gauss_rule(3), state, record)
    return close_to(
        math.log(abs(left @ state) / first) / 2.0 / float(values.real.max()), 1.0, 1e-4, hard=values.real.max()
    )


def singular_inertia_is_refused() -> Finding:
    """I_yz^2 from I_y I_z on: refusals of two."""
    refused, products = 0, (2e-5, 3e-5)
    for product in products:
        try:
            stability(ROLLER._replace(inertia_product=product), CURVATURES, None, MODULUS, 300.0)
        except RollerError:
            refused += 1
    return exactly(
        float(refused), 2.0, hard=max(ROLLER.inertia_tilt * ROLLER.inertia_yaw - product**2 for product in products)
    )


def resonance() -> Finding:
    """Undamped heave, a wave at kappa itself: its swing after n turns over `W kappa t / 2`."""
    heave, waves, size, turns = _heave(0.0), 2, 1e-15, 50
    turn = 2.0 * math.pi * waves / natural_frequency(heave)
    track = size * numpy.cos(2.0 * math.pi * waves * numpy.arange(CELLS) / CELLS)
    state, loads = numpy.zeros(2), numpy.zeros(CELLS)
    ride(heave, closed_path(heave, track), turn / CELLS, turns, state, loads, numpy.zeros((CELLS, 2)))
    swing = math.hypot(float(state[0]), float(state[1]) / natural_frequency(heave))
    return close_to(swing / (0.5 * size * natural_frequency(heave) * turn * turns), 1.0, 5e-3, hard=swing / size)


def axes_keep_their_names() -> Finding:
    """Largest jump of the axes while the ellipse grows from long along y to long along x, over
    their change without it.
    """
    sizes = [
        contact_of_rollers(Curvatures(3.0, 0.0, k, 0.0), 0.0, MODULUS, LOAD)[:2] for k in numpy.linspace(2.9, 3.1, 201)
    ]
    steps = numpy.abs(numpy.diff(numpy.array(sizes), axis=0))
    return at_most(
        float((steps.max(axis=0) / steps.mean(axis=0)).max()),
        1.5,
        hard=(numpy.diff(numpy.sign(numpy.diff(numpy.array(sizes), axis=1)[:, 0])) != 0.0).sum(),
    )


def nothing_is_worn_below_the_limits() -> Finding:
    """p0 below both limits: dangerous volume, and what a track of that share loses."""
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, LOAD)
    volume = dangerous_volumes(contact, POISSON, (1e11, 1e11), (16, 16, 12)).any
    track = make_track(
        SHAFT_RADIUS, 5e-3, CELLS, 2e-4, 0.05, contact.approach, (numpy.array([0.0, 1e6]), numpy.zeros(2))
    )
    heights, state, loads = 1e-9 * numpy.sin(numpy.arange(CELLS) / 5.0), numpy.zeros(2), numpy.zeros(CELLS)
    before = heights.copy()
    run_intervals(_heave(), track, 1, 10, heights, state, loads, numpy.zeros((CELLS, 2)))
    return exactly(volume + float(abs(heights - before).max()), 0.0, hard=contact.peak_pressure / 1e11)


def everything_is_dangerous() -> Finding:
    """Limits next to 0: V_T over the box, with its flag; limits above the pressure:
    nothing, and no flag.
    """
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, LOAD)
    full, none = (dangerous_volumes(contact, POISSON, (limit, limit), (8, 8, 6)) for limit in (1e-6, 1e11))
    seen = fills_box(full, contact) and not fills_box(none, contact) and none.any == 0.0
    return close_to(full.any / box_volume(contact) if seen else math.nan, 1.0, 1e-12, hard=contact.peak_pressure / 1e-6)


def towards_the_surface() -> Finding:
    """Under a circle from z = 0.03 a to 1e-12 a, off the axis: distance to the surface values over
    2.1 times the depth, worst.
    """
    worst, surface = (
        0.0,
        ellipse_stress(EllipseLoad(1.0, 1.0, 1.0, 0.0, 0.0), POISSON, numpy.array([(0.5, 0.0, 0.0)]))[0],
    )
    radial = (1.0 - 2.0 * POISSON) * (1.0 - 0.75**1.5) / (3.0 * 0.25)
    exact = numpy.array(
        [radial - math.sqrt(0.75), -radial - 2.0 * POISSON * math.sqrt(0.75), -math.sqrt(0.75), 0.0, 0.0, 0.0]
    )
    depths = (0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.03)
    for depth in depths:
        point = numpy.array([(0.5, 0.0, depth)])
        near = ellipse_stress(EllipseLoad(1.0, 1.0, 1.0, 0.0, 0.0), POISSON, point)[0]
        worst = max(worst, float(abs(near - exact).max()) / (2.1 * depth + 1e-8))
    return at_most(worst if numpy.isfinite(surface).all() else math.inf, 1.0, hard=min(depths))


def slender_volumes() -> Finding:
    """Profile radii up to 10 m, b/a down to 0.009: V_T of the usual cells over that of cells
    counted one by one, worst.
    """
    worst, slenderest = 0.0, 1.0
    for curvature in (10.0, 1.0, 0.1):
        contact = contact_of_rollers(CURVATURES._replace(roller_axial=curvature), 0.0, MODULUS, LOAD)
        slenderest = min(slenderest, min(contact[:2]) / max(contact[:2]))
        usual = dangerous_volumes(contact, POISSON, LIMITS).any
        fine = dangerous_volumes(contact, POISSON, LIMITS, (40, 40, 100)).any
        worst = max(worst, abs(usual / fine - 1.0))
    return at_most(worst, 0.03, hard=slenderest)


def damage_at_the_surface() -> Finding:
    """Traction 0.4, limits that the surface alone passes: V_T over that of four times as many
    depths.
    """
    contact, limits, pulled = contact_of_rollers(CURVATURES, 0.0, MODULUS, LOAD), (2.2e9, 6.5e8), (0.0, 0.4)
    without = dangerous_volumes(contact, POISSON, limits, (32, 40, 16)).any
    usual = dangerous_volumes(contact, POISSON, limits, (32, 40, 16), None, pulled).any
    return close_to(
        usual / dangerous_volumes(contact, POISSON, limits, (32, 40, 64), None, pulled).any, 1.0, 0.05, hard=without
    )


def a_volume_that_leaves_its_box() -> Finding:
    """Reported where a side or the floor of the box is dangerous, and not where none is: answers
    that are right, of two.
    """
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, 300.0)
    full = dangerous_volumes(contact, POISSON, (1e8, 3e7), (16, 16, 12)).any
    seen = leaves_box(contact, POISSON, (1e8, 3e7)) and not leaves_box(contact, POISSON, (2e9, 1e9))
    return exactly(float(seen), 1.0, hard=full / box_volume(contact))


def neutral_without_damping() -> Finding:
    """No friction, no damping, any spin: growth rate and damping requested, largest."""
    still = [ROLLER._replace(rolling_friction=0.0, spin=spin) for spin in (0.0, 10.0, 300.0, 3e4)]
    rates = [abs(stability(each, CURVATURES, None, MODULUS, 300.0).growth_rate) for each in still]
    dampings = [critical_damping(each, CURVATURES, None, MODULUS, 300.0) for each in still]
    return exactly(
        max(*rates, *dampings),
        0.0,
        hard=sum(abs(each.rolling_friction) + each.damping_tilt + each.damping_yaw for each in still),
    )


def slender_ellipse() -> Finding:
    """b/a = 1e-6: orthogonal shear at 0.866 b and 0.5 b over p0 against the line's 0.25."""
    load = EllipseLoad(1.0, 1e-6, 1.0, 0.0, 0.0)
    stress = ellipse_stress(load, POISSON, numpy.array([(0.0, math.sqrt(0.75) * 1e-6, 0.5e-6)]))[0]
    return close_to(abs(float(stress[5])), 0.25, 1e-6, hard=load.b / load.a)


def far_away() -> Finding:
    """At 1e4 radii the stress of a point force: zz over -3 P z^3 / (2 pi r^5)."""
    x, y, z = 3e3, 5e3, 8e3
    stress = ellipse_stress(EllipseLoad(1.0, 0.5, 1.0, 0.0, 0.0), POISSON, numpy.array([(x, y, z)]))[0]
    force = 2.0 / 3.0 * math.pi * 0.5
    right = -1.5 * force / math.pi * z**3 / math.sqrt(x * x + y * y + z * z) ** 5
    return close_to(float(stress[2]) / right, 1.0, 1e-6, hard=math.sqrt(x * x + y * y + z * z))


CASES = [
    HardCase(ROLLING, "no contact: approach at and below 0", no_contact,
        guard.at_most("load [N] and approach [m]", 0.0)),
    HardCase(ROLLING, "the roller leaves a wave of 1 mm", separation_is_reported, guard.contact_lost(10)),
    HardCase(ROLLING, "F R above the tilt stiffness", divergence_is_reported,
        guard.above("load times radius over the tilt stiffness", 1.0)),
    HardCase(ROLLING, "1e4 spin periods without friction", energy_is_kept, guard.at_least("turns of the spin", 1e4)),
    HardCase(ROLLING, "flutter without damping", flutter_grows_as_its_root,
        guard.above("real part of a root [1/s]", 0.0)),
    HardCase(ROLLING, "neither friction nor damping: growth and damping requested", neutral_without_damping,
        guard.zero("friction and damping")),
    HardCase(ROLLING, "inertia that is no mass matrix", singular_inertia_is_refused,
        guard.at_most("determinant of the inertia [kg² m⁴]", 0.0)),
    HardCase(ROLLING, "track wave at the natural frequency", resonance,
        guard.at_least("swing over the wave's height", 50.0)),
    HardCase(ROLLING, "the ellipse's axes swap their size", axes_keep_their_names,
        guard.at_least("changes of the longer axis", 1)),
    HardCase(ROLLING, "pressure below both limits", nothing_is_worn_below_the_limits,
        guard.below("peak pressure over the limits", 1.0)),
    HardCase(BELOW, "limits next to 0, and above the pressure", everything_is_dangerous,
        guard.scales("pressure and limit", 1e12)),
    HardCase(BELOW, "a volume that leaves its box", a_volume_that_leaves_its_box,
        guard.at_least("share of the box that is dangerous", 0.5)),
    HardCase(BELOW, "z to 0", towards_the_surface, guard.zero("least depth over radius")),
    HardCase(BELOW, "damage in a layer at the surface", damage_at_the_surface,
        guard.zero("dangerous volume without the traction [m³]")),
    HardCase(BELOW, "volumes under b/a down to 0.009", slender_volumes, guard.at_most("least b/a", 0.01)),
    HardCase(BELOW, "b/a = 1e-6", slender_ellipse, guard.at_most("b/a", 1e-6)),
    HardCase(BELOW, "1e4 radii away", far_away, guard.scales("distance and radius", 9e3)),
]  # fmt: skip
