"""Work-precision studies of the tire, and the problems that they solve."""
