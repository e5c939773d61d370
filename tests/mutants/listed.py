"""Lines of physics that are broken one at a time, to see whether the tests notice (`make mutants`).

A mutant names a function and a piece of its text, not a line, for files move. `tests` are the names of the test modules
that must notice it, or of one test as `module::test`. `equivalent` says why no test can: the change alters no answer.
What turns a run into files and numbers for people is in `outputs`.
"""

from typing import NamedTuple


class Mutant(NamedTuple):
    """One change of one function, or of one constant."""

    function: str  # module.function, module.Class.method or module.CONSTANT, the module by the end of its path
    text: str  # stands exactly once in it
    becomes: str
    tests: tuple[str, ...]  # names of test modules, found wherever they lie, or `module::test`
    equivalent: str = ""
    interpreted: bool = False  # its tests run without the compiler, which a broken kernel would keep busy


MUTANTS = (
    # Laws of a contact point
    Mutant("friction.spring_is_limited", "2.0 *", "1.0 *", ("test_friction",)),
    Mutant("friction.following_deflection", "max(along, -limit)", "along", ("test_friction",)),
    Mutant("friction.stick_event", "coefficient_static", "coefficient_kinetic", ("test_friction",)),
    Mutant("normal_dissipative.dissipation_factor", "max(0.0, ", "max(-1.0, ", ("test_force_laws",)),
    Mutant("general_dissipative.rate_power", "0.5 * (", "1.0 * (", ("test_general_dissipative",)),
    Mutant("general_dissipative.general_force_rate", "p * thickness", "thickness", ("test_general_dissipative",)),
    Mutant("foam_hysteresis.hysteresis_energy", "0.5 *", "1.0 *", ("test_foam",)),
    Mutant("foam_elastic.foam_tangent_modulus", "(a - 1.0) *", "a *", ("test_foam",)),
    Mutant("point_friction.point_stick_event", "normal - trial", "normal + trial", ("test_point_friction",)),
    # Pressure fields
    Mutant("hertz.contact_of_shape", "1.0 / 6.0", "1.0 / 5.0", ("test_hertz",)),
    Mutant("hertz.stiffness_coefficient", "integral_k**3", "integral_k**2", ("test_hertz",)),
    Mutant("halfspace.love_coefficients", "(1, 0, -1.0)", "(1, 0, 1.0)", ("test_halfspace",)),
    Mutant("halfspace._transfer", "rows + 1", "rows", ("test_halfspace",)),
    Mutant("field/solver.overlap_approach", "0.6 *", "0.06 *", ("field/test_solver",)),
    Mutant(
        "field/iteration.release_cells",
        "surface[k] < approach",
        "surface[k] <= approach",
        ("field/test_solver",),
        "a cell whose surface lies exactly at the approach has no gap and no pressure: residual 0 either way",
    ),
    Mutant("lame_pressure.equivalent_ellipse", "math.pi * a * b", "4.0 * a * b", ("test_lame_pressure",)),
    Mutant("subsurface.von_mises", "3.0 *", "2.0 *", ("test_subsurface",)),
    Mutant(
        "tread_viscoelasticity.update_branches",
        "weights[k] * change",
        "weights[k] * now",
        ("test_tread_viscoelasticity",),
    ),
    Mutant("rolling_brush.rolling_step", "(1.0 + slip)", "(1.0 - slip)", ("test_brush",)),
    Mutant("tire/brush/steps.advance_bristles", "way * limit * 0.5", "way * limit", ("test_brush",)),
    Mutant("tire/brush/steps.advance_bristles", "released += 0.5 *", "released += 1.0 *", ("test_brush",)),
    Mutant("rolling_brush.advance_step", "turn * grid.origin_y", "-turn * grid.origin_y", ("test_brush",)),
    Mutant("lattice.resample", "weight * second", "(1.0 - weight) * second", ("test_brush",)),
    Mutant("rolling_brush.sliding_brush", "math.exp(-slip", "math.exp(-2.0 * slip", ("test_brush",)),
    Mutant("magic_formula.law_tire", "square * part / growth)\n", "square * part)\n", ("test_magic_formula",)),
    Mutant("property_file/scene_keys._ring", "2.0 * math.pi", "math.pi", ("property_file/test_scene_keys",)),
    # Rigid bodies
    Mutant("impact/law._left", "restitution**2", "restitution", ("impact/test_law",)),
    Mutant("impact/law._left", "taken = 0.5", "taken = 1.5", ("impact/test_law",)),
    Mutant(
        "impact/law._left",
        "works = 0.5",
        "works = 1.5",
        ("impact/test_law",),
        "the works and their size grow alike; only the sign of the quotient is used",
    ),
    Mutant(
        "planar_impact._slide_modes",
        "other_broken < broken",
        "other_broken <= broken",
        ("test_planar_impact",),
        "both ways to slide break their conditions alike only where neither is further from an answer",
    ),
    Mutant(
        "planar_impact._slide_impulse",
        "sign * contact.friction * contact.coupling",
        "contact.friction * contact.coupling",
        ("test_planar_impact",),
    ),
    Mutant("compliant.resting_swing", "elastic.exponent * weight", "weight", ("test_compliant",)),
    Mutant(
        "rotation.gyroscopic_rate",
        "(inertia[1] - inertia[2])",
        "(inertia[2] - inertia[1])",
        ("test_body", "test_turning"),
    ),
    Mutant("rotation.rotate_by", "0.5 * h * h", "0.25 * h * h", ("test_body", "test_landing")),
    Mutant("rotation._OUTER", "0.0822", "0.0823", ("test_body",)),
    # Rigs and their integrator
    Mutant("biodynamics.rest_deflections", "+= lift", "-= lift", ("test_biodynamics",)),
    Mutant(
        "vehicle/motion/seated._act",
        "lost += rubbed",
        "lost += 0.0 * rubbed",
        ("test_absent_effects",),
    ),
    Mutant("order_5.step_of_order_5", "125.0 / 192.0", "125.0 / 191.0", ("test_orders",)),
    Mutant("order_5.error_of_order_5", "22.0 / 525.0", "21.0 / 525.0", ("test_orders",)),
    # Excitation and what is made of a recording
    Mutant("recorded.RecordedVibration._filtered", "** 8", "** 4", ("test_recorded",)),
    Mutant("iso8608.band_variance", "power)) / (exponent - 1.0)", "power)) / exponent", ("test_iso8608",)),
    Mutant("bump.BumpRoad.profile", "0.5 * self.height", "self.height", ("test_obstacles",)),
    Mutant("weighting.response", "1.0 + s / omega_3", "1.0 - s / omega_3", ("test_weighting",)),
    Mutant("metrics.ride_metrics", "** 0.25", "** 0.5", ("test_metrics",)),
    # Impact and roller
    Mutant("surface_wave.ring", "(1.0 - part)", "(1.0 + part)", ("test_waves",)),
    Mutant("micro_front._border", "0.5 * impact.shape", "impact.shape", ("test_waves",)),
    Mutant("severity.loss_tangent_of_severity", "3.0 *", "2.0 *", ("test_severity",)),
    Mutant("stability.linearise", "[-gyro, ", "[gyro, ", ("test_stability",)),
    Mutant("stability._slopes", "8.0 * near", "7.0 * near", ("test_stability",)),
    Mutant("heave.contact_energy", "0.4 *", "0.6 *", ("test_heave",)),
    Mutant("corrugation.wear", "- mean)", ")", ("test_corrugation",)),
    Mutant("volumes.box_volume", "48.0", "24.0", ("test_volumes",)),
    # Identification
    Mutant("balance._of_motion", "sign * inertia", "inertia", ("test_balance",)),
)
