"""Impact laws with friction: one point in the plane, a path in space, many contacts."""
