"""Rigs: the rate of change of each rig's state, written as the ordered list of its effects."""
