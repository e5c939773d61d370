"""Closed forms and slow, trusted versions of the kernels; they share no code with `core` and serve tests and studies."""
