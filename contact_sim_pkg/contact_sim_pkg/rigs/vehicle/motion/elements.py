"""Elements: what acts between the coordinates of a vehicle, chosen by the class of its parameters.

A rig has a table of masses and a tuple of elements. An element is a tuple of floats and ints (an array only in the
table of a law, since what is passed to a kernel costs by its width); its kernels are registered with
``register_element``, by this package or by another:

* ``act`` adds its forces [N] in the places of the accelerations, writes the rates of its own states, and returns
  ``lost, brought, stored, kept``: the power [W] that it dissipates, that which it brings in from outside, the energy
  [J] that it holds, and what of this is among the losses all the same. So an energy stands where its force stands.
* ``finish`` runs when the accelerations are known, and returns power [W] brought in.
* ``events`` writes its event functions, of which there are ``event_count``.
* ``transition`` answers where one of them has changed its sign, as `integrate/interface.mode_transition`. A class that has
  one has a mode, and its ``events`` sees the modes: an array that others need not pay for.
* ``observe`` writes its columns of the samples (``motion/columns.py``).

``ground``: ``motion/ground.Ground``; state, out, derivative: [states] of the rig.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel_overload
from contact_sim_pkg.rigs.vehicle.motion.ground import Ground

__all__ = ["act", "events", "events_of", "finish", "observe", "register_element", "transition"]

Work = tuple[float, float, float, float]
Elements = tuple[Any, ...]


@borrowing_kernel
def _finishes_at_once(element, ground, state, out):
    return 0.0


@borrowing_kernel
def _without_events(element, ground, state, first, out):
    pass


@borrowing_kernel
def _without_modes(element, ground, mode, state, event, direction):
    return direction


@borrowing_kernel
def _unobserved(element, ground, state, out):
    pass


class _Kernels(NamedTuple):
    act: Callable[..., Work]
    finish: Callable[..., float]
    events: Callable[..., None]
    event_count: int
    transition: Callable[..., float]
    observe: Callable[..., None]

    @property
    def has_modes(self) -> bool:
        """Whether its events depend on a mode."""
        return self.transition is not _without_modes


_KERNELS: dict[type, _Kernels] = {}


def register_element(
    element_class: type,
    act: Callable[..., Work],
    *,
    finish: Callable[..., float] = _finishes_at_once,
    events: Callable[..., None] = _without_events,
    event_count: int = 0,
    transition: Callable[..., float] = _without_modes,
    observe: Callable[..., None] = _unobserved,
) -> None:
    """Register the kernels of a class of elements: ``act(element, ground, mode, state, out)``, ``finish(element,
    ground, state, out)``, ``events(element, ground, state, first, out)`` from place ``first`` on, or with modes
    ``events(element, ground, mode, state, first, out)`` and ``transition(element, ground, mode, state, event, direction)``
    of its event number ``event``, and ``observe(element, ground, state, out)``.
    """
    _KERNELS[element_class] = _Kernels(act, finish, events, event_count, transition, observe)


def events_of(elements: Elements) -> int:
    """Number of the event functions of all elements."""
    return sum(_KERNELS[type(each)].event_count for each in elements)


def act(elements: Elements, ground: Ground, mode: Modes, state: Vector, out: Vector) -> Work:
    """Let all elements act, in their order; returns the sums of ``lost, brought`` [W], ``stored, kept`` [J]."""
    works = [_KERNELS[type(each)].act(each, ground, mode, state, out) for each in elements]
    lost, brought, stored, kept = (sum(values) for values in zip(*works, strict=True)) if works else (0.0,) * 4
    return lost, brought, stored, kept


def finish(elements: Elements, ground: Ground, state: Vector, out: Vector) -> float:
    """What elements do when the accelerations stand in ``out``; returns the power [W] that they bring in."""
    return sum(_KERNELS[type(each)].finish(each, ground, state, out) for each in elements)


def events(elements: Elements, ground: Ground, mode: Modes, state: Vector, first: int, out: Vector) -> None:
    """Write the event functions of all elements from place ``first`` on into ``out``."""
    for each in elements:
        kernels = _KERNELS[type(each)]
        seen = (ground, mode, state) if kernels.has_modes else (ground, state)
        kernels.events(each, *seen, first, out)
        first += kernels.event_count


def transition(elements: Elements, ground: Ground, mode: Modes, state: Vector, event: int, direction: float) -> float:
    """Let the element answer whose event function this is, in the order of all; returns the sign of that function
    from now on.
    """
    for each in elements:
        kernels = _KERNELS[type(each)]
        if event < kernels.event_count:
            return kernels.transition(each, ground, mode, state, event, direction)
        event -= kernels.event_count
    return direction


def observe(elements: Elements, ground: Ground, state: Vector, out: Vector) -> None:
    """Write the columns of all elements into ``out``, a row of samples."""
    for each in elements:
        _KERNELS[type(each)].observe(each, ground, state, out)


def _kernels_of_first(elements: Any) -> _Kernels:
    return _KERNELS[elements[0].instance_class]


@kernel_overload(events_of, thin=True)
def _events_of(elements):
    count = sum(_KERNELS[each.instance_class].event_count for each in elements)
    return lambda elements: count


# Each takes the first element, by its class, and leaves the others to itself.
@kernel_overload(act, thin=True)
def _act(elements, ground, mode, state, out):
    if not len(elements):
        return lambda elements, ground, mode, state, out: (0.0, 0.0, 0.0, 0.0)
    of_first = _kernels_of_first(elements).act

    def implementation(elements, ground, mode, state, out):
        lost, brought, stored, kept = of_first(elements[0], ground, mode, state, out)
        others = act(elements[1:], ground, mode, state, out)
        return lost + others[0], brought + others[1], stored + others[2], kept + others[3]

    return implementation


@kernel_overload(finish, thin=True)
def _finish(elements, ground, state, out):
    if not len(elements):
        return lambda elements, ground, state, out: 0.0
    of_first = _kernels_of_first(elements).finish

    def implementation(elements, ground, state, out):
        brought = of_first(elements[0], ground, state, out)
        return brought + finish(elements[1:], ground, state, out)

    return implementation


@kernel_overload(events, thin=True)
def _events(elements, ground, mode, state, first, out):
    if not len(elements):
        return lambda elements, ground, mode, state, first, out: None
    of_first, count = _kernels_of_first(elements).events, _kernels_of_first(elements).event_count

    def implementation(elements, ground, mode, state, first, out):
        of_first(elements[0], ground, state, first, out)
        events(elements[1:], ground, mode, state, first + count, out)

    def with_modes(elements, ground, mode, state, first, out):
        of_first(elements[0], ground, mode, state, first, out)
        events(elements[1:], ground, mode, state, first + count, out)

    return with_modes if _kernels_of_first(elements).has_modes else implementation


@kernel_overload(transition, thin=True)
def _transition(elements, ground, mode, state, event, direction):
    if not any(_KERNELS[each.instance_class].has_modes for each in elements):
        return lambda elements, ground, mode, state, event, direction: direction
    of_first, count = _kernels_of_first(elements).transition, _kernels_of_first(elements).event_count

    def implementation(elements, ground, mode, state, event, direction):
        if event < count:
            return of_first(elements[0], ground, mode, state, event, direction)
        return transition(elements[1:], ground, mode, state, event - count, direction)

    return implementation


@kernel_overload(observe, thin=True)
def _observe(elements, ground, state, out):
    if not len(elements):
        return lambda elements, ground, state, out: None
    of_first = _kernels_of_first(elements).observe

    def implementation(elements, ground, state, out):
        of_first(elements[0], ground, state, out)
        observe(elements[1:], ground, state, out)

    return implementation
