"""Keys of the force laws that several contacts share, and the rules between them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Literal

from contact_sim_pkg.records.fields import Section, choice, number
from contact_sim_pkg.scene.schema.accuracy import level_of
from contact_sim_pkg.scene.schema.foam_curve import FoamCurveSection, share_at
from contact_sim_pkg.scene.schema.foam_points import MOST_SHARE

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene

SMOOTHED_SPEED = 0.5
"""[m/s] that the smoothing of a rate exponent below 1 is relative to, where a scene names none."""

USUAL_PERCENTILE = 50

THICKEST = 0.2
"""[m] of a cushion."""

STIFFEST = 1e6
"""[Pa] modulus of a cushion; under a person a harder one touches too few cells of its map."""

USUAL_SHARE = 0.12
"""[1] of a foam's hysteresis, where neither a scene nor a measured curve gives one: 21 % are lost."""

USUAL_REVERSAL = 1.0
"""[J] of a foam's hysteresis, where a scene names none."""


class PowerLaw(Section):
    """Elastic force: coefficient · approach^exponent."""

    fixed: ClassVar[str] = "another exponent is another law"

    coefficient: float = number(1.0, 1e12, "N/m^exponent", "A")
    exponent: float = number(1.0, 3.0, "", "n; 1 is linear, 1.5 is Hertz", default=1.5)


class HuntCrossley(Section):
    """Hunt-Crossley dissipation: elastic force · (1 + damping · approach rate), never pulling; or
    `restitution` at a speed.
    """

    fixed: ClassVar[str] = "damping is what follows from it, once, at the start"

    usual_damping: ClassVar[float]
    """[s/m] where a scene names neither damping nor restitution."""

    damping: float | None = number(0.0, 100.0, "s/m", "λ", default=None)
    restitution: float | None = number(
        0.01, 1.0, "", "ratio of the speeds after and before a free impact, instead of damping", default=None
    )
    reference_speed: float | None = number(
        0.001, 100.0, "m/s", "impact speed at which the restitution holds", default=None
    )

    def open_values(self, scene: Scene) -> dict[str, Any]:
        return {"damping": self.usual_damping} if self.restitution is None else {}


class Foam(Section):
    """Foam block under an even load, with plateau and densification; its force takes the place of
    that of normal_elastic.
    """

    fixed: ClassVar[str] = "foam is one curve as a whole"

    area: float = number(1e-3, 10.0, "m^2", "loaded area; under an occupant 0.10 to 0.15", default=0.12)
    thickness: float = number(0.005, 2.0, "m", "thickness of the unloaded block", default=0.08)
    modulus: float = number(
        100.0, 1e9, "Pa", "Young's modulus at first contact, above plateau; 20 to 100 kPa", default=4.0e4
    )
    plateau: float = number(
        10.0, 1e8, "Pa", "stress of the plateau; with the other defaults 5.9 kPa at 40 % strain", default=3.0e3
    )
    densification: float = number(0.0, 1e8, "Pa", "stress scale of the densification (choice)", default=150.0)
    densification_exponent: float = number(
        0.1, 20.0, "", "r: stress grows as l^(-r-1), l = 1 - strain; 3 bends up near 65 % strain (choice)", default=3.0
    )


class CushionSection(Section):
    """Foam layer of finite thickness on a rigid base under a body by percentile: force law and map
    from one table.
    """

    fixed: ClassVar[str] = "the table of a cushion is solved for a run as a whole"

    percentile: Literal[5, 50, 95] | None = choice(
        "body that presses into it: a woman of the 5th percentile, a man of the 50th or 95th; that of the occupant, or 50",
        default=None,
    )
    thickness: float = number(0.02, THICKEST, "m", "thickness of the unloaded foam", default=0.08)
    modulus: float = number(
        100.0,
        STIFFEST,
        "Pa",
        "Young's modulus of the foam at first contact, above plateau; 20 to 100 kPa",
        default=4.5e4,
    )
    plateau: float = number(
        10.0, 1e5, "Pa", "stress of the plateau; with the other defaults 6.1 kPa at 40 % strain", default=3.4e3
    )
    densification: float = number(0.0, 1e4, "Pa", "stress scale of the densification", default=80.0)
    densification_exponent: float = number(0.1, 20.0, "", "r: stress grows as l^(-r-1), l = 1 - strain", default=3.0)
    hardness: float | None = number(
        100.0, 1e5, "Pa", "stress at 40 % strain (ISO 3386-1): scales the three stresses together; none: as they are",
        default=None,
    )  # fmt: skip
    curve: FoamCurveSection | None = choice(
        "measured stress over strain in place of modulus, plateau, densification and hardness", default=None
    )
    shear_share: float = number(
        0.0, 1.0, "", "part of the shear stiffness of the bonded layer that buckled foam keeps", default=0.3
    )
    cover: Literal["sliding", "inextensible"] = choice(
        "top of the foam: it moves sideways freely, or a taut cover holds it", default="sliding"
    )
    cell: float | None = number(
        0.005, 0.02, "m", "side of the square cells of the map; taken from accuracy when absent", default=None
    )

    cells: ClassVar[tuple[float, ...]] = (0.01, 0.0075, 0.005)
    """[m] of a cell for each of `accuracy.LEVELS`."""

    def open_values(self, scene: Scene) -> dict[str, Any]:
        return {"percentile": USUAL_PERCENTILE, "cell": self.cells[level_of(scene.accuracy)]}


