"""Elements: what acts between the coordinates of a vehicle, chosen by the class of its parameters.

A rig has a table of masses and a tuple of elements. An element is a tuple of floats and ints (an array only in the
table of a law, since what is passed to a kernel costs by its width); its kernels are registered with
``register_element``, by this package or by another:

* ``act`` adds its forces [N] in the places of the accelerations, writes the rates of its own states, and returns
  ``lost, brought, stored, kept``: the power [W] that it dissipates, that which it brings in from outside, the energy
  [J] that it holds, and what of this is among the losses all the same. So an energy stands where its force stands.
* ``finish`` runs when the accelerations of the table's masses are known, and returns power [W] brought in. An element
  with masses of its own turns the forces on them into rates here.
* ``energies`` returns the kinetic and potential energy [J] of such masses.
* ``events`` writes its event functions, of which there are ``event_count``.
* ``transition`` answers where one of them has changed its sign, as `integrate/interface.mode_transition`. A class that has
  one has a mode, and its ``events`` sees the modes: an array that others need not pay for.
* ``needs_rate`` says whether its events are functions of the rates of the state in this mode.
* ``observe`` writes its columns of the samples (``motion/columns.py``).

``ground``: ``motion/ground.Ground``; state, out, derivative: [states] of the rig. The rates are 0 before the first acts.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel_overload
from contact_sim_pkg.rigs.vehicle.motion.ground import Ground

__all__ = [
    "act",
    "energies",
    "events",
    "events_of",
    "finish",
    "is_registered",
    "need_rate",
    "observe",
    "register_element",
    "transition",
]

Work = tuple[float, float, float, float]
Elements = tuple[Any, ...]


@borrowing_kernel
def _finishes_at_once(element, ground, state, out):
    return 0.0


@borrowing_kernel
def _without_masses(element, gravity, state):
    return 0.0, 0.0


@borrowing_kernel
def _without_events(element, ground, state, first, out):
    pass


@borrowing_kernel
def _without_modes(element, ground, mode, state, event, direction):
    return direction


@borrowing_kernel
def _without_rate(element, mode):
    return False


@borrowing_kernel
def _unobserved(element, ground, mode, state, out):
    pass


class _Kernels(NamedTuple):
    act: Callable[..., Work]
    finish: Callable[..., float]
    events: Callable[..., None]
    event_count: int
    transition: Callable[..., float]
    observe: Callable[..., None]
    energies: Callable[..., tuple[float, float]]
    needs_rate: Callable[..., bool]

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
    energies: Callable[..., tuple[float, float]] = _without_masses,
    needs_rate: Callable[..., bool] = _without_rate,
) -> None:
    """Register the kernels of a class of elements: ``act(element, ground, mode, state, out)``, ``finish(element,
    ground, state, out)``, ``events(element, ground, state, first, out)`` from place ``first`` on,
    ``observe(element, ground, mode, state, out)`` and ``energies(element, gravity, state)``.

    With modes: ``events(element, ground, mode, state, derivative, first, out)``, ``transition(element, ground, mode,
    state, event, direction)`` of its event number ``event``, and ``needs_rate(element, mode)``: only where this is true
    does ``derivative`` belong to ``state``.
    """
    _KERNELS[element_class] = _Kernels(act, finish, events, event_count, transition, observe, energies, needs_rate)


def is_registered(element_class: type) -> bool:
    """Whether tuples of this class are elements."""
    return element_class in _KERNELS


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


def energies(elements: Elements, gravity: float, state: Vector) -> tuple[float, float]:
    """Kinetic and potential energy [J] of masses that elements bring themselves; ``gravity`` [m/s^2]."""
    each = [_KERNELS[type(element)].energies(element, gravity, state) for element in elements]
    return sum(one[0] for one in each), sum(one[1] for one in each)


def events(
    elements: Elements, ground: Ground, mode: Modes, state: Vector, derivative: Vector, first: int, out: Vector
) -> None:
    """Write the event functions of all elements from place ``first`` on into ``out``."""
    for each in elements:
        kernels = _KERNELS[type(each)]
        if kernels.has_modes:
            kernels.events(each, ground, mode, state, derivative, first, out)
        else:
            kernels.events(each, ground, state, first, out)
        first += kernels.event_count


def need_rate(elements: Elements, mode: Modes) -> bool:
    """Whether the event functions of any element depend on the rates of the state."""
    return any(_KERNELS[type(each)].needs_rate(each, mode) for each in elements)


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


def observe(elements: Elements, ground: Ground, mode: Modes, state: Vector, out: Vector) -> None:
    """Write the columns of all elements into ``out``, a row of samples."""
    for each in elements:
        _KERNELS[type(each)].observe(each, ground, mode, state, out)


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


@kernel_overload(energies, thin=True)
def _energies(elements, gravity, state):
    if not any(_KERNELS[each.instance_class].energies is not _without_masses for each in elements):
        return lambda elements, gravity, state: (0.0, 0.0)
    of_first = _kernels_of_first(elements).energies

    def implementation(elements, gravity, state):
        kinetic, potential = of_first(elements[0], gravity, state)
        others = energies(elements[1:], gravity, state)
        return kinetic + others[0], potential + others[1]

    return implementation


@kernel_overload(events, thin=True)
def _events(elements, ground, mode, state, derivative, first, out):
    if not len(elements):
        return lambda elements, ground, mode, state, derivative, first, out: None
    of_first, count = _kernels_of_first(elements).events, _kernels_of_first(elements).event_count

    def implementation(elements, ground, mode, state, derivative, first, out):
        of_first(elements[0], ground, state, first, out)
        events(elements[1:], ground, mode, state, derivative, first + count, out)

    def with_modes(elements, ground, mode, state, derivative, first, out):
        of_first(elements[0], ground, mode, state, derivative, first, out)
        events(elements[1:], ground, mode, state, derivative, first + count, out)

    return with_modes if _kernels_of_first(elements).has_modes else implementation


@kernel_overload(need_rate, thin=True)
def _need_rate(elements, mode):
    if not any(_KERNELS[each.instance_class].needs_rate is not _without_rate for each in elements):
        return lambda elements, mode: False
    of_first = _kernels_of_first(elements).needs_rate

    def implementation(elements, mode):
        return of_first(elements[0], mode) or need_rate(elements[1:], mode)

    return implementation


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
def _observe(elements, ground, mode, state, out):
    if not len(elements):
        return lambda elements, ground, mode, state, out: None
    of_first = _kernels_of_first(elements).observe

    def implementation(elements, ground, mode, state, out):
        of_first(elements[0], ground, mode, state, out)
        observe(elements[1:], ground, mode, state, out)

    return implementation
