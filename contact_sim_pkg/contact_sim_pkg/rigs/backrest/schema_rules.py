"""Rules that tie keys of the backrest together."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.rigs.backrest.schema import (
    BackCushion,
    BackFriction,
    BackrestSection,
    ContactSearchSection,
    ShellModesSection,
)
from contact_sim_pkg.rigs.backrest.shell import MODE_COUNTS, STEEPEST, THICKEST
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show
from contact_sim_pkg.scene.schema.law_rules import unused
from contact_sim_pkg.scene.schema.scene import Scene

MOST_SEARCHED = 9
"""Modes with which the nearest point of the back moves without jumps; with 25 the energy no longer
balances (0.6 % seen).
"""


def backrest_breaches(scene: Scene) -> Iterator[Breach]:
    """A shell that is not thin or not shallow, modes that are not offered, sliding without
    friction, the shape of a back beside a cushion.
    """
    backrest = scene.section(BackrestSection)
    if backrest.sliding.amplitude > 0.0 and scene.effect("backrest", BackFriction) is None:
        sentence = f"{show(backrest.sliding.amplitude)} m act through friction, which the scene does not name; add it"
        yield Breach("backrest.sliding.amplitude", sentence, ("effects.backrest",))
    if backrest.angle is not None and scene.rig == "backrest":
        yield Breach("backrest.angle", "acts where a pan carries the occupant too, in the rig occupant", ("rig",))
    if scene.rig == "backrest" and scene.vibration is not None and "x" not in scene.vibration.axes:
        yield Breach("vibration.axis", "a seat back is shaken forward; set axis: x", ("rig",))
    if scene.effect("backrest", BackCushion) is not None:
        sentence = "does not act on a cushion, which has the back of its percentile and cells of its own; remove it"
        for name, section in (("back", backrest.back), ("mat", backrest.mat)):
            yield from unused(f"backrest.{name}", section, sentence, ("effects.backrest.cushion",))
    # Limits of the shell: number of modes, thickness, curvature.
    shell = scene.effect("backrest", ShellModesSection)
    if shell is None:
        return
    where = "effects.backrest.shell_modes"
    if scene.effect("backrest", ContactSearchSection) is not None and shell.modes > MOST_SEARCHED:
        sentence = (
            f"with {shell.modes} modes several bumps of the back touch at once, which one moving point does not see; "
            f"allowed with contact_search are 1, 4 and {MOST_SEARCHED}"
        )
        yield Breach(f"{where}.modes", sentence, ("effects.backrest.contact_search",))
    if shell.modes not in MODE_COUNTS:
        yield Breach(f"{where}.modes", f"{shell.modes} modes are not offered; allowed are 1, 4, 9 and 25")
    shorter = min(backrest.back.width, backrest.back.height)
    if shell.thickness > THICKEST * shorter:
        sentence = (
            f"{show(shell.thickness)} m is above {show(THICKEST)} of the shorter side ({show(shorter)} m); "
            "such a back is no thin shell"
        )
        yield Breach(f"{where}.thickness", sentence, ("backrest.back",))
    for side, radius in (("width", "radius_across"), ("height", "radius_up")):
        length = getattr(backrest.back, side)
        least = length / (8.0 * STEEPEST)
        if getattr(backrest.back, radius) < least * (1.0 - 1e-9):  # as it is printed, it is enough
            given = getattr(backrest.back, radius)
            sentence = (
                f"{show(given)} m is below {show(least)} m, where a shell of {show(length)} m is no longer shallow"
            )
            yield Breach(f"backrest.back.{radius}", sentence, (f"backrest.back.{side}",))
