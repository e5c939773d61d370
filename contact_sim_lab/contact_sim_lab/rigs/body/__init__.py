"""Accuracy studies, goals and hard cases of the rigid body."""
