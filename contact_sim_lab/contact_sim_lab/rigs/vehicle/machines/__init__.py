"""Test machines for a tire: a flat track, and an axle that is held over a cleat."""
