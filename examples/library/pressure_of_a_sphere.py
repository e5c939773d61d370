"""Pressure under a sphere on a half-space: the solver of the tire beside Hertz."""

import numpy

from contact_sim_pkg.pressure import hertz_contact, make_half_space, make_workspace, solve_at_load

rows, cell, modulus, radius, load = 64, 0.25e-3, 5e6, 0.05, 3.0
half_space = make_half_space(rows, rows, cell, cell, modulus)
x = (numpy.arange(rows) - (rows - 1) / 2) * cell
gap = (x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * radius)
pressure = numpy.zeros((rows, rows))
found = solve_at_load(half_space, make_workspace(half_space), gap, load, 1e-8, 200, pressure)
exact = hertz_contact(0.5 / radius, 0.5 / radius, modulus, load)
print(f"approach {1e3 * found.approach:.4f} mm, by Hertz {1e3 * exact.approach:.4f} mm")
print(f"largest pressure {pressure.max() / 1e3:.1f} kPa, by Hertz {exact.peak_pressure / 1e3:.1f} kPa")
