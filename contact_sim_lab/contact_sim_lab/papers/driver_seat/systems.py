"""Systems of *Driver and Seat*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import System

__all__ = ["SYSTEMS"]

SYSTEMS = (
    System("normal slaps of the back on the seat back: force law, works, restitution", "7, 8, 10, 11", "bench run seat_slap"),
    System("normal law F = A δⁿ + B δᵖ sgn(δ̇)|δ̇|^q", "8", "bench run seat_general"),
    System("sticking and sliding of the back", "7, 9", "bench run seat_slip"),
    System(
        "back as a doubly curved thin shell, its modes over the seat back", "3, 6",
        "bench run seat_slap --set effects.backrest.shell_modes={}",
    ),
    System(
        "search for the contact points by the genetic algorithm", "1, 2, text",
        "bench run seat_slap --set effects.backrest.shell_modes={} --set effects.backrest.contact_search={}",
    ),
    System("Lamé domain of the contact: area, parametrisation, fit", "4, 5", "bench paper driver-seat --figure 3"),
)  # fmt: skip
