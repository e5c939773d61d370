"""Motions and wrenches from bags of any origin."""
