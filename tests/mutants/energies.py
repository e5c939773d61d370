"""Energies that are forgotten, one at a time, to see whether the ledger notices (`make mutants MUTANTS=energies`).

Each leaves one term out of a sum that an entry of the ledger is made of.
"""

from tests.mutants.listed import Mutant


def _forgotten(function: str, text: str, becomes: str, part: str) -> Mutant:
    """Noticed with all effects of a ``part`` of the bench together."""
    closes = "test_with_all_effects_the_ledger_closes_and_without_an_energy_it_does_not"
    return Mutant(function, text, becomes, (f"test_energy_closes::{closes}[{part}]",))


ENERGIES = (
    _forgotten("motion/entries._energies", "stored += belt_stored", "stored += 0.0 * belt_stored", "tire"),
    _forgotten("motion/entries._energies", "stored += in_tire + ", "stored += ", "tire"),
    _forgotten("motion/entries._energies", "in_tire + in_cushion + in_back", "in_tire + in_back", "seat"),
    _forgotten("motion/entries._energies", "in_cushion + in_back", "in_cushion", "occupant"),
    _forgotten("motion/entries._energies", "stored += seat_stored + ", "stored += ", "seat"),
    _forgotten("motion/entries._energies", "return kinetic + seat_kinetic", "return kinetic", "seat"),
    _forgotten("motion/vehicle._rate", "lost = lost_in_sidewalls", "lost = 0.0 * lost_in_sidewalls", "tire"),
    _forgotten("motion/vehicle._rate", "lost += lost_in_links + rubbed", "lost += rubbed", "seat"),
    _forgotten("motion/vehicle._rate", "lost += tire_rates(", "lost += 0.0 * tire_rates(", "tire"),
    _forgotten(
        "motion/vehicle._rate",
        "lost += contact_lost_power(rig.seat_contact",
        "lost += 0.0 * contact_lost_power(rig.seat_contact",
        "seat",
    ),
    _forgotten("motion/vehicle._rate", "+= body_power(", "+= 0.0 * body_power(", "car"),
    _forgotten("backrest/entries.energies", "stored += share * elastic", "stored += 0.0 * elastic", "backrest"),
    _forgotten("ride.TrackRide.energies", "self.heave.load * float", "0.0 * float", "roller heave"),
    _forgotten("theory/motion.energies", "stored = 0.5", "stored = 0.0", "roller"),
    _forgotten("impact/outputs._ledger", "dissipated=heat", "dissipated=0.0 * heat", "impact"),
    _forgotten("located.LocatedBody._collide", ".dissipated[0] += self", ".dissipated[0] += 0.0 * self", "block alone"),
)
