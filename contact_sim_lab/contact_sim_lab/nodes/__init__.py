"""Runs on nodes, seen from outside: how long a block takes, and what the simulator waits for."""
