"""Accuracy studies, goals and hard cases of the impact."""
