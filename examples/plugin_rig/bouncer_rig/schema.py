"""Keys of the scene that this package brings, with unit, range, default and a line of help."""

from contact_sim_pkg.scene.schema.fields import Section, number


class FootSection(Section):
    """A mass above a pad."""

    mass: float = number(1e-3, 1e4, "kg", "mass that falls", default=1.0)
    height: float = number(0.0, 100.0, "m", "height above the pad from which it falls", default=0.1)


class PadSection(Section):
    """Spring and damper under the mass."""

    stiffness: float = number(1.0, 1e9, "N/m", "of the spring", default=1e5)
    damping: float = number(0.0, 1e6, "N s/m", "of the damper", default=20.0)


class LoadChangeSection(Section):
    """Rate of the normal force."""

    time: float = number(1e-4, 10.0, "s", "time constant of the smoothing", default=0.01)
