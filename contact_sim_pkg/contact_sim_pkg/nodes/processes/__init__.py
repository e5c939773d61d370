"""Processes of a run: supervisor, children, folders, shared memory, keys."""
