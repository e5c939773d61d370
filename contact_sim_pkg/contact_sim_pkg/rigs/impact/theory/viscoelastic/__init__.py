"""Creep, relaxation and the hereditary integral of the sample."""
