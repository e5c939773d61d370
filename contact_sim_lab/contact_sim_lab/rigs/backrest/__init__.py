"""Accuracy studies and hard cases of the backrest."""
