"""The normal force of a contact: elastic law and dissipation together, picked by the class of the
dissipation when a rig is compiled.

The dissipation is ``None``, ``NormalDissipative`` (Hunt and Crossley) or ``GeneralDissipative``. A
rig calls ``normal_force`` for the force, ``tension_event`` for the event that ends it before the
gap opens, ``normal_force_rate`` where friction needs dF/dt. ``hysteresis_factor`` multiplies the
elastic part: 1, or what ``laws/foam_hysteresis.py`` gives. Called from Python they raise ValueError
for a law outside its range, an argument that is nan, and a result beyond the range of numbers.

Source: Driver and Seat eqs 7 and 8.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from contact_sim_pkg.compiled.guards import require, require_not_negative
from contact_sim_pkg.compiled.jit import entry, kernel, kernel_overload
from contact_sim_pkg.laws.elastic_law import check_elastic, elastic_force
from contact_sim_pkg.laws.general_dissipative import general_force, general_force_rate, general_tension_event
from contact_sim_pkg.laws.normal_dissipative import (
    hunt_crossley_force,
    hunt_crossley_force_rate,
    hunt_crossley_tension_event,
)
from contact_sim_pkg.laws.parameters import ElasticLaw, GeneralDissipative, NormalDissipation


@kernel
def _event_without_approach(elastic, dissipative, approach, approach_rate, hysteresis_factor):
    return hunt_crossley_tension_event(dissipative, approach_rate, hysteresis_factor)


Kernels = tuple[Callable[..., Any], Callable[..., Any], Callable[..., Any]]
_USUAL: Kernels = (hunt_crossley_force, _event_without_approach, hunt_crossley_force_rate)
_OF_DISSIPATION: dict[Any, Kernels] = {
    GeneralDissipative: (general_force, general_tension_event, general_force_rate),
}


def normal_force(
    elastic: ElasticLaw,
    dissipative: NormalDissipation | None,
    approach: float,
    approach_rate: float,
    hysteresis_factor: float,
) -> float:
    """Force that pushes the bodies apart in [N]; 0 for ``approach <= 0`` [m]. ``approach_rate``
    [m/s], closing positive.

    Never negative, but for the general law with the end rule ``gap``.
    """
    _check(elastic, dissipative, approach, approach_rate, hysteresis_factor)
    value = float(
        _OF_DISSIPATION.get(type(dissipative), _USUAL)[0](
            elastic, dissipative, approach, approach_rate, hysteresis_factor
        )
    )
    # A law may overflow within the allowed range of its arguments
    require("force [N] of this law", value)
    return value


def tension_event(
    elastic: ElasticLaw,
    dissipative: NormalDissipation | None,
    approach: float,
    approach_rate: float,
    hysteresis_factor: float,
) -> float:
    """Event function, positive while the contact carries: its sign change is the loss of contact
    before the gap opens.

    approach: [m]; approach_rate: [m/s], closing positive; hysteresis_factor: [1].
    """
    _check(elastic, dissipative, approach, approach_rate, hysteresis_factor)
    margin = _OF_DISSIPATION.get(type(dissipative), _USUAL)[1]
    return float(margin(elastic, dissipative, approach, approach_rate, hysteresis_factor))


def normal_force_rate(
    elastic: ElasticLaw,
    dissipative: NormalDissipation | None,
    approach: float,
    approach_rate: float,
    approach_acceleration: float,
    hysteresis_factor: float,
) -> float:
    """dF/dt in [N/s] at ``approach_acceleration`` [m/s^2], ``hysteresis_factor`` held."""
    _check(elastic, dissipative, approach, approach_rate, hysteresis_factor)
    require("approach acceleration [m/s^2]", approach_acceleration, infinite=True)
    force_rate = _OF_DISSIPATION.get(type(dissipative), _USUAL)[2]
    value = float(force_rate(elastic, dissipative, approach, approach_rate, approach_acceleration, hysteresis_factor))
    require("rate of the force [N/s] of this law", value)
    return value


def pressure_factor(
    elastic: ElasticLaw,
    dissipative: NormalDissipation | None,
    approach: float,
    approach_rate: float,
    hysteresis_factor: float,
) -> float:
    """Ratio of the contact force to the elastic one: with it the elastic pressures add up to the
    force.

    1 without contact, and where the approach is so small that the elastic force underflows to 0.
    approach: [m]; approach_rate: [m/s], closing positive; the result: [1].
    """
    _check(elastic, dissipative, approach, approach_rate, hysteresis_factor)
    return factor_of(elastic, dissipative, approach, approach_rate, hysteresis_factor)


@entry
def factor_of(
    elastic: ElasticLaw,
    dissipative: NormalDissipation | None,
    approach: float,
    approach_rate: float,
    hysteresis_factor: float,
) -> float:
    """See ``pressure_factor``; checks nothing."""
    spring = elastic_force(elastic, approach)
    return (
        normal_force(elastic, dissipative, approach, approach_rate, hysteresis_factor) / spring if spring > 0.0 else 1.0
    )


def check_dissipation(dissipative: NormalDissipation | None) -> None:
    """Raises ValueError where a parameter of the dissipation is outside its range."""
    if isinstance(dissipative, GeneralDissipative):
        require_not_negative("dissipation coefficient", dissipative.coefficient)
        require("approach exponent p", dissipative.approach_exponent, least=0.0, most=4.0)
        require("rate exponent q", dissipative.rate_exponent, least=0.0, most=3.0)
        require_not_negative("smoothing speed [m/s]", dissipative.smoothing_speed)
        if dissipative.lowest_force not in (0.0, -math.inf):
            raise ValueError(f"lowest force is {dissipative.lowest_force} N, it must be 0 or -inf")
    elif dissipative is not None:
        require_not_negative("damping [s/m]", dissipative.damping)


def _check(
    elastic: ElasticLaw,
    dissipative: NormalDissipation | None,
    approach: float,
    approach_rate: float,
    hysteresis_factor: float,
) -> None:
    check_elastic(elastic)
    check_dissipation(dissipative)
    require("approach [m]", approach, infinite=True)
    require("approach rate [m/s]", approach_rate, infinite=True)
    require("hysteresis factor", hysteresis_factor, least=0.0, most=2.0)


def _kernels_of(dissipation_type: Any) -> Kernels:
    return _OF_DISSIPATION.get(getattr(dissipation_type, "instance_class", None), _USUAL)


@kernel_overload(normal_force)
def _normal_force(elastic, dissipative, approach, approach_rate, hysteresis_factor):
    force = _kernels_of(dissipative)[0]
    return lambda elastic, dissipative, approach, approach_rate, hysteresis_factor: force(
        elastic, dissipative, approach, approach_rate, hysteresis_factor
    )


@kernel_overload(tension_event)
def _tension_event(elastic, dissipative, approach, approach_rate, hysteresis_factor):
    margin = _kernels_of(dissipative)[1]
    return lambda elastic, dissipative, approach, approach_rate, hysteresis_factor: margin(
        elastic, dissipative, approach, approach_rate, hysteresis_factor
    )


@kernel_overload(normal_force_rate)
def _normal_force_rate(elastic, dissipative, approach, approach_rate, approach_acceleration, hysteresis_factor):
    force_rate = _kernels_of(dissipative)[2]
    return lambda elastic, dissipative, approach, approach_rate, approach_acceleration, hysteresis_factor: force_rate(
        elastic, dissipative, approach, approach_rate, approach_acceleration, hysteresis_factor
    )
