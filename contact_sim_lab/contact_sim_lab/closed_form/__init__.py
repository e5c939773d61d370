"""Closed forms of a pressure that only papers and studies use: Lamé domains, axisymmetric profiles."""
