"""Physics that is off by 1 to 5 %, to see whether the figures of the papers notice (`make mutants MUTANTS=papers`).

Each multiplies one quantity; a figure that shows it must have a number OUTSIDE.
"""

from tests.mutants.listed import Mutant


def _off(function: str, text: str, becomes: str, figure: str) -> Mutant:
    """Noticed by a ``figure``, paper and number."""
    return Mutant(function, text, becomes, (f"test_figures::test_a_figure_is_inside[{figure}]",))


PAPERS = (
    # Driver and Seat
    _off(
        "restitution.damping_of_restitution",
        "_damping(restitution)) / speed",
        "_damping(restitution)) * 1.02 / speed",
        "driver-seat-6",
    ),
    _off("friction.friction_force", "mode * friction", "1.02 * mode * friction", "driver-seat-6"),
    _off(
        "friction.stick_event", "friction.coefficient_static *", "1.02 * friction.coefficient_static *", "driver-seat-6"
    ),
    _off(
        "contact_laws.elastic_law",
        "NormalElastic(power.coefficient,",
        "NormalElastic(1.01 * power.coefficient,",
        "driver-seat-6",
    ),
    _off("backrest/model.mat_of", "back.radius_up, back", "1.02 * back.radius_up, back", "driver-seat-7"),
    # Contact Area
    _off("closed_form/force.viscous_coefficient", "4.0 *", "4.08 *", "contact-area-4"),
    _off("closed_form/force.elastic_coefficient", "4.0 /", "4.04 /", "contact-area-4"),
    _off("severity.loss_tangent_of_severity", "3.0 *", "3.06 *", "contact-area-4"),
    # Tire/Road Contact
    _off("halfspace.love_coefficients", "sign * corner", "1.01 * sign * corner", "tire-road-2"),
    _off("bump.BumpRoad.profile", "0.5 * self.height", "0.505 * self.height", "tire-road-2"),
    _off("self_affine.SelfAffineRoad.__init__", "scale_to(rms)", "scale_to(1.03 * rms)", "tire-road-3"),
    # Rolling Contact
    _off("hertz.contact_of_shape", "1.5 * load", "1.515 * load", "rolling-contact-10"),
    _off(
        "moments.moments_of_straight",
        "roller.rolling_friction *",
        "1.01 * roller.rolling_friction *",
        "rolling-contact-3",
    ),
    _off("theory/motion._fill", "roller.inertia_spin *", "1.01 * roller.inertia_spin *", "rolling-contact-3"),
    _off("corrugation.wear", "track.gain *", "1.02 * track.gain *", "rolling-contact-4"),
    # Identifiability
    _off(
        "impact/law._one_in_the_plane",
        "problem.friction[i]), restitution",
        "problem.friction[i]), 1.02 * restitution",
        "identifiability-1",
    ),
    _off(
        "impact/law._one_in_the_plane",
        "float(problem.friction[i])",
        "1.02 * float(problem.friction[i])",
        "identifiability-1",
    ),
)
