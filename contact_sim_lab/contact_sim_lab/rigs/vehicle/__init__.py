"""Accuracy studies and hard cases of tire, seat and car."""
