"""Keys of a rubber snubber between wheel and body."""

from contact_sim_pkg.scene.schema.fields import Section, number


class SnubberSection(Section):
    """A linear spring that takes over where the wheel has come up by so much against the body."""

    travel: float = number(
        -0.1, 1.0, "m", "from the height of rest on the suspension alone; below 0 engaged at rest", default=0.05
    )
    stiffness: float = number(1e3, 1e7, "N/m", "of the snubber", default=1e5)
