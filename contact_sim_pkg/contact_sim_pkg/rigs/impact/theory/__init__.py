"""The impact of a sphere after Goloshchapov: force, motion, restitution, contact time."""
