"""Complex stress, creep, hereditary integral, relaxation times, moduli and operators: identities and slow twins."""

import cmath
import math
from types import SimpleNamespace

import numpy
import pytest
from scipy.integrate import quad

from contact_sim_lab.rigs.impact.twins import hereditary as slow
from contact_sim_pkg.rigs.impact import effect_outputs
from contact_sim_pkg.rigs.impact.theory import moduli
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.closed_form import harmonic, operator_form
from contact_sim_pkg.rigs.impact.theory.closed_form.scalings import damped_sine
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.viscoelastic import creep, relaxation
from contact_sim_pkg.rigs.impact.theory.viscoelastic.hereditary import hereditary_integral, indentation

RUBBER = Material(8e6, 0.2)
OMEGA = 300.0
MODELS = {
    "maxwell": creep.maxwell(2e6, 5e3),
    "kelvin_voigt": creep.kelvin_voigt(2e6, 3e-3),
    "standard": creep.standard_solid(5e6, 2e6, 3e-3),
    "many": creep.Creep(2e-7, 1e-5, (1e-7, 3e-7, 2e-8), (1e-5, 2e-3, 5.0)),
}


def test_the_complex_stress_is_the_strain_times_the_modulus():
    times = numpy.linspace(0.0, 0.05, 97)
    found = harmonic.complex_stress(RUBBER, 0.01, OMEGA, times)
    phase = math.atan(0.2)
    expected = (8e6 + 1.6e6j) * 0.01 * numpy.exp(1j * (OMEGA * times - phase))
    assert numpy.abs(found.elastic + 1j * found.viscous - expected).max() < 1e-8
    amplitude = abs(8e6 + 1.6e6j) * 0.01
    assert found.elastic == pytest.approx(amplitude * numpy.cos(OMEGA * times), abs=1e-7)
    printed = harmonic.complex_stress(RUBBER, 0.01, OMEGA, times, "printed")
    assert printed.elastic == pytest.approx(amplitude * numpy.cos(OMEGA * times - 2 * phase), abs=1e-7)


def test_without_loss_the_stress_follows_the_strain():
    found = harmonic.complex_stress(Material(8e6, 0.0), 0.01, OMEGA, numpy.array([0.0, 1e-3]))
    assert found.elastic == pytest.approx(8e4 * numpy.cos(OMEGA * numpy.array([0.0, 1e-3])))


def test_amplitudes_and_phase_give_the_material_back():
    modulus = harmonic.complex_modulus(RUBBER)
    found = harmonic.material_of_amplitudes(abs(modulus) * 0.02, 0.02, cmath.phase(modulus))
    assert found.storage_modulus == pytest.approx(8e6, rel=1e-14)
    assert found.loss_tangent == pytest.approx(0.2, rel=1e-14)


def test_a_standard_solid_has_the_complex_modulus_that_it_is_made_for():
    """J* = 1/G*; its ends are Maxwell's and Kelvin and Voigt's model."""
    modulus, tangent, frequency = 3e6, 0.4, 1700.0
    for ratio in (1.001, 2.0, 50.0):
        found = creep.standard_solid_at(modulus, tangent, frequency, ratio)
        assert 1.0 / creep.complex_compliance(found, frequency) == pytest.approx(modulus * (1.0 + 0.4j), rel=1e-9)
        assert 1.0 / found.glassy == pytest.approx(ratio * modulus * (1.0 + tangent**2), rel=1e-14)
    solid = creep.standard_solid_at(modulus, tangent, frequency, 1e6)
    assert solid.times[0] == pytest.approx(tangent / frequency, rel=2e-6)
    assert solid.compliances[0] == pytest.approx(1.0 / modulus, rel=2e-6)
    times = numpy.linspace(0.0, 2e-3, 9)
    fluid = creep.maxwell(modulus * 1.16, modulus * 1.16 / (frequency * tangent))
    near = creep.compliance(creep.standard_solid_at(modulus, tangent, frequency, 1.0 + 1e-7), times)
    assert near == pytest.approx(creep.compliance(fluid, times), rel=1e-5)
    with pytest.raises(ImpactError, match="instant ratio"):
        creep.standard_solid_at(modulus, tangent, frequency, 1.0)


@pytest.mark.parametrize("model", MODELS)
def test_the_recursion_is_the_quadrature_of_every_segment(model):
    times = numpy.concatenate(([0.0], numpy.cumsum(numpy.geomspace(1e-5, 2e-3, 60))))
    force = 3.0 + 50.0 * numpy.sin(40.0 * times) ** 2
    found = hereditary_integral(MODELS[model], times, force)
    expected = slow.integral(lambda t: creep.compliance(MODELS[model], t), times, force)
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-18)


def test_a_step_of_force_creeps_with_the_compliance():
    times = numpy.linspace(0.0, 0.02, 41)
    for model in MODELS.values():
        found = hereditary_integral(model, times, numpy.full(41, 7.0))
        assert found == pytest.approx(7.0 * creep.compliance(model, times), rel=1e-12)


