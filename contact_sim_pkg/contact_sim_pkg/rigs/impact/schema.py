"""Machine, sphere and sample of the impact rig (sphere on a half-space)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, NamedTuple, TypeAlias

from pydantic import Field

from contact_sim_pkg.records.fields import Section, choice, number, numbers

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene

Speed: TypeAlias = Annotated[float, Field(ge=1e-3, le=1000.0)]
Temperature: TypeAlias = Annotated[float, Field(ge=1.0, le=2000.0)]


class SampleMaterial(NamedTuple):
    """What stands behind the name of a material."""

    storage_modulus: float  # [Pa]
    loss_tangent: float
    poisson_ratio: float
    density: float  # [kg/m^3]


MATERIALS: dict[str, SampleMaterial] = {
    "rubber": SampleMaterial(8.0e6, 0.2, 0.499, 1100.0),  # filled rubber at room temperature
    "foam": SampleMaterial(2.0e5, 0.3, 0.1, 60.0),  # polyurethane cushion, small strains
    "steel": SampleMaterial(2.1e11, 0.003, 0.3, 7850.0),
}


class Sample(Section):
    """The half-space. What is not given is that of the material."""

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"

    material: Literal["rubber", "foam", "steel"] = choice("material of the absent values", default="rubber")
    storage_modulus: float | None = number(
        1.0, 1e13, "Pa", "E' of the half-space: rubber 8e6, foam 2e5, steel 2.1e11", default=None
    )
    loss_tangent: float | None = number(
        0.0, 100.0, "", "tan β; acts in normal_dissipative: rubber 0.2, foam 0.3, steel 0.003", default=None
    )
    poisson_ratio: float | None = number(-0.99, 0.5, "", "rubber 0.499, foam 0.1, steel 0.3", default=None)
    density: float | None = number(0.1, 1e5, "kg/m^3", "rubber 1100, foam 60, steel 7850", default=None)
    yield_strength: float | None = number(
        1.0, 1e13, "Pa", "of the softer body: a pressure above 1.60 times it is warned of; by default nothing is",
        default=None,
    )  # fmt: skip
    body_modulus: float | None = number(1.0, 1e13, "Pa", "E' of the sphere; rigid by default", default=None)
    body_loss_tangent: float = number(0.0, 100.0, "", "tan β of the sphere; acts with body_modulus", default=0.0)

    def open_values(self, scene: Scene) -> dict[str, Any]:
        return MATERIALS[self.material]._asdict()


class ImpactSection(Section):
    """A sphere that strikes a sample: drop tower or pendulum, one release or a programme of
    them.
    """

    fixed: ClassVar[str] = "an impact is solved as a whole from its release on"

    machine: Literal["drop", "pendulum"] = choice(
        "drop tower, or pendulum that strikes at its lowest point", default="drop"
    )
    mass: float = number(1e-9, 1e5, "kg", "moving mass: sphere and what it is fixed to", default=0.02)
    radius: float = number(1e-6, 100.0, "m", "radius of the nose", default=0.01)
    gravity: float = number(
        1e-6, 1000.0, "m/s^2", "gravity; acts during contact in the drop tower, not in the pendulum", default=9.81
    )
    arm: float = number(1e-3, 1000.0, "m", "length of the pendulum", default=1.0)
    sample: Sample = Field(default_factory=Sample, description="material of the sample")
    speeds: list[Speed] = numbers(
        "m/s", "impact speed of each release", "1 to 1000 numbers, each 0.001 to 1000 m/s",
        default=[2.0], shortest=1, longest=1000,
    )  # fmt: skip
    temperatures: list[Temperature] = numbers(
        "K", "temperatures of the sample, in turn; at each of them all speeds", "1 to 1000 numbers, each 1 to 2000 K",
        default=[293.15], shortest=1, longest=1000,
    )  # fmt: skip
    repeats: int = number(1, 100000, "", "releases at each temperature and speed", default=1)
    period: float | None = number(
        1e-3,
        3600.0,
        "s",
        "time between releases, fall and impacts included; required for more than one",
        default=None,
    )
    bounces: int = number(
        0, 100000, "", "impacts after which the sphere is caught for the next release; 0: never", default=0
    )
    shape_factor: Literal["small", "iterate"] = choice(
        "k_p of the contact: √2, or √(2 − x_m/R) of each impact", default="small"
    )
    course_samples: int = number(0, 10001, "", "instants of each impact in impact/course; 0: none", default=201)
