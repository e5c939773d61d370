"""Every public function of the impact's viscoelasticity and shift: checks over its domain, refusals outside."""

from __future__ import annotations

import cmath
import math

import mpmath
import numpy
import pytest
from hypothesis import strategies as st
from tests.properties import Table, positive, rows
from tests.rigs.impact.theory.formula_domain import (
    FORM,
    FREQUENCY,
    LENGTH,
    LOSS,
    MATERIAL,
    MODULUS,
    POISSON,
    SPEED,
    TIME,
    near,
)

from contact_sim_pkg.pressure.closed_form.hertz import hertz_contact_at_approach
from contact_sim_pkg.rigs.impact.theory import roots, shift
from contact_sim_pkg.rigs.impact.theory.closed_form import harmonic, operator_form
from contact_sim_pkg.rigs.impact.theory.viscoelastic import creep, hereditary, relaxation

MODULES = (
    "viscoelastic.creep",
    "closed_form.harmonic",
    "viscoelastic.hereditary",
    "closed_form.operator_form",
    "viscoelastic.relaxation",
    "roots",
    "shift",
)
TABLE = Table()
holds = TABLE.holds
close = pytest.approx


# Creep and operators


@holds(creep.maxwell, shear_modulus=MODULUS, viscosity=st.just(math.inf) | MODULUS)
def _(found, shear_modulus, viscosity):
    assert creep.compliance(found, [0.0, 2.0]) == close([1 / shear_modulus, 1 / shear_modulus + 2 / viscosity])


@holds(creep.kelvin_voigt, shear_modulus=MODULUS, retardation_time=TIME)
def _(found, shear_modulus, retardation_time):
    """Spring and dashpot side by side: the complex moduli add."""
    omega = 0.7 / retardation_time
    assert creep.complex_compliance(found, omega) == close(1.0 / (shear_modulus * (1 + 0.7j)), rel=1e-12)


@holds(creep.standard_solid, glassy_modulus=MODULUS, delayed_modulus=MODULUS, retardation_time=TIME)
def _(found, glassy_modulus, delayed_modulus, retardation_time):
    same = operator_form.standard_solid(glassy_modulus, delayed_modulus, retardation_time)
    omega = 1.3 / retardation_time
    assert 1.0 / creep.complex_compliance(found, omega) == close(operator_form.modulus_at(same, omega), rel=1e-12)


@holds(creep.standard_solid_at, storage_modulus=MODULUS, loss_tangent=positive(1e-3, 2.0), frequency=positive(1.0, 1e5),
       instant_ratio=st.floats(1.001, 1e3), outside=({"instant_ratio": 1.0}, {"loss_tangent": 0.0}))  # fmt: skip
def _(found, storage_modulus, loss_tangent, frequency, instant_ratio):
    assert 1.0 / creep.complex_compliance(found, frequency) == close(
        storage_modulus * (1.0 + 1j * loss_tangent), rel=1e-8
    )


CREEP = st.builds(
    lambda glassy, fluidity, parts: creep.Creep(glassy, fluidity, *zip(*parts, strict=True)),
    positive(1e-12, 1e-3), st.just(0.0) | positive(1e-12, 1e-3),
    st.lists(st.tuples(positive(1e-12, 1e-3), positive(1e-4, 1e4)), min_size=1, max_size=3),
)  # fmt: skip
NO_MATERIAL = {"creep": creep.Creep(0.0, 0.0, (), ())}


@holds(creep.compliance, creep=CREEP, times=rows(st.floats(0.0, 1e4)), outside=(NO_MATERIAL, {"times": [-1.0]}))
def _(found, times, **given):
    made = given["creep"]
    for t, value in zip(times, found, strict=True):
        parts = [j * (1 - mpmath.exp(-t / tau)) for j, tau in zip(made.compliances, made.times, strict=True)]
        assert value == near(float(made.glassy + made.fluidity * t + mpmath.fsum(parts)))


