"""The environment of the rigid bodies' comparison, `.compare-dynamics/`: MuJoCo and PyBullet from their wheels."""

from __future__ import annotations

from pathlib import Path

from comparisons.environment import ROOT, Environment, from_wheels

__all__ = ["ENVIRONMENT"]

ENVIRONMENT = Environment(
    ROOT / ".compare-dynamics",
    Path(__file__).parent,
    {"MuJoCo": from_wheels("requirements_mujoco.txt"), "PyBullet": from_wheels("requirements_pybullet.txt")},
)
