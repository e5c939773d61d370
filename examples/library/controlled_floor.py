"""A controller on the floor of a seat: each block it reads the force on the seat, and takes a part of what this has beyond
the weight off the acceleration of the floor's next block.
"""

import numpy

from contact_sim_pkg import ContactBench

GAIN = 0.3


def ride(gain: float) -> tuple[float, float]:
    """Standard deviation of the force on the seat [N], and of the floor's acceleration [m/s^2]."""
    bench.reset()
    push, forces, floors = 0.0, [], []
    while not bench.is_over:
        floor = bench.vibration()
        floor[:, 1] -= push
        force = bench.step(vibration=floor)["seat/force"]["normal"]
        push = gain * (force[-1] - weight) / (weight / 9.81)
        forces.append(force)
        floors.append(floor[:-1, 1])
    return float(numpy.std(numpy.concatenate(forces))), float(numpy.std(numpy.concatenate(floors)))


bench = ContactBench("seat_ride", "duration=10")
weight = bench.step(vibration=0.0 * bench.vibration())["seat/force"]["normal"][0]
for name, gain in (("held", 0.0), ("controlled", GAIN)):
    force, floor = ride(gain)
    print(f"{name:10s} force on the seat ± {force:5.2f} N, floor ± {floor:.3f} m/s²")
