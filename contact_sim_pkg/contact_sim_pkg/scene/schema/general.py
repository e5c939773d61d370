"""Keys of every scene beside its rig: rates of the outputs, time integration, limits."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Literal, TypeAlias

from contact_sim_pkg.memory import LIMIT
from contact_sim_pkg.records.fields import Section, choice, number
from contact_sim_pkg.records.registry import regime_names

if TYPE_CHECKING:
    RegimeName: TypeAlias = str
else:
    RegimeName = Literal[regime_names()]


class Outputs(Section):
    """How often each kind of output is written; each rate gives a whole number of samples a
    block.
    """

    fixed: ClassVar[str] = "the messages of a topic have one rate in a run"

    force_rate: float = number(1.0, 1e6, "Hz", "forces and motions, one message a block", default=1000.0)
    display_rate: float = number(1.0, 1e4, "Hz", "wrenches and scalars for plotters", default=100.0)
    field_rate: float = number(1.0, 1e4, "Hz", "pressure fields", default=100.0)
    loaded_pressure: float = number(
        0.0,
        1e9,
        "Pa",
        "above it a cell counts as loaded in the metrics of maps, as with a mat's threshold",
        default=1.0,
    )


class Integrator(Section):
    """Time integration."""

    fixed: ClassVar[str] = "the error of a run is that of one tolerance"

    relative_tolerance: float | None = number(
        1e-13, 1e-2, "", "local error of a step relative to the state; taken from accuracy when absent", default=None
    )
    coupling_tolerance: float | None = number(
        1e-8,
        1.0,
        "",
        "error of a contact force between two solutions of its pressure field, relative to the standing load: it sets how often"
        " the fields are solved; less than the field's own tolerance counts as that; taken from accuracy when absent",
        default=None,
    )
    coupling_length: float | None = number(
        1e-4,
        10.0,
        "m",
        "longest way that a tire rolls from one solution of its pressure field to the next; when absent the run measures what"
        " its steps miss, and how long they may be for accuracy",
        default=None,
    )


class Expect(Section):
    """What the scene is there to show; a run says at its end whether it did."""

    fixed: ClassVar[str] = "what a scene is there to show is judged over the whole run"

    regime: RegimeName = choice("what happens in the run: a regime of the rig", example=regime_names()[0])
    at_least: float | None = number(
        -1e12,
        1e12,
        "unit of the regime",
        "smallest figure that shows it; the regime's own where neither end is given",
        default=None,
    )
    at_most: float | None = number(
        -1e12, 1e12, "unit of the regime", "largest figure that shows it; the regime's own where neither end is given",
        default=None,
    )  # fmt: skip


class Limits(Section):
    """Caps that a scene may raise for itself."""

    fixed: ClassVar[str] = "it is checked before the run"

    memory: float = number(
        0.001, 1024.0, "GiB", "most memory that grids, roads and signals may need together", default=LIMIT
    )