def test_the_exact_update_holds_for_steps_far_from_the_retardation_time():
    """y of tau y' = F - y under a ramp F = t: y = t - tau (1 - e^(-t/tau))."""
    for ratio in (1e-9, 1e-6, 9.9e-4, 1.1e-3, 1.0, 1e4):
        model = creep.kelvin_voigt(1.0, 1.0 / ratio)
        found = hereditary_integral(model, numpy.array([0.0, 1.0]), numpy.array([0.0, 1.0]))[1]
        series = 0.5 * ratio - ratio**2 / 6.0
        expected = series if ratio < 1e-5 else 1.0 + math.expm1(-ratio) / ratio
        assert found == pytest.approx(expected, rel=1e-9)


def test_an_elastic_half_space_is_hertz_under_the_same_force():
    """x^(3/2) = 3 (1 - nu) F/(8 G sqrt R), as 3 F/(4 E* sqrt R) with E* = 2 G/(1 - nu); printed twice that."""
    model = creep.maxwell(2e6, math.inf)
    found = indentation(model, numpy.array([0.0, 1.0]), numpy.array([5.0, 10.0]), 0.01, 0.4)
    modulus = 2 * 2e6 / 0.6
    expected = (3 * numpy.array([5.0, 10.0]) / (4 * modulus * 0.1)) ** (2 / 3)
    assert found.depth == pytest.approx(expected, rel=1e-13)
    printed = indentation(model, numpy.array([0.0, 1.0]), numpy.array([5.0, 10.0]), 0.01, 0.4, "printed")
    assert printed.depth == pytest.approx(expected * 2 ** (2 / 3), rel=1e-13)


def test_a_shrinking_contact_is_flagged():
    times = numpy.linspace(0.0, 0.02, 201)
    force = 10.0 * numpy.sin(math.pi * times / 0.02)
    found = indentation(MODELS["standard"], times, force, 0.01, 0.5)
    deepest = int(numpy.argmax(found.depth))
    assert found.growing[: deepest + 1].all()
    assert not found.growing[deepest + 1 :].any()
    assert deepest > 100


@pytest.mark.parametrize(
    ("times", "force", "part"),
    [
        ([0.0, 1.0], [1.0], "as many"),
        ([0.0, 0.0], [1.0, 2.0], "rise"),
        ([0.0, 1.0], [1.0, math.nan], "finite"),
        ([], [], "at least"),
    ],
)
def test_samples_that_are_no_history_are_refused(times, force, part):
    with pytest.raises(ImpactError, match=part):
        hereditary_integral(MODELS["maxwell"], numpy.array(times), numpy.array(force))


def test_compliances_that_are_no_material_are_refused():
    for wrong in (creep.Creep(-1.0, 0.0, (), ()), creep.Creep(1.0, 0.0, (1.0,), ()), creep.Creep(0.0, 0.0, (), ())):
        with pytest.raises(ImpactError):
            creep.compliance(wrong, numpy.zeros(1))
    with pytest.raises(ImpactError, match="retardation time"):
        creep.kelvin_voigt(1e6, 0.0)


@pytest.mark.parametrize("model", ["maxwell", "kelvin_voigt", "standard"])
def test_creep_and_operators_are_the_same_material_in_harmonic_motion(model):
    operators = {
        "maxwell": operator_form.maxwell(2e6, 5e3 / 2e6),
        "kelvin_voigt": operator_form.kelvin_voigt(2e6, 2e6 * 3e-3),
        "standard": operator_form.standard_solid(5e6, 2e6, 3e-3),
    }[model]
    for frequency in (1.0, 300.0, 1e5):
        found = operator_form.modulus_at(operators, frequency) * creep.complex_compliance(MODELS[model], frequency)
        assert found == pytest.approx(1.0, rel=1e-12)


def test_the_complex_compliance_is_the_transform_of_the_creep():
    """J* = i w int J e^(-i w t) dt, for the part of J that settles."""
    model, frequency = creep.standard_solid(5e6, 2e6, 3e-3), 200.0

    def settling(t):
        return float(creep.compliance(model, numpy.array([t]))[0]) - (1 / 5e6 + 1 / 2e6)

    real = quad(settling, 0.0, 0.2, weight="cos", wvar=frequency, epsabs=1e-16)[0]
    imaginary = -quad(settling, 0.0, 0.2, weight="sin", wvar=frequency, epsabs=1e-16)[0]
    expected = 1 / 5e6 + 1 / 2e6 + 1j * frequency * complex(real, imaginary)
    assert creep.complex_compliance(model, frequency) == pytest.approx(expected, rel=1e-8)


def test_hooke_has_no_frequency_and_a_maxwell_element_at_rest_no_stress():
    assert operator_form.modulus_at(operator_form.hooke(3e6), 123.0) == 3e6
    assert operator_form.modulus_at(operator_form.maxwell(2e6, 1e-3), 0.0) == 0.0
    with pytest.raises(ImpactError, match="operator of the stress"):
        operator_form.modulus_at(operator_form.Operators((0.0, 1.0), (1.0,)), 0.0)


