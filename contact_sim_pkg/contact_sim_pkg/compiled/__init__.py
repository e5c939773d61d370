"""Compile options, the cache of kernels on disk, array types and small dense algebra. All kernels
are decorated here.
"""
