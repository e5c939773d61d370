"""Columns of a row of samples: forces, approaches and heights at the start of a segment."""

TIRE_NORMAL, TIRE_APPROACH, TIRE_HEIGHT, TIRE_RATE = 0, 1, 2, 3
SEAT_NORMAL, SEAT_TANGENTIAL, SEAT_APPROACH, SEAT_HEIGHT, SEAT_RATE = 4, 5, 6, 7, 8
TIRE_PUSH = 9
BACK_NORMAL, BACK_APPROACH = 10, 11
TIRE_SLOPE = 12  # of the fields: filled in by `run/coupling.py`, as is what follows
TIRE_SHEAR = 13  # and the columns behind it: those of a sample in `tire/brush/belt_motion.py`
FORCES = 21