@holds(creep.complex_compliance, creep=CREEP, frequency=FREQUENCY, outside=(NO_MATERIAL,))
def _(found, frequency, **given):
    """Elements in a row: the compliances of springs, dashpot and Kelvin-Voigt pairs add."""
    made = given["creep"]
    total = made.glassy + (0.0 if made.fluidity == 0.0 else 1.0 / (1j * frequency / made.fluidity))
    for part, tau in zip(made.compliances, made.times, strict=True):
        total += 1.0 / (1.0 / part + 1j * frequency * tau / part)
    assert found == close(total, rel=1e-12)


@holds(operator_form.hooke, modulus=MODULUS)
def _(found, modulus):
    assert operator_form.modulus_at(found, 3.0) == modulus


@holds(operator_form.kelvin_voigt, modulus=MODULUS, viscosity=MODULUS)
def _(found, modulus, viscosity):
    assert operator_form.modulus_at(found, 3.0) == close(modulus + 3j * viscosity, rel=1e-14)


@holds(operator_form.maxwell, modulus=MODULUS, relaxation_time=TIME)
def _(found, modulus, relaxation_time):
    spring_and_dashpot = 1.0 / (1.0 / modulus + 1.0 / (3j * modulus * relaxation_time))
    assert operator_form.modulus_at(found, 3.0) == close(spring_and_dashpot, rel=1e-12)


@holds(operator_form.standard_solid, glassy_modulus=MODULUS, delayed_modulus=MODULUS, retardation_time=TIME)
def _(found, glassy_modulus, delayed_modulus, retardation_time):
    voigt = delayed_modulus * (1 + 3j * retardation_time)
    assert operator_form.modulus_at(found, 3.0) == close(1.0 / (1.0 / glassy_modulus + 1.0 / voigt), rel=1e-12)


OPERATORS = st.builds(
    lambda e, tau: operator_form.Operators((1.0, tau, 0.1 * tau**2), (e, 2 * e * tau)), MODULUS, positive(1e-3, 10.0)
)


@holds(operator_form.modulus_at, operators=OPERATORS, frequency=st.just(0.0) | positive(0.01, 100.0),
       outside=({"operators": operator_form.Operators((0.0, 1.0), (1.0,)), "frequency": 0.0},))  # fmt: skip
def _(found, operators, frequency):
    """The stress that the operators give for a strain exp(i w t): its derivatives are powers of i w."""
    stress = sum(c * (1j * frequency) ** n for n, c in enumerate(operators.stress)) * found
    strain = sum(c * (1j * frequency) ** n for n, c in enumerate(operators.strain))
    assert stress == close(strain, rel=1e-12)


# Harmonic motion, hereditary integral


@holds(harmonic.complex_modulus, material=MATERIAL)
def _(found, material):
    assert abs(found) == near(material.storage_modulus * math.hypot(1.0, material.loss_tangent))
    assert cmath.phase(found) == near(math.atan(material.loss_tangent))


@holds(harmonic.material_of_amplitudes, stress=MODULUS, strain=positive(1e-6, 1.0), phase=st.floats(0.0, 1.57),
       outside=({"phase": 0.5 * math.pi}, {"phase": -1e-9}, {"strain": 0.0}))  # fmt: skip
def _(found, stress, strain, phase):
    assert abs(harmonic.complex_modulus(found)) == near(stress / strain)
    assert math.atan(found.loss_tangent) == near(phase)


@holds(harmonic.complex_stress, material=MATERIAL, strain=positive(1e-6, 1.0), frequency=positive(0.1, 10.0),
       times=rows(st.floats(0.0, 10.0)), form=FORM)  # fmt: skip
