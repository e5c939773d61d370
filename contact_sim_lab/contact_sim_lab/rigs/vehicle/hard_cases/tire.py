"""Hard cases of the tire beside its field: closed forms on Lame domains, other profiles, stress
below, asperities, the road.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_lab.closed_form import axisymmetric
from contact_sim_lab.closed_form.axisymmetric_profile import PowerProfile
from contact_sim_lab.closed_form.lame_pressure import (
    ansatz_of_curvatures,
    ansatz_on_domain,
    eccentricity,
    equivalent_ellipse,
)
from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, exactly
from contact_sim_lab.twins.lame_pressure import printed_eccentricity_power
from contact_sim_pkg.excitation.blocks import RoadBlocks
from contact_sim_pkg.excitation.roads.iso8608 import Iso8608Road
from contact_sim_pkg.excitation.travel import Travel
from contact_sim_pkg.pressure.closed_form.hertz import hertz_contact, hertz_contact_at_approach
from contact_sim_pkg.pressure.closed_form.lame import fit_patch
from contact_sim_pkg.pressure.closed_form.subsurface import SurfaceGrid, subsurface_stress
from contact_sim_pkg.pressure.field.patch import contact_area
from contact_sim_pkg.pressure.field.winkler import winkler_at_load
from contact_sim_pkg.rigs.vehicle.tire.asperity_impulses import asperity_force, default_asperities, site_count

Field = NDArray[numpy.float64]
MODULUS, LOAD = 4.0e6, 4000.0


def real_eccentricity() -> Finding:
    """Domains where the printed k^n is not within 0 to 1 although the corrected one is (counted: 6
    of 6).
    """
    domains = [(1.0, 1.0, n) for n in (1.0, 1.5, 3.5, 4.0)] + [(2.0, 1.9, 1.2), (1.1, 1.0, 6.0)]
    right, outside = 0, 0
    for a, b, n in domains:
        printed = printed_eccentricity_power(a, b, n, 0.5 * (a**n + b**n))
        outside += not 0.0 <= printed <= 1.0
        right += 0.0 <= eccentricity(a, b, n) < 1.0
    return exactly(right, len(domains), hard=outside)


def ansatz_unloaded() -> Finding:
    """Sum of loads, approaches and pressures of the closed forms without load."""
    load = 0.0
    forms = (
        ansatz_on_domain(0.1, 0.05, 3.0, MODULUS, load),
        equivalent_ellipse(0.1, 0.05, 3.0, MODULUS, load),
        ansatz_of_curvatures(1.0, 2.0, 3.0, MODULUS, load),
    )
    return exactly(sum(form.load + form.approach + form.peak_pressure for form in forms), 0.0, hard=load)


def hertz_power() -> Finding:
    """Error of `P ~ approach^1.5` over 20 decades of load, and with the bodies exchanged."""
    worst, unit = 0.0, hertz_contact(0.7, 1.9, MODULUS, 1.0).approach
    loads = numpy.logspace(-10, 10, 21).tolist()
    for load in loads:
        one, other = hertz_contact(0.7, 1.9, MODULUS, load), hertz_contact(1.9, 0.7, MODULUS, load)
        worst = max(worst, abs((one.approach / unit) ** 1.5 / load - 1.0), abs(one.approach - other.approach))
        worst = max(worst, abs(hertz_contact_at_approach(0.7, 1.9, MODULUS, one.approach).load / load - 1.0))
    return at_most(worst, 1e-13, hard=max(loads) / min(loads))


def one_cell_area() -> Finding:
    """A patch of one cell: its area is the cell, and its Lame fit reports that there is none."""
    pressure = numpy.zeros((8, 8))
    pressure[3, 5] = 1e5
    fit = fit_patch(pressure, 0.01, 0.02, 0.0, 0.0)
    error = abs(contact_area(pressure, 0.01, 0.02) / 2e-4 - 1.0)
    return at_most(error + (1.0 if fit.fitted else 0.0), 1e-12, hard=(pressure > 0.0).sum())


def profiles_unloaded() -> Finding:
    """Radius, load and approach of cone, sphere and flat tip at load 0 and below."""
    sizes = (0.0, -1.0)
    profiles = [PowerProfile(0.5, k) for k in (1.0, 2.0, 4.0)]
    total = sum(axisymmetric.radius_at_load(p, MODULUS, x) for p in profiles for x in sizes)
    total += sum(axisymmetric.radius_at_approach(p, x) for p in profiles for x in sizes)
    return exactly(total, 0.0, hard=max(sizes))


def powers() -> Finding:
    """Approach of `C r^k` against `C a^k sqrt(pi) Gamma(k/2+1)/Gamma((k+1)/2)`, k from 1 to 40."""
    worst, orders = 0.0, (1.0, 1.5, 2.0, 4.0, 10.0, 40.0)
    for k in orders:
        expected = 0.3 * 0.1**k * math.sqrt(math.pi) * math.gamma(0.5 * k + 1.0) / math.gamma(0.5 * (k + 1.0))
        worst = max(worst, abs(axisymmetric.approach_at_radius(PowerProfile(0.3, k), 0.1) / expected - 1.0))
    return at_most(worst, 1e-12, hard=max(orders) / min(orders))


def bed_unloaded() -> Finding:
    """Load and pressure of a Winkler bed at load 0."""
    pressure = numpy.ones((5, 4))
    before = (pressure > 0.0).sum()
    result = winkler_at_load(numpy.arange(20, dtype=numpy.float64).reshape(5, 4), 1e7, 0.01, 0.01, 0.0, pressure)
    return exactly(result.load + float(pressure.sum()) + result.cells, 0.0, hard=before)


def stress_in_the_surface() -> Finding:
    """Largest difference of zz + p in the surface, and 1 pm below it, over the peak pressure."""
    pressure = numpy.random.default_rng(4).random((6, 5))
    grid = SurfaceGrid(1e-3, 2e-3, 0.0, 0.0)
    i, j = numpy.meshgrid(numpy.arange(6), numpy.arange(5), indexing="ij")
    worst, depths = 0.0, (0.0, 1e-12)
    for depth in depths:
        points = numpy.column_stack([i.ravel() * 1e-3, j.ravel() * 2e-3, numpy.full(30, depth)])
        worst = max(worst, float(abs(subsurface_stress(grid, 0.5, points, pressure)[:, 2] + pressure.ravel()).max()))
    return at_most(worst, 1e-8, hard=min(depths))


def planes() -> Finding:
    """Relative error of the load that planes below carry: integral of zz under a pressure, of xz
    under a traction.

    In polar coordinates to 300 depths; beyond it a point force still has 1.5 z/R of its shear,
    which is added.
    """
    grid, field, worst = SurfaceGrid(0.1, 0.1, -0.05, -0.05), numpy.ones((2, 2)), 0.0
    for depth in (0.2, 1.0):
        # Gauss points in radius = depth sinh(s): dense over the load, 300 depths wide.
        node, weight = numpy.polynomial.legendre.leggauss(120)
        end, farthest = math.asinh(300.0), 300.0 * depth
        argument = 0.5 * end * (node + 1.0)
        radius, area = depth * numpy.sinh(argument), depth**2 * numpy.sinh(argument) * numpy.cosh(argument)
        angle = numpy.arange(48) / 48 * 2.0 * math.pi
        x, y = radius[:, None] * numpy.cos(angle), radius[:, None] * numpy.sin(angle)
        points = numpy.stack([x.ravel(), y.ravel(), numpy.full(x.size, depth)], axis=1)
        share = numpy.repeat(area * 0.5 * end * weight * 2.0 * math.pi / 48, 48)
        # The load is 4 cells of 0.1 m x 0.1 m under 1 Pa: 0.04 N.
        normal = float(share @ subsurface_stress(grid, 0.3, points, field)[:, 2]) / -0.04
        shear = float(share @ subsurface_stress(grid, 0.3, points, traction_x=field)[:, 4]) / -0.04
        worst = max(worst, abs(normal - 1.0), abs(shear + 1.5 * depth / farthest - 1.0))
    return at_most(worst, 1e-4, hard=farthest / 0.2)


def sites() -> Finding:
    """Sites of roads of a whole number of spacings that are miscounted, 1 to 2000 of 0.1 m."""
    return exactly(
        sum(site_count(0.1 * n, 0.1) != n for n in range(1, 2001)),
        0,
        hard=sum(int(0.1 * n / 0.1) != n for n in range(1, 2001)),
    )


def asperities_off_the_road() -> Finding:
    """Impulses before the first and behind the last site, and at an infinite travel."""
    row = default_asperities(LOAD, 0.05, 0.1, numpy.zeros(20))
    places = (-1.0, 2.0, 1e300, -math.inf, math.inf)
    return exactly(
        sum(float(asperity_force(row, s)) for s in places), 0.0, hard=sum(0.0 <= s <= 2.0 - 0.1 for s in places)
    )


def short_waves() -> Finding:
    """Power of the road above half the lattice's rate over that of the road, cell 0.25 m, 0.1 m
    waves requested.
    """
    shortest, cell = 0.1, 0.25
    road = Iso8608Road(256e-6, 1, 200.0, shortest_wavelength=shortest, lattice_cell=cell)
    x = numpy.arange(8192, dtype=numpy.float64) * (200.0 / 8192)
    heights = road.heights(x, numpy.zeros(1))[:, 0]
    power, wave = abs(numpy.fft.rfft(heights)) ** 2, numpy.fft.rfftfreq(8192, 200.0 / 8192)
    return at_most(float(power[wave > 2.0 + 1e-9].sum() / power[1:].sum()), 1e-12, hard=0.5 * shortest / cell)


def standing() -> Finding:
    """Change of the road under a wheel that stands for 20 blocks."""
    travel = Travel([(0.0, 0.0)])
    blocks = RoadBlocks(Iso8608Road(256e-6, 1, 200.0), travel, 0.01, 0.01, 0.01, 0.2, 5)
    first = blocks.block(0)
    changes = [float(abs(blocks.block(k).height - first.height).max()) for k in range(1, 21)]
    return exactly(max(changes), 0.0, hard=travel.position(0.2))


CASES = (
    HardCase("hertz", "P ~ δ^1.5 over 20 decades, bodies exchanged: relative error", hertz_power,
        guard.scales("loads", 1e20)),
    HardCase("P2 ansatz", "n ≠ 2 where the printed k̄ is no number: corrected k̄ is one", real_eccentricity,
        guard.at_least("domains whose printed k̄ is no number", 6)),
    HardCase("P2 ansatz", "load 0: load, approach and pressure", ansatz_unloaded, guard.zero("load [N]")),
    HardCase("sneddon", "load and approach ≤ 0: radius", profiles_unloaded,
        guard.at_most("load [N] and approach [m]", 0.0)),
    HardCase("sneddon", "r^k, k = 1 to 40: relative error of the approach", powers, guard.scales("powers", 40.0)),
    HardCase("halfspace", "one-cell contact: area, and flagged as not fitted", one_cell_area,
        guard.at_most("loaded cells", 1)),
    HardCase("winkler", "load 0 after a loaded field: load and pressure", bed_unloaded,
        guard.at_least("cells loaded before", 20)),
    HardCase("subsurface", "z → 0: zz + p over the peak", stress_in_the_surface, guard.zero("least depth [m]")),
    HardCase("subsurface", "planes below carry P and Q: relative error", planes, guard.scales("plane and load", 300.0)),
    HardCase("P2 impulses", "N = L/Δx on whole numbers: miscounted", sites,
        guard.at_least("lengths that cutting off miscounts", 1)),
    HardCase("P2 impulses", "off the road: force", asperities_off_the_road, guard.zero("places on the road")),
    HardCase("road", "waves below two cells: share of the power", short_waves,
        guard.below("shortest wave over two cells", 1.0)),
    HardCase("road", "v = 0: change of the heights", standing, guard.zero("distance travelled [m]")),
)  # fmt: skip
