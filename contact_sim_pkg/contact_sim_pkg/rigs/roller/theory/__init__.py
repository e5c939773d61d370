"""Contact ellipse, motion, stress volumes and wear of the roller."""
