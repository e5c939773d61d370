"""The normal force of a contact: elastic law and loss together, picked by the class of the loss when a rig is compiled.

The loss is ``None``, ``NormalDissipative`` (Hunt and Crossley) or ``GeneralDissipative``. A rig calls ``normal_force`` for the
force, ``tension_margin`` for the event that ends it before the gap opens, ``normal_force_rate`` where friction asks for dF/dt.
``memory_factor`` multiplies the elastic part: 1, or what ``effects/foam_hysteresis.py`` gives.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..jit import kernel, kernel_overload
from ..parameters import ElasticLaw, GeneralDissipative, NormalLoss
from .elastic_law import elastic_force
from .general_dissipative import general_force, general_force_rate, general_tension_margin
from .normal_dissipative import hunt_crossley_force, hunt_crossley_force_rate, hunt_crossley_tension_margin


@kernel
def _margin_without_approach(elastic, dissipative, approach, approach_rate, memory_factor):
    return hunt_crossley_tension_margin(dissipative, approach_rate, memory_factor)


Kernels = tuple[Callable[..., Any], Callable[..., Any], Callable[..., Any]]
_USUAL: Kernels = (hunt_crossley_force, _margin_without_approach, hunt_crossley_force_rate)
_OF_LOSS: dict[Any, Kernels] = {
    GeneralDissipative: (general_force, general_tension_margin, general_force_rate),
}


def normal_force(
    elastic: ElasticLaw,
    dissipative: NormalLoss | None,
    approach: float,
    approach_rate: float,
    memory_factor: float,
) -> float:
    """Force that pushes the bodies apart in [N]; 0 for ``approach <= 0`` [m]. ``approach_rate`` [m/s], closing positive.

    Never negative, but for the general law with the end rule ``gap``.
    """
    force = _OF_LOSS.get(type(dissipative), _USUAL)[0]
    return float(force(elastic, dissipative, approach, approach_rate, memory_factor))


def tension_margin(
    elastic: ElasticLaw,
    dissipative: NormalLoss | None,
    approach: float,
    approach_rate: float,
    memory_factor: float,
) -> float:
    """Event function, positive while the contact carries: its sign change is the loss of contact before the gap opens."""
    margin = _OF_LOSS.get(type(dissipative), _USUAL)[1]
    return float(margin(elastic, dissipative, approach, approach_rate, memory_factor))


def normal_force_rate(
    elastic: ElasticLaw,
    dissipative: NormalLoss | None,
    approach: float,
    approach_rate: float,
    approach_acceleration: float,
    memory_factor: float,
) -> float:
    """dF/dt in [N/s] at ``approach_acceleration`` [m/s^2], ``memory_factor`` held."""
    force_rate = _OF_LOSS.get(type(dissipative), _USUAL)[2]
    return float(force_rate(elastic, dissipative, approach, approach_rate, approach_acceleration, memory_factor))


def pressure_factor(
    elastic: ElasticLaw, dissipative: NormalLoss | None, approach: float, approach_rate: float, memory_factor: float
) -> float:
    """Ratio of the contact force to the elastic one: with it the elastic pressures add up to the force. 1 without contact."""
    if approach <= 0.0:
        return 1.0
    return normal_force(elastic, dissipative, approach, approach_rate, memory_factor) / elastic_force(elastic, approach)


def _kernels_of(loss_type: Any) -> Kernels:
    return _OF_LOSS.get(getattr(loss_type, "instance_class", None), _USUAL)


@kernel_overload(normal_force)
def _normal_force(elastic, dissipative, approach, approach_rate, memory_factor):
    force = _kernels_of(dissipative)[0]
    return lambda elastic, dissipative, approach, approach_rate, memory_factor: force(
        elastic, dissipative, approach, approach_rate, memory_factor
    )


@kernel_overload(tension_margin)
def _tension_margin(elastic, dissipative, approach, approach_rate, memory_factor):
    margin = _kernels_of(dissipative)[1]
    return lambda elastic, dissipative, approach, approach_rate, memory_factor: margin(
        elastic, dissipative, approach, approach_rate, memory_factor
    )


@kernel_overload(normal_force_rate)
def _normal_force_rate(elastic, dissipative, approach, approach_rate, approach_acceleration, memory_factor):
    force_rate = _kernels_of(dissipative)[2]
    return lambda elastic, dissipative, approach, approach_rate, approach_acceleration, memory_factor: force_rate(
        elastic, dissipative, approach, approach_rate, approach_acceleration, memory_factor
    )
