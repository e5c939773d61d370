"""The rigs of the bench, a folder each: physics, scene keys, outputs, report, studies."""

PACKAGES = tuple(f"{__name__}.{name}" for name in ("vehicle", "backrest", "occupant", "impact", "body", "roller"))
"""Packages that export `RIGS`, in the order of the documentation."""
