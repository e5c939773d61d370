"""Cushions of the tests: foams of pan and back, their cells, and a table's point under a load."""

import numpy

from contact_sim_pkg.laws.elastic_law import approach_of_force
from contact_sim_pkg.laws.parameters import FoamElastic
from contact_sim_pkg.pressure.cushion.foam_layer import FoamGrid, FoamLayer
from contact_sim_pkg.pressure.cushion.force_table import make_table
from contact_sim_pkg.pressure.cushion.sitter import PERCENTILES, LumbarSupport, back_gap, pan_gap

PAN = FoamElastic(1.0, 0.08, 45e3, 3.4e3, 80.0, 3.0)
BACK = FoamElastic(1.0, 0.05, 30e3, 2.2e3, 60.0, 3.0)
SENSITIVITY = 500.0  # [Pa] above which a cell counts as loaded


def pan_layer(percentile=50, cell=0.01, foam=PAN, shear_share=0.3, tilt=0.0):
    x = numpy.arange(-0.24, 0.48 - cell / 2, cell)
    y = (numpy.arange(round(0.64 / cell)) + 0.5) * cell - 0.32
    gap = pan_gap(PERCENTILES[percentile], x, y, tilt)
    return FoamLayer(FoamGrid(len(x), len(y), cell, cell), foam, gap, shear_share)


def back_layer(percentile=50, support=0.0):
    x = (numpy.arange(72) + 0.5) * 0.01 - 0.06
    y = (numpy.arange(52) + 0.5) * 0.01 - 0.26
    gap = back_gap(PERCENTILES[percentile], LumbarSupport(support), x, y)
    return FoamLayer(FoamGrid(72, 52, 0.01, 0.01), BACK, gap)


def under(layer, load):
    """The layer's solution at a load [N]."""
    law = make_table(layer, spacing=2e-3).law()
    found = layer.solve(float(approach_of_force(law, load)))
    for _ in range(6):
        found = layer.solve(found.approach + (load - found.force) / layer.tangent(found), found)
    return found


def figures(layer, found):
    """Sink [mm], stiffness [kN/m], area [cm^2], peak and mean [kPa]."""
    loaded = found.pressure[found.pressure > SENSITIVITY]
    area = len(loaded) * layer.grid.cell_area
    return {
        "sink": 1e3 * found.approach, "stiffness": layer.tangent(found) / 1e3, "area": 1e4 * area,
        "peak": loaded.max() / 1e3, "mean": loaded.mean() / 1e3,
    }  # fmt: skip
