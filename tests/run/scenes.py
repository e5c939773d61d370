"""Small scenes for the tests of runs: resolved, and short."""

from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import ResolvedScene, resolve

FRICTIONLESS = ("effects.backrest.friction=null", "backrest.sliding=null")
"""Takes friction, and what acts through it, out of a scene of a back."""


def resolved(name: str, *assignments: str) -> ResolvedScene:
    """A shipped scene with values changed as by ``--set a.b=value``."""
    return resolve(load_scene(name, [set_value(assignment) for assignment in assignments]))
