"""Bodies in space and in the plane: parameters, state, free flight, and the contacts that touch."""
