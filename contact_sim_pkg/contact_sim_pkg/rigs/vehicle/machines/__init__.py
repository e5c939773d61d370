"""Test machines for a tire: the standing press, a flat track, a drum, an axle that is held over a cleat, and the
procedures that are run on them.
"""
