"""Faults that end a run."""


class RunError(RuntimeError):
    """A run that cannot go on: a guard, a field that does not solve, a missing block. The message
    names block and cause.
    """
