"""The occupant's back and the seat back it leans on (Driver and Seat)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from pydantic import Field

from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.fields import Section, number
from contact_sim_pkg.scene.schema.laws import (
    STIFFEST,
    THICKEST,
    USUAL_PERCENTILE,
    CushionSection,
    FrictionSection,
    GeneralDissipation,
    HuntCrossley,
    PowerLaw,
)

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene

MASS = 45.6  # [kg]
ANGLE = 0.384  # [rad], 22 degrees
SHELL_PRELOAD = 20.0  # [N]; the weight of the mass would bend the default shell by 0.24 m


class Back(Section):
    """Form of the back: a doubly curved surface over a flat seat back, which it touches first in
    its middle.
    """

    fixed: ClassVar[str] = "the form of a back is that of its cells"

    width: float = number(0.05, 5.0, "m", "width of the back", default=0.40)
    height: float = number(0.05, 5.0, "m", "height of the back", default=0.50)
    radius_across: float = number(0.05, 1000.0, "m", "radius of curvature across", default=0.6)
    radius_up: float = number(0.05, 1000.0, "m", "radius of curvature up", default=1.5)


class Sliding(Section):
    """Rigid sliding of the back along the seat back, up and down: amplitude · sin(2π frequency t);
    acts in friction.
    """

    fixed: ClassVar[str] = "another sliding would jump at an instant"

    amplitude: float = number(0.0, 1.0, "m", "amplitude of the displacement; 0: none", default=0.0)
    frequency: float = number(0.0, 1000.0, "Hz", "frequency of the sliding", above=True, default=5.25)


class MatSection(Section):
    """Pressure mat on the seat back: the cells of `backrest/patch`; a shell has the cells of its
    points instead.
    """

    fixed: ClassVar[str] = "its cells are those of the run's maps"

    rows: int = number(4, 256, "", "cells up the back", default=40)
    cols: int = number(4, 256, "", "cells across the back", default=32)


class BackrestSection(Section):
    """Occupant against a seat back that is shaken along its normal (x, forward)."""

    fixed: ClassVar[str] = "the seat back is built once"

    mass: float | None = number(
        0.1, 1000.0, "kg", f"moving mass of the occupant, {MASS:g} by default; replaced by a shell; not in rig occupant",
        default=None, live="law")  # fmt: skip
    angle: float | None = number(
        0.0, 0.6, "rad", f"of the seat back from the vertical; rig occupant alone, {ANGLE:g} by default", default=None
    )
    preload: float | None = number(
        0.0,
        1e6,
        "N",
        "constant force on the seat back; by default mass · 9.81 m/s², 20 N for a shell; in rig occupant 0, the push of the feet",
        default=None,
        live="law",
    )
    back: Back = Field(default_factory=Back, description="shape of the back; of a cushion the percentile is")
    sliding: Sliding = Field(default_factory=Sliding, description="rigid sliding along the seat back")
    mat: MatSection = Field(default_factory=MatSection, description="cells of the pressure map; a cushion has its own")

    def open_values(self, scene: Scene) -> dict[str, Any]:
        if scene.rig == "occupant":
            return {"angle": ANGLE, "preload": 0.0}
        one_mass, mass = scene.effect("backrest", ShellModesSection) is None, self.mass or MASS
        return {"mass": mass, "preload": mass * GRAVITY if one_mass else SHELL_PRELOAD}


class BackElastic(PowerLaw):
    """Elastic force of the back in the seat back: coefficient · approach^exponent, for the whole
    back.
    """

    coefficient: float = number(
        1.0, 1e12, "N/m^exponent", "A; by default 447 N at 14.91 mm: 45.6 kg have 5 Hz", default=2.457e5, live="law"
    )


class BackCushion(CushionSection):
    """Foam of the seat back under a back with its lumbar hollow, in place of normal_elastic: force
    and map from one table.
    """

    thickness: float = number(0.02, THICKEST, "m", "thickness of the unloaded foam", default=0.05)
    modulus: float = number(
        100.0,
        STIFFEST,
        "Pa",
        "Young's modulus of the foam at first contact, above plateau; 20 to 100 kPa",
        default=3.0e4,
    )
    plateau: float = number(
        10.0, 1e5, "Pa", "stress of the plateau; with the other defaults 4.0 kPa at 40 % strain", default=2.2e3
    )
    densification: float = number(0.0, 1e4, "Pa", "stress scale of the densification", default=60.0)
    lumbar_support: float = number(0.0, 0.04, "m", "depth of the bulge under the lumbar spine; 0: none", default=0.0)
    lumbar_height: float = number(
        0.05, 0.4, "m", "height of its middle over the lower edge of the seat back", default=0.20
    )

    def open_values(self, scene: Scene) -> dict[str, Any]:
        # The rig occupant has the person on its seat too.
        occupant = getattr(getattr(scene, "seat", None), "occupant", None)
        percentile = getattr(occupant, "percentile", None) or USUAL_PERCENTILE
        return {**super().open_values(scene), "percentile": percentile}


class BackLoss(HuntCrossley):
    """Hunt-Crossley loss: elastic force · (1 + damping · approach rate), never pulling; or
    `restitution` at a speed.
    """

    usual_damping = 1.949743421626532

    damping: float | None = number(
        0.0, 100.0, "s/m", "λ; 1.9497 by default: restitution 0.6 at 0.5 m/s", default=None, live="law"
    )


class BackGeneralDissipation(GeneralDissipation):
    """General law of the back in the seat back: as that of the cushion, with a coefficient of its
    own.
    """

    usual_coefficient = 4.7905e5

    coefficient: float | None = number(
        0.0, 1e12, "N/m^p/(m/s)^q", "B; 4.7905e5 by default: with the default exponents restitution 0.6 at 0.5 m/s",
        default=None, live="law")  # fmt: skip


class BackFriction(FrictionSection):
    """Friction between back and seat back: a spring and damper that sticks, up to the Coulomb
    limit; for the whole back.
    """

    coefficient_static: float = number(0.0, 5.0, "", "static friction; cloth 0.3 to 0.6", above=True, default=0.4)
    coefficient_kinetic: float = number(
        0.0, 5.0, "", "kinetic friction, at most coefficient_static", above=True, default=0.4
    )
    stiffness: float = number(
        1.0, 1e9, "N/m", "shear spring while it sticks; Mindlin's ratio at ν 0.45", default=3.19e4
    )
    damping: float = number(
        0.0,
        1e6,
        "N s/m",
        "shear damper while it sticks; the ratio to the spring that the normal loss has",
        default=619.0,
    )


class ShellModesSection(Section):
    """The back as a doubly curved shallow shell in modal form with candidate contact points, in
    place of one mass.
    """

    fixed: ClassVar[str] = "the modes of the shell are its state"

    modes: int = number(1, 25, "", "modes: 1, 4, 9 or 25 (m and n up to 1, 2, 3 or 5)", default=9)
    points_up: int = number(1, 64, "", "candidate contact points up the back", default=20)
    points_across: int = number(1, 64, "", "candidate contact points across the back", default=16)
    thickness: float = number(1e-4, 1.0, "m", "thickness of the shell, at most 0.1 of its shorter side", default=0.03)
    density: float = number(1.0, 1e5, "kg/m^3", "density of the shell", default=1050.0)
    young_modulus: float = number(
        1.0,
        1e12,
        "Pa",
        "Young's modulus of the shell; by default first mode 5.49 Hz, in the band of the spine",
        default=6.0e5,
    )
    poisson_ratio: float = number(0.0, 0.5, "", "Poisson's ratio of the shell", default=0.45)
    damping_ratio: float = number(0.0, 2.0, "", "damping ratio of every mode", default=0.1)
    shaken_across: float = number(
        0.0, 1.0, "", "place of the exciting force over the width, from the right edge", default=0.4
    )
    shaken_up: float = number(
        0.0, 1.0, "", "place of the exciting force over the height, from the lower edge", default=0.35
    )


class ContactSearchSection(Section):
    """One contact point that moves: where the bent shell comes nearest to the seat back, searched
    at every step; it carries the whole law, in place of candidate points with a share each."""
