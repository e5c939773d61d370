"""Impact of a sphere on a viscoelastic half-space (Goloshchapov): contact, motion, waves, stresses, materials."""
