"""Parameter tuples of the force laws.

An effect that a scene does not call for is ``None`` in place of its tuple (decision 0001). SI
units; all numbers are ``float`` unless stated otherwise.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

from contact_sim_pkg.compiled.arrays import Vector


class NormalElastic(NamedTuple):
    """Elastic normal law F = coefficient * approach**exponent."""

    coefficient: float  # [N/m^exponent], > 0
    exponent: float  # 1 (linear) to 3; 3/2 is Hertz


class FoamElastic(NamedTuple):
    """Elastic law of a foam block with plateau and densification (``laws/foam_elastic.py``), in
    place of a power law.
    """

    area: float  # S [m^2], > 0
    thickness: float  # h [m], > 0
    modulus: float  # E_0 [Pa] of the soft start, > plateau
    plateau: float  # p_0 [Pa], > 0
    densification: float  # p_d [Pa], >= 0
    densification_exponent: float  # r, > 0


class TabulatedElastic(NamedTuple):
    """Elastic law by a table of forces, cubic between them (``laws/tabulated_elastic.py``)."""

    spacing: float  # [m] between the approaches of the table, > 0
    pieces: Vector  # [nodes, 5] energy [J], force [N], slope [N/m], second and third coefficient, from each node on

    @property
    def reach(self) -> float:
        """Last approach [m] of the table; beyond it the slope stays."""
        return self.spacing * (len(self.pieces) - 1)


class FoamCurve(NamedTuple):
    """Foam by its measured stress over strain (``laws/foam_columns.py``): the columns of a layer."""

    thickness: float  # h [m] of the layer, > 0
    strain: tuple[float, ...]  # above 0, below 1, rising; the curve begins at (0, 0)
    stress: tuple[float, ...]  # [Pa] at each strain, > 0, rising


LayerFoam: TypeAlias = FoamElastic | FoamCurve
"""What the columns of a foam layer are made of."""

ElasticLaw: TypeAlias = NormalElastic | FoamElastic | TabulatedElastic


class NormalDissipative(NamedTuple):
    """Hunt-Crossley dissipation: the elastic force is multiplied by 1 + damping * approach_rate,
    and never pulls.
    """

    damping: float  # [s/m], >= 0


class GeneralDissipative(NamedTuple):
    """Dissipation of the general law: ``B x**p sgn(x') |x'|**q`` is added to the elastic force
    (``laws/general_dissipative.py``).
    """

    coefficient: float  # B [N/m^p/(m/s)^q], >= 0
    approach_exponent: float  # p, 0 to 4; 0 is a plain damper
    rate_exponent: float  # q, 0 to 3; 1 is linear, 0 dry friction
    # [m/s], 0 for q >= 1; |x'|**(q-1) is evaluated at sqrt(x'^2 + smoothing_speed^2)
    smoothing_speed: float
    lowest_force: (
        # [N], 0: contact is lost where the force reaches 0; -inf: it lasts, pulling, until the gap
        # opens
        float
    )


NormalDissipation: TypeAlias = NormalDissipative | GeneralDissipative


class FoamHysteresis(NamedTuple):
    """Dissipation of foam without rate: an internal variable that follows the loading
    (``laws/foam_hysteresis.py``).
    """

    offset: int  # of the internal variable in the state vector
    # s, 0 to below 1: force over elastic force is 1 + s on a long loading, 1 - s on a long
    # unloading
    share: float
    energy: float  # u_0 [J] over which a reversal is passed, > 0


class Friction(NamedTuple):
    """Spring-damper that sticks, with a Coulomb limit."""

    stiffness: float  # [N/m], > 0
    damping: float  # [N s/m], >= 0
    coefficient_static: float  # ratio of limit to normal force at which sticking ends, > 0
    coefficient_kinetic: float  # ratio while slipping, <= coefficient_static


class Contact(NamedTuple):
    """One contact: the effects that act in it. ``elastic`` is always there, the others may be
    ``None``.
    """

    elastic: ElasticLaw
    dissipative: NormalDissipation | None
    friction: Friction | None
    hysteresis: FoamHysteresis | None = None
