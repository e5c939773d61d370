"""Blocks, windows, peers and progress: the protocol between the nodes."""
