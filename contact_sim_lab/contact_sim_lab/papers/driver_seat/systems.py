"""Systems of *Driver and Seat*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import Parameter, System

__all__ = ["SYSTEMS"]

SYSTEMS = (
    System("normal slaps of the back on the seat back: force law, works, restitution",
           (("7, 8", "backrest/force: approach, normal"),
            ("10, 11", "bench/episodes: compression_work, restitution_work, restitution")),
           "bench run seat_slap"),
    System("normal law F = A δⁿ + B δᵖ sgn(δ̇)|δ̇|^q", (("8", "backrest/force: approach, normal"),), "bench run seat_general"),
    System("sticking and sliding of the back", (("7, 9", "backrest/force: tangential"),), "bench run seat_slip"),
    System(
        "back as a doubly curved thin shell, its modes over the seat back", (("6", "bench/motion: position.mode_1_1_x"),),
        "bench run seat_shell --set effects.backrest.contact_search=null",
    ),
    System("search for the contact point of the bent shell at every step", (("1", "backrest/points: x, y, approach"),),
           "bench run seat_shell"),
    System("Lamé domain of the contact: area, parametrisation, fit", (("4", "Lamé exponent n"),),
           "bench paper driver-seat --figure 3"),
    System(
        "minimum distance or interference of two bodies of one's own, by the genetic algorithm too", (("1", "distance_m"),),
        "bench paper driver-seat --system distance examples/papers/distance.yaml", name="distance",
        run="contact_sim_lab.papers.driver_seat.system_distance:distance",
        input="a YAML file with body_1 and body_2, as examples/papers/distance.yaml",
        parameters=(Parameter("seed", "", 1, least=0, most=2**31, help="of the genetic search"),),
    ),
    System(
        "cnoidal ansatz fitted to a motion of one's own", (("12, 13", "residual"), ("A1-A6", "m, B, A5_difference")),
        "bench paper driver-seat --system cnoidal BAG", name="cnoidal",
        run="contact_sim_lab.papers.driver_seat.system_cnoidal:cnoidal",
        input="a bag of the bench, or a CSV file with columns time, value, as examples/papers/cnoidal.csv",
        parameters=(
            Parameter("contact", "", "backrest", choices=("backrest", "seat", "tire", "impact", "roller"), help="of a bag"),
            Parameter("column", "", "approach", choices=("approach", "normal", "tangential"), help="of its force"),
            Parameter("frequency", "Hz", 0.0, least=0.0, most=1e6, help="of the motion; 0: of its strongest line"),
            Parameter("terms", "", 2, least=1, most=4, help="terms N of each sum"),
        ),
    ),
)  # fmt: skip
