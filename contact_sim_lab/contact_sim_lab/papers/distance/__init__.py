"""Distance and interference of convex bodies (Driver and Seat, eqs 1 and 2)."""
