"""Comparisons with other codes. They are measured against, never depended on."""
