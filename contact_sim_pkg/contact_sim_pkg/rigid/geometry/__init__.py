"""Gaps and contact rows of a body on its ground."""
