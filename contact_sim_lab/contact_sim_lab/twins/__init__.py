"""Closed forms and slow, trusted versions of the kernels; they share no code with `core`; for tests
and studies.
"""
