"""Distance and interference of convex bodies (driver-seat paper, eqs 1 and 2)."""
