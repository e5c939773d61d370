"""Longitudinal profiles of roads: heights over the distance, on one track or two."""
