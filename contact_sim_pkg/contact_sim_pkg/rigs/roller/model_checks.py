"""Roller scenes that cannot run, seen before the run: no ellipse, a contact larger than the bodies, no static angles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from contact_sim_pkg.pressure.closed_form.hertz import HertzError
from contact_sim_pkg.rigs.roller.theory.ellipse import principal_curvatures
from contact_sim_pkg.rigs.roller.theory.motion import LARGEST_TILT
from contact_sim_pkg.rigs.roller.theory.parameters import Curvatures
from contact_sim_pkg.rigs.roller.theory.stability import RollerError, linearise
from contact_sim_pkg.scene.errors import Fault, SceneError

if TYPE_CHECKING:
    from contact_sim_pkg.rigs.roller.model import RollerModel

__all__ = ["refuse_impossible", "refused"]

LARGEST_SLOPE = 0.5
"""Semi-axis over the radius of the gap along it: Hertz takes the bodies as flat; at 0.5 a circle lies 7 % off its parabola."""


def refused(sentence: str) -> SceneError:
    """The error of a roller that cannot run as a whole."""
    return SceneError([Fault("scene", 0, 0, "roller", sentence)])


def refuse_impossible(model: RollerModel) -> None:
    """Raise SceneError with what is wrong and what to change."""
    for row, load in zip(model.programme.curvatures, model.programme.load, strict=True):
        curvatures = Curvatures(*(float(value) for value in row))
        _refuse_no_ellipse(model, curvatures)
        _refuse_large_contact(model, curvatures, model.contact_load(float(load), curvatures))
    if model.effects.get("tilt_yaw") is not None:
        _refuse_no_static_angles(model)


def _refuse_no_ellipse(model: RollerModel, curvatures: Curvatures) -> None:
    try:
        model.contact(1.0, model.held_yaw, curvatures)
    except HertzError as error:
        raise refused(f"{error}; give profile_radius or shaft_profile_radius a value that is not 0") from None


def _refuse_large_contact(model: RollerModel, curvatures: Curvatures, load: float) -> None:
    contact = model.contact(load, model.held_yaw, curvatures)
    gap = principal_curvatures(curvatures, model.held_yaw)
    bends = (("x", contact.along_x, 2.0 * gap.near_x), ("y", contact.along_y, 2.0 * gap.near_y))
    for axis, semi_axis, curvature in bends:
        if not semi_axis * curvature <= LARGEST_SLOPE:
            raise refused(
                f"under {load:.6g} N the contact reaches {semi_axis:.4g} m nearly along {axis}, more than {LARGEST_SLOPE:g} of the "
                f"radius of {1.0 / curvature:.4g} m that both bodies have there together: no contact of nearly flat bodies; give "
                "a lower load, larger radii or a larger young_modulus"
            )


def _refuse_no_static_angles(model: RollerModel) -> None:
    """Under the load at the start."""
    curvatures = Curvatures(*(float(value) for value in model.programme.curvatures[0]))
    load = model.contact_load(float(model.programme.load[0]), curvatures)
    try:
        linear = linearise(model.roller, curvatures, model.bending, model.modulus, load)
    except RollerError as error:
        about_y = model.roller.stiffness_tilt - load * model.roller.radius
        raise refused(
            f"{error}; stiffness_tilt less load times radius is {about_y:.6g} N m/rad, stiffness_yaw "
            f"{model.roller.stiffness_yaw:.6g} N m/rad: neither may be 0; give stiffer springs or another load, or "
            "leave tilt_yaw out"
        ) from None
    if not abs(linear.tilt) <= LARGEST_TILT:
        raise refused(
            f"under {load:.6g} N the static tilt is {linear.tilt:.4g} rad, the roller tips over at {LARGEST_TILT:g} rad; give a "
            "stiffer stiffness_tilt, a lower load or less bending, or leave tilt_yaw out"
        )
