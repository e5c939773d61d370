"""The functions of a rig that the integrator calls; numba chooses them by the class of the rig's
parameters.

``drive`` is what moves the rig during one segment: a tuple of the rig's own with ``start`` and
``length`` in [s]. ``mode`` is its discrete state, an array or a tuple of arrays. A rig's module
registers its implementations with ``register_rig``; the integrator calls ``rate``,
``event_functions``, ``mode_transition``, ``event_functions_need_rate`` and, where the rig has it,
``free_flight``, and so is written, compiled and cached once for each rig and combination of
effects.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel_overload

_implementations: dict[type, tuple[Callable[..., Any], ...]] = {}
_free_flights: dict[type, Callable[..., Any]] = {}


def rate(rig: Any, drive: Any, mode: Any, time: float, state: Vector, out: Vector) -> None:
    """Write the time derivative of ``state`` [states] at ``time`` [s] into ``out`` [states], in
    units of the state over s.
    """
    _implementations[type(rig)][0](rig, drive, mode, time, state, out)


def event_functions(
    rig: Any, drive: Any, mode: Any, time: float, state: Vector, derivative: Vector, out: Vector
) -> None:
    """Write the event functions into ``out`` [event functions]: an event is a change of sign of one
    of them.

    ``time`` in [s], ``state`` and its ``derivative`` [states].
    """
    _implementations[type(rig)][1](rig, drive, mode, time, state, derivative, out)


def mode_transition(rig: Any, drive: Any, mode: Any, time: float, state: Vector, event: int, direction: float) -> float:
    """Change ``mode`` and ``state`` in place where event function ``event`` has just changed to
    sign ``direction``.

    ``time`` in [s], ``state`` [states]. Returns the sign of this event function from now on:
    ``direction``, or 1 where it belongs to a mode that the event has ended (it is then another
    function, positive while the new mode lasts).
    """
    return _implementations[type(rig)][2](rig, drive, mode, time, state, event, direction)


def event_functions_need_rate(rig: Any, mode: Any) -> bool:
    """Whether ``event_functions`` reads the derivative in this mode; where not, it need not be
    computed.
    """
    return bool(_implementations[type(rig)][3](rig, mode))


def free_flight(
    rig: Any, drive: Any, mode: Any, time: float, end: float, state: Vector, direction: Vector
) -> tuple[float, int]:
    """Cross a phase without contact force in closed form, where the rig is in one: from ``time``
    [s] to an event or ``end``.

    ``direction`` [event_functions]: sign of each event function. ``state`` changes in place.
    Returns the time reached in [s], which is ``time`` where the rig is not in free flight, and the
    number of the event there, -1 where there is none. Event functions that matter in contact only
    may change their sign on the way; the integrator stores their signs again.
    """
    return (
        _free_flights[type(rig)](rig, drive, mode, time, end, state, direction)
        if type(rig) in _free_flights
        else (time, -1)
    )


def register_rig(
    rig_class: type,
    rate_of: Callable[..., Any],
    event_functions_of: Callable[..., Any],
    mode_transition_of: Callable[..., Any],
    need_rate_of: Callable[..., Any],
    free_flight_of: Callable[..., Any] | None = None,
) -> None:
    """Register the kernels of a rig: four that it must have, and the closed form of its free flight
    if it has one.
    """
    _implementations[rig_class] = (rate_of, event_functions_of, mode_transition_of, need_rate_of)
    if free_flight_of is not None:
        _free_flights[rig_class] = free_flight_of


def _kernels_of(rig_type: Any) -> tuple[Callable[..., Any], ...] | None:
    return _implementations.get(getattr(rig_type, "instance_class", None))  # type: ignore[arg-type]


@kernel_overload(rate, thin=True)
def _rate(rig, drive, mode, time, state, out):
    kernels = _kernels_of(rig)
    if kernels is None:
        return None
    implementation = kernels[0]
    return lambda rig, drive, mode, time, state, out: implementation(rig, drive, mode, time, state, out)


@kernel_overload(event_functions, thin=True)
def _event_functions(rig, drive, mode, time, state, derivative, out):
    kernels = _kernels_of(rig)
    if kernels is None:
        return None
    implementation = kernels[1]
    return lambda rig, drive, mode, time, state, derivative, out: implementation(
        rig, drive, mode, time, state, derivative, out
    )


@kernel_overload(mode_transition, thin=True)
def _mode_transition(rig, drive, mode, time, state, event, direction):
    kernels = _kernels_of(rig)
    if kernels is None:
        return None
    implementation = kernels[2]
    return lambda rig, drive, mode, time, state, event, direction: implementation(
        rig, drive, mode, time, state, event, direction
    )


@kernel_overload(event_functions_need_rate, thin=True)
def _event_functions_need_rate(rig, mode):
    kernels = _kernels_of(rig)
    if kernels is None:
        return None
    implementation = kernels[3]
    return lambda rig, mode: implementation(rig, mode)


@kernel_overload(free_flight, thin=True)
def _free_flight(rig, drive, mode, time, end, state, direction):
    flight = _free_flights.get(getattr(rig, "instance_class", None))  # type: ignore[arg-type]
    if flight is None:
        return lambda rig, drive, mode, time, end, state, direction: (time, -1)
    return lambda rig, drive, mode, time, end, state, direction: flight(rig, drive, mode, time, end, state, direction)
