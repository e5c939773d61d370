"""Hard cases of a cushion: 75 % strain, beyond its table, lift-off and landing, a body at rest whose
frame has no mass.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, exactly
from contact_sim_pkg.laws.elastic_law import elastic_energy, elastic_force, elastic_stiffness
from contact_sim_pkg.laws.parameters import FoamElastic, TabulatedElastic
from contact_sim_pkg.pressure.cushion import REACH, VALID_STRAIN
from contact_sim_pkg.pressure.cushion.foam_layer import FoamGrid, FoamLayer
from contact_sim_pkg.pressure.cushion.force_table import make_table
from contact_sim_pkg.records.messages import VibrationBlock
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.seat.occupants import OCCUPANTS
from contact_sim_pkg.run.scene_outputs import outputs_of, records_of
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.run.vibration_drive import VIBRATION
from contact_sim_pkg.scene.resolve import load_resolved

MODEL = "cushion"
GRID = FoamGrid(32, 24, 0.02, 0.02)
FOAM = FoamElastic(1.0, 0.08, 4.5e4, 3.4e3, 80.0, 3.0)
BOUNCING = "vibration={kind: sine, frequency: 4.0, amplitude: 14.0}"
STANDING = "vibration={kind: sine, frequency: 4.0, amplitude: 0.0}"


def _law() -> TabulatedElastic:
    law = build(load_resolved("seat_ride")).rig.seat_contact
    assert law is not None
    assert isinstance(law.elastic, TabulatedElastic)
    return law.elastic


def even_load() -> Finding:
    """Stress of an even load at 75 % strain against the foam's formula: relative error."""
    found = FoamLayer(GRID, FOAM, numpy.zeros((GRID.rows, GRID.cols))).solve(VALID_STRAIN * FOAM.thickness)
    stretch, a, r = 1.0 - VALID_STRAIN, FOAM.modulus / FOAM.plateau, FOAM.densification_exponent
    exact = FOAM.plateau * (1.0 / stretch - stretch ** (a - 1.0))
    exact += FOAM.densification * (stretch ** (-r - 1.0) - 1.0 / stretch)
    return at_most(
        float(numpy.abs(found.pressure / exact - 1.0).max()), 1e-12, hard=float(found.deflection.max()) / FOAM.thickness
    )


def crushed() -> Finding:
    """Answers without sense of a sphere at up to 85 % strain: pressures below 0, overlaps, forces
    that fall.
    """
    x, y = ((numpy.arange(n) - 0.5 * n) * 0.02 for n in (GRID.rows, GRID.cols))
    layer = FoamLayer(GRID, FOAM, (x[:, None] ** 2 + y[None, :] ** 2) / 0.3)
    wrong, before, found = 0, 0.0, None
    for strain in numpy.linspace(0.05, REACH, 17):
        found = layer.solve(float(strain) * FOAM.thickness, found)
        overlap = (found.approach - layer.gap - found.deflection).max()
        wrong += int(found.pressure.min() < 0.0) + int(overlap > 1e-12) + int(found.force <= before)
        before = found.force
    return exactly(wrong, 0, hard=float(strain))


def beyond() -> Finding:
    """Largest jump of force, slope and energy at the end of the table, relative, one part in 1e12
    beyond it.
    """
    law = _law()
    inside, outside = law.reach * (1.0 - 1e-12), law.reach * (1.0 + 1e-12)
    parts = (elastic_force, elastic_stiffness, elastic_energy)
    return at_most(
        max(abs(part(law, outside) / part(law, inside) - 1.0) for part in parts), 1e-9, hard=outside / law.reach
    )


def softens_nowhere() -> Finding:
    """Places of a table, the space between its nodes included, at which the force falls."""
    law = _law()
    places = numpy.linspace(0.0, 1.5 * law.reach, 20001)
    return exactly(sum(elastic_stiffness(law, float(x)) < 0.0 for x in places), 0, hard=places[-1] / law.reach)


def maps() -> Finding:
    """Largest relative difference of map and force over every node and between."""
    x, y = ((numpy.arange(n) - 0.5 * n) * 0.02 for n in (GRID.rows, GRID.cols))
    table = make_table(FoamLayer(GRID, FOAM, (x[:, None] ** 2 + y[None, :] ** 2) / 0.3), spacing=2e-3)
    law, worst = table.law(), 0.0
    for approach in numpy.linspace(1e-6, 1.2 * law.reach, 301):
        force = elastic_force(law, float(approach))
        worst = max(worst, abs(table.map_at(float(approach), force).sum() * table.cell_area / force - 1.0))
    return at_most(worst, 1e-12, hard=approach / law.reach)


def bouncing() -> Finding:
    """Energy residual over the energy turned over, of an occupant that lifts off and lands."""
    found = outputs_of("seat_ride", 2.0, BOUNCING, "integrator.relative_tolerance=1e-8")
    ledger = records_of(found, "bench/energy")[-1]
    forces = numpy.concatenate([block.normal for block in records_of(found, "seat/force")])
    if (forces < 0.0).any():
        return exactly(math.nan, 0.0, hard=(forces == 0.0).sum())
    return at_most(
        abs(ledger.residual) / max(abs(ledger.supplied), ledger.dissipated), 1e-6, hard=(forces == 0.0).sum()
    )


def _standing(model: str) -> float:
    """Largest change of the force of an occupant at rest, over its weight."""
    found = outputs_of("seat_ride", 0.5, STANDING, f"seat.occupant.model={model}")
    forces = numpy.concatenate([block.normal for block in records_of(found, "seat/force")])
    return float(numpy.ptp(forces) / forces[0])


def at_rest() -> Finding:
    """Largest change of the force of an occupant on a floor that stands, over its weight."""
    block = make_sources(load_resolved("seat_ride", STANDING))[VIBRATION].block(3)
    assert isinstance(block, VibrationBlock)
    return at_most(_standing("wei_griffin_2"), 1e-9, hard=float(abs(block.acceleration_z).max()))


def massless_frame() -> Finding:
    """The same where the frame has no mass, so that its place follows from its forces."""
    return at_most(_standing("boileau_rakheja"), 1e-9, hard=OCCUPANTS["boileau_rakheja"].masses[0])


CASES = (
    HardCase(MODEL, "even load at 75 % strain: against the foam", even_load, guard.at_least("strain", 0.75)),
    HardCase(MODEL, "sphere to 85 % strain: answers without sense", crushed, guard.at_least("largest strain", 0.84)),
    HardCase(MODEL, "beyond the table: jump of force, slope, energy", beyond,
        guard.above("approach over the end of the table", 1.0)),
    HardCase(MODEL, "table: places where the force falls", softens_nowhere,
        guard.at_least("approach over the end of the table", 1.5)),
    HardCase(MODEL, "maps at and between nodes: difference to the force", maps,
        guard.at_least("approach over the end of the table", 1.2)),
    HardCase(MODEL, "lift-off and landing: energy residual over turnover", bouncing, guard.contact_lost(50)),
    HardCase(MODEL, "at rest, reversals of rounding: change of force", at_rest,
        guard.zero("largest acceleration of the floor [m/s²]")),
    HardCase(MODEL, "at rest under a massless frame: change of force", massless_frame,
        guard.zero("mass of the frame [kg]")),
)  # fmt: skip