class FoamHysteresisSection(Section):
    """Dissipation without rate: the force is the elastic one times 1 + share · z, z between -1 and
    1 follows the loading.
    """

    fixed: ClassVar[str] = "the loop that foam has begun is of it"

    share: float | None = number(
        0.0, MOST_SHARE, "", "s; a long loading dissipates 2 s/(1 + s); by default that of the cushion's curve, or 0.12: 21 %",
        default=None,
    )  # fmt: skip
    energy: float | None = number(
        1e-6, 1e6, "J", "u₀, stored energy of a reversal (choice); 1 J by default, on a cushion by the load at rest",
        above=True, default=None,
    )  # fmt: skip

    def open_values(self, scene: Scene) -> dict[str, Any]:
        measured = share_at(scene, self) if self.share is None else None
        return {"energy": USUAL_REVERSAL, "share": USUAL_SHARE if measured is None else measured}


class GeneralDissipation(Section):
    """General law: elastic force + coefficient · approach^approach_exponent · sgn(rate)
    |rate|^rate_exponent; in place of normal_dissipative. Exponents 0 and 1 are a plain damper, the
    elastic exponent and 1 Hunt-Crossley, 0.5 and 1 Kuwabara-Kono."""

    fixed: ClassVar[str] = (
        "another exponent is another law, and a restitution is turned into its coefficient at the start"
    )

    usual_coefficient: ClassVar[float] = 2.73e5
    """Where a scene names neither coefficient nor restitution: the elastic one times damping, by
    default.
    """

    coefficient: float | None = number(
        0.0, 1e12, "N/m^p/(m/s)^q", "B; 2.73e5 by default: with the default exponents 500 N s/m at 498 N",
        default=None, live="law",
    )  # fmt: skip
    approach_exponent: float = number(0.0, 4.0, "", "p, power of the approach", default=1.5)
    rate_exponent: float = number(
        0.0, 3.0, "", "q, power of the approach rate; below 1 smoothed over 1e-6 of reference_speed", default=1.0
    )
    restitution: float | None = number(
        0.01, 1.0, "", "ratio of the speeds after and before a free impact of the whole occupant, instead of coefficient",
        default=None,
    )  # fmt: skip
    reference_speed: float | None = number(
        0.001, 100.0, "m/s", "impact speed at which the restitution holds; 0.5 where only rate_exponent below 1 needs it",
        default=None,
    )  # fmt: skip
    end: Literal["force", "gap"] = choice(
        "contact ends at zero force (never tensile), or at zero gap (tensile before)",
        default="force",
    )

    def open_values(self, scene: Scene) -> dict[str, Any]:
        found = {"coefficient": self.usual_coefficient} if self.restitution is None else {}
        return found if self.rate_exponent >= 1.0 else {**found, "reference_speed": SMOOTHED_SPEED}


class FrictionSection(Section):
    """Friction at a contact that deforms: a spring and damper that sticks, up to the Coulomb
    limit.
    """

    fixed: ClassVar[str] = "while it sticks, its spring holds what was allowed before"

    coefficient_static: float = number(0.0, 5.0, "", "static friction; cloth 0.3 to 0.6", above=True, default=0.4)
    coefficient_kinetic: float = number(
        0.0, 5.0, "", "kinetic friction, at most coefficient_static", above=True, default=0.35
    )
    stiffness: float = number(1.0, 1e9, "N/m", "shear spring of the cushion while it sticks (choice)", default=2.0e4)
    damping: float = number(0.0, 1e6, "N s/m", "shear damper of the cushion while it sticks (choice)", default=200.0)