def _(found, material, strain, frequency, times, form):
    """The stress leads the strain by beta; as printed its real part turns twice as far."""
    modulus = complex(material.storage_modulus, material.loss_modulus)
    turned = numpy.exp(1j * frequency * times)
    turned_back = turned * numpy.exp(-1j * cmath.phase(modulus)) ** (0 if form == "corrected" else 2)
    size = strain * abs(modulus)
    assert found.viscous == close(size * turned.imag, abs=1e-12 * size)
    assert found.elastic == close(size * turned_back.real, abs=1e-12 * size)


@holds(hereditary.hereditary_integral, creep=CREEP, times=st.just(numpy.array([0.0, 0.1, 0.15, 2.0, 40.0])),
       force=rows(st.floats(0.0, 1e4), 5, 5),
       outside=(NO_MATERIAL, {"times": numpy.zeros(5)}, {"force": numpy.ones(4)}))  # fmt: skip
def _(found, times, **given):
    """A step of the first force and ramps between the samples, each with the exact integral of J."""
    made, f = given["creep"], given["force"]

    def integral(t: float) -> float:
        total = made.glassy * t + 0.5 * made.fluidity * t * t
        return total + sum(
            j * (t + tau * math.expm1(-t / tau)) for j, tau in zip(made.compliances, made.times, strict=True)
        )

    for n, t in enumerate(times):
        expected = float(f[0] * creep.compliance(made, [t])[0])
        for i in range(n):
            slope = (f[i + 1] - f[i]) / (times[i + 1] - times[i])
            expected += slope * (integral(t - times[i]) - integral(t - times[i + 1]))
        scale = max(f) * float(creep.compliance(made, [t])[0])
        assert found[n] == close(expected, rel=1e-9, abs=1e-9 * scale)


@holds(hereditary.indentation, creep=st.builds(creep.maxwell, MODULUS, st.just(math.inf)), times=st.just([0.0, 1.0, 2.0]),
       force=rows(positive(1e-3, 1e3), 3, 3).map(numpy.sort), radius=LENGTH, poisson_ratio=POISSON, form=FORM,
       outside=({"poisson_ratio": 0.51}, {"times": [0.0, 1.0]}))  # fmt: skip
def _(found, times, radius, poisson_ratio, form, **given):
    """An elastic half-space: Hertz with E* = 2 G/(1 - nu); twice the force as printed."""
    modulus = 2.0 / given["creep"].glassy / (1.0 - poisson_ratio)
    for depth, load in zip(found.depth, given["force"], strict=True):
        contact = hertz_contact_at_approach(0.5 / radius, 0.5 / radius, modulus, float(depth))
        assert contact.load == near(load if form == "corrected" else 2.0 * load)
    assert found.growing.all()


# Times


@holds(relaxation.maxwell_time, frequency=FREQUENCY, loss_tangent=LOSS, infinite=True)
def _(found, frequency, loss_tangent):
    """A Maxwell element at w: E* = E i w tau/(1 + i w tau)."""
    if loss_tangent > 0.0:
        value = 1j * frequency * found / (1.0 + 1j * frequency * found)
        assert value.imag / value.real == close(loss_tangent, rel=1e-9)


@holds(relaxation.retardation_time, frequency=FREQUENCY, loss_tangent=LOSS)
def _(found, frequency, loss_tangent):
    assert operator_form.modulus_at(operator_form.Operators((1.0,), (1.0, found)), frequency).imag == near(loss_tangent)


@holds(relaxation.retardation_time_of_impact, duration=TIME, loss_tangent=LOSS)
def _(found, duration, loss_tangent):
    assert found == near(relaxation.retardation_time(math.pi / duration, loss_tangent))


@holds(relaxation.decay_time, damping=positive(1e-3, 1e3))
def _(found, damping):
    assert math.exp(-damping * found) == near(1.0 / math.e)


@holds(relaxation.retardation_time_of_decay, decay=st.floats(1.0, 10.0), loss_tangent=LOSS,
       natural_frequency=st.floats(1.01, 50.0), form=FORM, outside=({"decay": 0.01, "form": "corrected"},))  # fmt: skip
