"""The elastic law of a contact, picked by the class of its parameters when a rig is compiled: power
law, foam or table.

The functions are those of ``laws/normal_elastic.py``, and call them for a ``NormalElastic``; a
``FoamElastic`` and a ``TabulatedElastic`` have their own (``laws/foam_elastic.py``,
``laws/tabulated_elastic.py``). Rigs and dissipative laws call these. Called
from Python they check what they are given: a law within its range (``laws/parameters.py``), an
argument that is a number, a result within the range of numbers; compiled they check nothing.

Source: Driver and Seat eqs 7 and 8.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from contact_sim_pkg.compiled.guards import require, require_positive
from contact_sim_pkg.compiled.jit import kernel_overload
from contact_sim_pkg.laws import foam_elastic as foam
from contact_sim_pkg.laws import normal_elastic as power
from contact_sim_pkg.laws import tabulated_elastic as table
from contact_sim_pkg.laws.parameters import ElasticLaw, FoamElastic, TabulatedElastic

Kernels = tuple[Callable[..., Any], ...]
_POWER: Kernels = (
    power.elastic_force, power.elastic_order, power.elastic_stiffness, power.elastic_energy, power.approach_of_force,
)  # fmt: skip
_OF_LAW: dict[Any, Kernels] = {
    FoamElastic: (
        foam.foam_force, foam.foam_order, foam.foam_stiffness, foam.foam_energy, foam.foam_approach_of_force,
    ),
    TabulatedElastic: (
        table.tabulated_force, table.tabulated_order, table.tabulated_stiffness, table.tabulated_energy,
        table.tabulated_approach_of_force,
    ),
}  # fmt: skip


def elastic_force(elastic: ElasticLaw, approach: float) -> float:
    """Force that pushes the bodies apart in [N] at ``approach`` in [m]; 0 for ``approach <= 0``."""
    check_elastic(elastic)
    require("approach [m]", approach, infinite=True)
    value = float(_OF_LAW.get(type(elastic), _POWER)[0](elastic, approach))
    require("elastic_force of this law", value)
    return value


def elastic_order(elastic: ElasticLaw) -> float:
    """Power [1] of the approach with which the force begins at first contact."""
    check_elastic(elastic)
    return float(_OF_LAW.get(type(elastic), _POWER)[1](elastic))


def elastic_stiffness(elastic: ElasticLaw, approach: float) -> float:
    """Slope dF/dx in [N/m] at ``approach`` in [m]; 0 for ``approach <= 0``."""
    check_elastic(elastic)
    require("approach [m]", approach, infinite=True)
    value = float(_OF_LAW.get(type(elastic), _POWER)[2](elastic, approach))
    require("elastic_stiffness of this law", value)
    return value


def elastic_energy(elastic: ElasticLaw, approach: float) -> float:
    """Energy stored at ``approach`` in [J]; 0 for ``approach <= 0``."""
    check_elastic(elastic)
    require("approach [m]", approach, infinite=True)
    value = float(_OF_LAW.get(type(elastic), _POWER)[3](elastic, approach))
    require("elastic_energy of this law", value)
    return value


def approach_of_force(elastic: ElasticLaw, force: float) -> float:
    """Approach in [m] at which the law gives ``force`` in [N]; 0 for ``force <= 0``."""
    check_elastic(elastic)
    require("force [N]", force)
    value = float(_OF_LAW.get(type(elastic), _POWER)[4](elastic, force))
    require("approach_of_force of this law", value)
    return value


def check_elastic(elastic: ElasticLaw) -> None:
    """Raises ValueError where a parameter of the law is outside its range."""
    if isinstance(elastic, FoamElastic):
        for name in ("area", "thickness", "modulus", "plateau", "densification_exponent"):
            require_positive(f"foam {name}", getattr(elastic, name))
        if not 0.0 <= elastic.densification < math.inf or not elastic.modulus > elastic.plateau:
            raise ValueError(
                f"foam densification is {elastic.densification} Pa, modulus {elastic.modulus} Pa and plateau {elastic.plateau} "
                "Pa: the first must be 0 or above, the modulus above the plateau"
            )
    elif isinstance(elastic, TabulatedElastic):
        require_positive("table spacing", elastic.spacing)
    else:
        require_positive("elastic coefficient", elastic.coefficient)
        require_positive("elastic exponent", elastic.exponent)


def _kernels_of(law_type: Any) -> Kernels:
    return _OF_LAW.get(getattr(law_type, "instance_class", None), _POWER)


@kernel_overload(elastic_force)
def _elastic_force(elastic, approach):
    force = _kernels_of(elastic)[0]
    return lambda elastic, approach: force(elastic, approach)


@kernel_overload(elastic_order)
def _elastic_order(elastic):
    order = _kernels_of(elastic)[1]
    return lambda elastic: order(elastic)


@kernel_overload(elastic_stiffness)
def _elastic_stiffness(elastic, approach):
    stiffness = _kernels_of(elastic)[2]
    return lambda elastic, approach: stiffness(elastic, approach)


@kernel_overload(elastic_energy)
def _elastic_energy(elastic, approach):
    energy = _kernels_of(elastic)[3]
    return lambda elastic, approach: energy(elastic, approach)


@kernel_overload(approach_of_force)
def _approach_of_force(elastic, force):
    approach_at = _kernels_of(elastic)[4]
    return lambda elastic, force: approach_at(elastic, force)
