"""What every rig gives the integrator: functions that numba picks by the class of the rig's parameter tuple.

``drive`` is what moves the rig during one segment: a tuple of the rig's own with ``start`` and ``length`` in [s]. ``mode`` is its
discrete state, an array or a tuple of arrays. A rig's module registers its implementations with ``register``; the integrator
calls ``rate``, ``margins``, ``switch``, ``margins_need_rate`` and, where the rig has it, ``free_flight``, and so is written,
compiled and cached once per rig and combination of effects.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel_overload

_implementations: dict[type, tuple[Callable[..., Any], ...]] = {}
_free_flights: dict[type, Callable[..., Any]] = {}


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


def free_flight(
    rig: Any, drive: Any, mode: Any, time: float, end: float, state: Vector, side: Vector
) -> tuple[float, int]:
    """Cross a stretch without contact force in closed form, where the rig is in one: from ``time`` up to an event or ``end``.

    ``side`` [margins]: the sign on which each event function stands. ``state`` changes in place. Returns the time reached,
    which is ``time`` where the rig is not in free flight, and the number of the event there, -1 where there is none. Event
    functions that matter in contact only may change their sign on the way; the integrator takes their signs again.
    """
    return (
        _free_flights[type(rig)](rig, drive, mode, time, end, state, side) if type(rig) in _free_flights else (time, -1)
    )


def register(
    rig_class: type,
    rate_of: Callable[..., Any],
    margins_of: Callable[..., Any],
    switch_of: Callable[..., Any],
    need_rate_of: Callable[..., Any],
    free_flight_of: Callable[..., Any] | None = None,
) -> None:
    """Give the integrator the kernels of a rig: four that it must have, and the closed form of its free flight if there is one."""
    _implementations[rig_class] = (rate_of, margins_of, switch_of, need_rate_of)
    if free_flight_of is not None:
        _free_flights[rig_class] = free_flight_of


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


@kernel_overload(free_flight)
def _free_flight(rig, drive, mode, time, end, state, side):
    flight = _free_flights.get(getattr(rig, "instance_class", None))  # type: ignore[arg-type]
    if flight is None:
        return lambda rig, drive, mode, time, end, state, side: (time, -1)
    return lambda rig, drive, mode, time, end, state, side: flight(rig, drive, mode, time, end, state, side)
