"""Frames that messages are given in."""

BENCH_FRAME = "bench"
TIRE_FRAME = "tire_contact"
SEAT_FRAME = "seat_contact"
BACKREST_FRAME = "backrest_contact"
IMPACT_FRAME = "impact_contact"
BLOCK_FRAME = "block_contact"
ROLLER_FRAME = "roller_contact"