def test_the_times_of_relaxation_hang_together():
    tangent = 0.2
    assert relaxation.maxwell_time(OMEGA, tangent) * relaxation.retardation_time(OMEGA, tangent) == pytest.approx(
        OMEGA**-2
    )
    assert relaxation.retardation_time_of_impact(math.pi / OMEGA, tangent) == pytest.approx(tangent / OMEGA)
    assert relaxation.maxwell_time(OMEGA, 0.0) == math.inf
    sine = damped_sine(Sphere(0.02, 0.01), RUBBER, 2.0)
    natural = math.hypot(sine.frequency, sine.damping)
    decay = relaxation.decay_time(sine.damping)
    found = relaxation.retardation_time_of_decay(decay, tangent, natural)
    assert found == pytest.approx(tangent / sine.frequency, rel=1e-12)
    printed = relaxation.retardation_time_of_decay(decay, tangent, natural, "printed")
    assert printed == pytest.approx(decay * tangent / math.sqrt(1 + natural**2))
    with pytest.raises(ImpactError, match="nothing oscillates"):
        relaxation.retardation_time_of_decay(1e-6, tangent, natural)


@pytest.mark.parametrize("young", [3e6, 3e6 + 6e5j])
@pytest.mark.parametrize("poisson", [0.3, 0.0, -0.2, 0.49])
def test_moduli_turn_into_each_other_real_or_complex(young, poisson):
    shear, bulk = moduli.shear_modulus(young, poisson), moduli.bulk_modulus(young, poisson)
    assert moduli.young_modulus(shear, bulk) == pytest.approx(young, rel=1e-12)
    assert moduli.poisson_ratio(shear, bulk) == pytest.approx(poisson, abs=1e-12)
    assert young == pytest.approx(3 * bulk * (1 - 2 * poisson), rel=1e-12)


def test_an_incompressible_material_has_all_but_a_bulk_modulus():
    assert moduli.shear_modulus(3e6, 0.5) == pytest.approx(1e6)
    assert moduli.young_modulus(1e6, math.inf) == pytest.approx(3e6)
    assert moduli.poisson_ratio(1e6, math.inf) == 0.5
    with pytest.raises(ImpactError, match=r"Poisson ratio 0\.5"):
        moduli.bulk_modulus(3e6, 0.5)


def test_viscosities_are_the_other_modulus_over_the_frequency():
    assert moduli.dynamic_viscosities(8e6 + 1.6e6j, 400.0) == pytest.approx((4e3, 2e4))
    with pytest.raises(ImpactError, match="frequency"):
        moduli.dynamic_viscosities(1e6 + 0j, 0.0)


def test_the_standard_solid_of_a_run_has_the_ratio_of_its_scene(monkeypatch):
    """Depth under half a sine by scipy's quadrature of J(t - s) F'(s); J from G* and G0 alone."""
    duration, peak, poisson, radius, ratio = 1.3e-3, 17.0, 0.4, 0.012, 3.7
    storage, tangent, frequency, shape = 6.0e6, 0.35, 1900.0, 0.9
    times = numpy.linspace(0.0, duration, 401)
    pressed = peak * numpy.sin(math.pi * times / duration)
    monkeypatch.setattr(effect_outputs, "course_of", lambda *_: (times, None, None, 0.7 * pressed, 0.3 * pressed))
    free = SimpleNamespace(material=Material(storage, tangent), frequency=frequency, shape=shape)
    impact = SimpleNamespace(number=3, start=0.2, touch=SimpleNamespace(impact=free))
    model = SimpleNamespace(poisson_ratio=poisson, sphere=SimpleNamespace(radius=radius))
    effect = SimpleNamespace(model="standard_solid", instant_ratio=ratio)
    found = effect_outputs.history_of(model, effect, 5, impact)

    shear = 0.5 * shape * storage * (1.0 - poisson)  # elastic limit of the impact's own law
    glassy = 1.0 / (ratio * shear * (1.0 + tangent**2))
    delayed = 1.0 / (1.0 / (shear * (1.0 + 1.0j * tangent)) - glassy)  # G1 (1 + i omega tau)
    modulus, lag = delayed.real, delayed.imag / delayed.real / frequency
    rate = math.pi / duration
    for place in (40, 150, 210):
        after = times[place]

        def fed(s, after=after):
            return (glassy + (1.0 - math.exp((s - after) / lag)) / modulus) * peak * rate * math.cos(rate * s)

        integral, _ = quad(fed, 0.0, after)
        depth = (0.375 * (1.0 - poisson) / math.sqrt(radius) * integral) ** (2.0 / 3.0)
        assert found.depth[place] == pytest.approx(depth, rel=1e-4)
        assert found.valid[place] == 1
    assert (found.number, found.start, found.block, found.model) == (3, 0.2, 5, "standard_solid")