def _(found, decay, loss_tangent, natural_frequency, form):
    if form == "corrected":  # at the frequency of the damped oscillation
        omega = math.sqrt(natural_frequency**2 - decay**-2)
        assert found == close(loss_tangent / omega, rel=1e-9)
    else:
        assert found == near(decay * loss_tangent / math.hypot(1.0, natural_frequency))


@holds(roots.bracketed_root, function=st.floats(-8.0, 8.0).map(lambda c: lambda x: x**3 - c), low=st.floats(-9.0, -3.0),
       high=st.floats(3.0, 9.0), relative=st.just(4e-16))  # fmt: skip
def _(found, function, low, high, relative):
    assert found == close(float(numpy.cbrt(-function(0.0))), rel=1e-14, abs=1e-5)


@pytest.mark.parametrize("function", [lambda x: 1.0, lambda x: math.nan])
def test_a_function_without_a_change_of_sign_has_no_root(function):
    with pytest.raises((ArithmeticError, ValueError), match=r"no change of sign|nan"):
        roots.bracketed_root(function, 0.0, 1.0)


# Shift

WLF = st.builds(shift.Wlf, st.floats(200.0, 250.0), st.floats(5.0, 30.0), st.floats(30.0, 90.0))
ARRHENIUS = st.builds(shift.Arrhenius, st.floats(200.0, 400.0), positive(1e4, 1e6))
WARM = st.floats(250.0, 400.0)
POLE = {"shift": shift.Wlf(300.0), "temperature": 248.4}


@holds(shift.log_shift, shift=WLF | ARRHENIUS, temperature=WARM, outside=(POLE,))
def _(found, temperature, **given):
    law = given["shift"]
    if isinstance(law, shift.Wlf):
        above = temperature - law.glass_temperature
        assert found == close(-law.c1 + law.c1 * law.c2 / (law.c2 + above), rel=1e-9, abs=1e-12)
    else:
        rate = [
            math.exp(-law.activation_energy / (8.31446261815324 * t)) for t in (temperature, law.reference_temperature)
        ]
        if min(rate) > 0.0:
            assert 10.0**found == close(rate[1] / rate[0], rel=1e-9)


@holds(shift.temperature_of_shift, shift=WLF | ARRHENIUS, value=st.floats(-4.0, 4.0),
       outside=({"shift": shift.Wlf(220.0), "value": -17.44}, {"shift": shift.Arrhenius(300.0, 1e4), "value": -2.0}))  # fmt: skip
def _(found, value, **given):
    assert shift.log_shift(given["shift"], found) == close(value, abs=1e-9)


@holds(shift.equivalent_temperature, shift=WLF | ARRHENIUS, temperature=st.floats(280.0, 320.0), speed=st.floats(0.5, 2.0),
       table_speed=st.floats(0.5, 2.0))  # fmt: skip
def _(found, temperature, speed, table_speed, **given):
    """States of equal V a_T are equal."""
    a_t = [10.0 ** shift.log_shift(given["shift"], t) for t in (temperature, found)]
    assert speed * a_t[0] == close(table_speed * a_t[1], rel=1e-9)


@holds(shift.carried_duration, duration=TIME, speed=SPEED, table_speed=SPEED)
def _(found, duration, speed, table_speed):
    assert (duration / found) ** 5 == near(speed / table_speed)


@holds(shift.shift_note, shift=WLF | ARRHENIUS, temperature=WARM)
def _(found, temperature, **given):
    law = given["shift"]
    inside = isinstance(law, shift.Arrhenius) or law.glass_temperature <= temperature <= law.glass_temperature + 100.0
    assert (found is None) == inside


test_each_holds_over_its_domain, test_each_refuses_what_it_cannot_do, test_each_public_function_has_a_property = (
    TABLE.tests("contact_sim_pkg.rigs.impact.theory", MODULES)
)
