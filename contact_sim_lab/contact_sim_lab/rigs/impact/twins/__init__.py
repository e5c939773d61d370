"""Slow twins of the impact, with which it shares no code."""
