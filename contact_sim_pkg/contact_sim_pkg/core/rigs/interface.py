"""What every rig gives the integrator: four functions that numba picks by the class of the rig's parameter tuple.

``drive`` is what moves the rig during one segment: a tuple of the rig's own with ``start`` and ``length`` in [s]. ``mode`` is its
discrete state, an array or a tuple of arrays. A rig's module registers its implementations with ``register``; the integrator
calls ``rate``, ``margins``, ``switch``, ``margins_need_rate``, and so is written, compiled and cached once per rig and
combination of effects.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..jit import kernel_overload
from ..parameters import Vector

_implementations: dict[type, tuple[Callable[..., Any], ...]] = {}


def rate(rig: Any, drive: Any, mode: Any, time: float, state: Vector, out: Vector) -> None:
    """Write the time derivative of ``state`` at ``time`` into ``out``."""
    _implementations[type(rig)][0](rig, drive, mode, time, state, out)


def margins(rig: Any, drive: Any, mode: Any, time: float, state: Vector, derivative: Vector, out: Vector) -> None:
    """Write the event functions into ``out``: an event is a change of sign of one of them."""
    _implementations[type(rig)][1](rig, drive, mode, time, state, derivative, out)


def switch(rig: Any, drive: Any, mode: Any, time: float, state: Vector, event: int, side: float) -> float:
    """Change ``mode`` and ``state`` where margin number ``event`` has just changed to sign ``side``.

    Returns the sign on which this margin stands from now on: ``side``, or 1 where the margin belongs to a mode that the
    event has ended (it is then another function, positive while the new mode lasts).
    """
    return _implementations[type(rig)][2](rig, drive, mode, time, state, event, side)


def margins_need_rate(rig: Any, mode: Any) -> bool:
    """Whether ``margins`` reads the derivative it is given, in this mode: where not, it need not be worked out."""
    return bool(_implementations[type(rig)][3](rig, mode))


def register(
    rig_class: type,
    rate_of: Callable[..., Any],
    margins_of: Callable[..., Any],
    switch_of: Callable[..., Any],
    need_rate_of: Callable[..., Any],
) -> None:
    """Give the integrator the four kernels of a rig."""
    _implementations[rig_class] = (rate_of, margins_of, switch_of, need_rate_of)


def _kernels_of(rig_type: Any) -> tuple[Callable[..., Any], ...] | None:
    return _implementations.get(getattr(rig_type, "instance_class", None))  # type: ignore[arg-type]


@kernel_overload(rate)
def _rate(rig, drive, mode, time, state, out):
    kernels = _kernels_of(rig)
    if kernels is None:
        return None
    implementation = kernels[0]
    return lambda rig, drive, mode, time, state, out: implementation(rig, drive, mode, time, state, out)


@kernel_overload(margins)
def _margins(rig, drive, mode, time, state, derivative, out):
    kernels = _kernels_of(rig)
    if kernels is None:
        return None
    implementation = kernels[1]
    return lambda rig, drive, mode, time, state, derivative, out: implementation(
        rig, drive, mode, time, state, derivative, out
    )


@kernel_overload(switch)
def _switch(rig, drive, mode, time, state, event, side):
    kernels = _kernels_of(rig)
    if kernels is None:
        return None
    implementation = kernels[2]
    return lambda rig, drive, mode, time, state, event, side: implementation(rig, drive, mode, time, state, event, side)


@kernel_overload(margins_need_rate)
def _margins_need_rate(rig, mode):
    kernels = _kernels_of(rig)
    if kernels is None:
        return None
    implementation = kernels[3]
    return lambda rig, mode: implementation(rig, mode)
