"""Energies that are forgotten, one at a time, to see whether the ledger notices (`make mutants MUTANTS=energies`).

Each leaves one term out of a sum that an entry of the ledger is made of.
"""

from tests.mutants.listed import Mutant


def _forgotten(function: str, text: str, becomes: str, part: str) -> Mutant:
    """Noticed with all effects of a ``part`` of the bench together."""
    closes = "test_with_all_effects_the_ledger_closes_and_without_an_energy_it_does_not"
    return Mutant(function, text, becomes, (f"test_energy_closes::{closes}[{part}]",))


ENERGIES = (
    _forgotten("motion/spring._act", "0.5 * spring.stiffness", "0.0 * spring.stiffness", "tire"),
    _forgotten("motion/spring._act", "return spring.damping", "return 0.0 * spring.damping", "tire"),
    _forgotten("motion/spring._drive", "drive_line.mass * ground", "0.0 * ground", "car"),
    _forgotten("motion/road._act", "elastic + hysteresis, hysteresis", "hysteresis, hysteresis", "tire"),
    Mutant("effects/suspension_kernel._act", "0.5 * strut.stiffness", "0.0 * strut.stiffness", ("test_elements",)),
    _forgotten("effects/suspension_kernel._act", "return strut.damping", "return 0.0 * strut.damping", "seat"),
    _forgotten("effects/suspension_kernel._rub", "return force * rate", "return 0.0 * rate", "seat"),
    Mutant("motion/spring._carry", "-mass.mass", "-0.0 * mass.mass", ("test_elements",)),
    Mutant("effects/travel_stops_kernel._act", "lost, 0.0, stored, 0.0", "lost, 0.0, 0.0, 0.0", ("test_elements",)),
    Mutant("effects/travel_stops_kernel._act", "lost, 0.0, stored, 0.0", "0.0, 0.0, stored, 0.0", ("test_elements",)),
    _forgotten("motion/masses._energies_of_masses", "kinetic + 0.5 * mass", "kinetic + 0.0 * mass", "tire"),
    _forgotten("motion/seated._act", " + in_cushion + in_back", " + in_back", "seat"),
    _forgotten("motion/seated._act", " + in_cushion + in_back", " + in_cushion", "occupant"),
    _forgotten("motion/seated._act", "energy_of_links(seat, state) + ", "", "seat"),
    _forgotten("motion/seated._energies", "kinetic + kinetic_along", "0.0 * kinetic + kinetic_along", "seat"),
    _forgotten("motion/seated._act", "lost += rubbed", "lost = rubbed", "seat"),
    _forgotten(
        "motion/seated._act", "lost += contact_lost_power(contact", "lost += 0.0 * contact_lost_power(contact", "seat"
    ),
    _forgotten("backrest/entries.energies", "stored += share * elastic", "stored += 0.0 * elastic", "backrest"),
    _forgotten("ride.TrackRide.energies", "self.heave.load * float", "0.0 * float", "roller heave"),
    _forgotten("theory/motion.energies", "stored = 0.5", "stored = 0.0", "roller"),
    _forgotten("impact/outputs._ledger", "dissipated=heat", "dissipated=0.0 * heat", "impact"),
    _forgotten("located.LocatedBody._collide", ".dissipated[0] += self", ".dissipated[0] += 0.0 * self", "block alone"),
)
