"""Every public function of the impact's bodies, forces, geometry and closed forms: checks over its domain, refusals outside."""

from __future__ import annotations

import math

import mpmath
import numpy
import pytest
import scipy.integrate
from hypothesis import strategies as st
from tests.properties import Table, positive
from tests.rigs.impact.theory.formula_domain import (
    COMPLEX,
    FORM,
    FREQUENCY,
    LENGTH,
    LOSS,
    MATERIAL,
    MODULUS,
    POISSON,
    SHAPE,
    SPEED,
    SPHERE,
    near,
)

from contact_sim_pkg.pressure.closed_form.hertz import power_law
from contact_sim_pkg.rigs.impact.theory import bodies, geometry, moduli, position
from contact_sim_pkg.rigs.impact.theory.bodies import Material
from contact_sim_pkg.rigs.impact.theory.closed_form import force
from contact_sim_pkg.rigs.impact.theory.closed_form import scalings as closed_forms
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

MODULES = ("bodies", "closed_form.scalings", "closed_form.force", "geometry", "moduli", "position")
TABLE = Table()
holds = TABLE.holds
close = pytest.approx


# Bodies


@holds(bodies.hertz_modulus, plane_strain_modulus=MODULUS, shape_factor=SHAPE)
def _(found, plane_strain_modulus, shape_factor):
    assert force.elastic_coefficient(found, 0.25, shape_factor) == near(power_law(2.0, 2.0, plane_strain_modulus))


@holds(bodies.pair, half_space=MATERIAL, body=st.none() | MATERIAL)
def _(found, half_space, body):
    if body is None:
        assert found == half_space
        return
    one, two = (complex(m.storage_modulus, m.storage_modulus * m.loss_tangent) for m in (half_space, body))
    assert 1.0 / complex(found.storage_modulus, found.loss_modulus) == close(1.0 / one + 1.0 / two, rel=1e-12)
    low, high = sorted((half_space.loss_tangent, body.loss_tangent))
    assert low * (1 - 1e-9) - 1e-12 <= found.loss_tangent <= high * (1 + 1e-9) + 1e-12


@holds(bodies.shares, half_space_modulus=MODULUS, body_modulus=st.just(math.inf) | MODULUS)
def _(found, half_space_modulus, body_modulus):
    assert sum(found) == near(1.0)
    if body_modulus < math.inf:  # the same force presses both
        assert found[0] * half_space_modulus == close(found[1] * body_modulus, rel=1e-15 + 4e-16 / found[0])
    else:
        assert found == (1.0, 0.0)


# Closed forms


@holds(closed_forms.damped_sine, sphere=SPHERE, material=st.builds(Material, MODULUS, st.floats(0.0, 0.33)), speed=SPEED,
       form=FORM, shape_factor=SHAPE, outside=({"material": Material(1e6, 0.4371)},))  # fmt: skip
def _(found, sphere, material, speed, form, shape_factor):
    """The constants are those of equal work over the compression, at the depth and frequency that come out."""
    stiff = 16 / 15 * shape_factor * material.storage_modulus * math.sqrt(sphere.radius * found.depth)
    over = [scipy.integrate.quad(lambda s, p=p: s**p * math.sqrt(1 - s * s), 0.0, 1.0)[0] for p in (0.5, 0.0)]
    beta = 3.2 if form == "printed" else 4.0 * over[0] / over[1]
    drag = beta * shape_factor * material.loss_modulus * math.sqrt(sphere.radius * found.depth) / found.frequency
    delta = drag / (2.0 * sphere.mass)
    omega = math.sqrt(stiff / sphere.mass - delta**2)
    assert found.frequency == close(omega, rel=1e-7)
    assert found.damping == close(delta, rel=1e-7, abs=1e-12 * omega)
    assert (found.duration, found.restitution) == close((math.pi / omega, math.exp(-math.pi * delta / omega)), rel=1e-6)
    t = numpy.linspace(0.0, found.duration, 4001)
    x = speed / omega * numpy.exp(-delta * t) * numpy.sin(omega * t)
    v = speed * numpy.exp(-delta * t) * (numpy.cos(omega * t) - delta / omega * numpy.sin(omega * t))
    assert found.depth == close(x.max(), rel=1e-6)
    assert found.compression_time == close(t[x.argmax()], abs=found.duration / 3999)
    assert found.peak_force == close((stiff * x + drag * v).max(), rel=1e-6)


ENDS = {"printed": math.pi / 3.0, "mean_speed": math.pi / 6.0, "sine": 4.0 / (3.0 * math.pi)}


@holds(closed_forms.closed_restitution, loss_tangent=st.floats(0.0, 0.42), form=st.sampled_from(list(ENDS)),
       outside=({"loss_tangent": 1.0472}, {"loss_tangent": -1e-9}))  # fmt: skip
def _(found, loss_tangent, form):
    assert found == near((1.0 - loss_tangent / ENDS[form]) / (1.0 + loss_tangent / ENDS[form]))


@holds(closed_forms.loss_factor_limit, form=st.sampled_from(list(ENDS)))
def _(found, form):
    assert found == near(ENDS[form])


@holds(closed_forms.restitution_note, loss_tangent=LOSS, form=st.sampled_from(list(ENDS)))
def _(found, loss_tangent, form):
    assert (found is None) == (loss_tangent <= 0.9 * ENDS[form])


@holds(closed_forms.depth_of_restitution, sphere=SPHERE, storage_modulus=MODULUS, speed=SPEED, restitution=st.floats(0.0, 1.0),
       shape_factor=SHAPE, outside=({"restitution": 1.001},))  # fmt: skip
def _(found, sphere, storage_modulus, speed, restitution, shape_factor):
    """What the spring stores there is k of the energy of the blow."""
    stored = 8 / 15 * shape_factor * storage_modulus * math.sqrt(sphere.radius) * found**2.5
    assert stored == near(0.5 * sphere.mass * speed**2 * restitution)


@holds(closed_forms.closed_duration, sphere=SPHERE, storage_modulus=MODULUS, speed=SPEED,
       restitution=st.just(1.0) | st.floats(1e-6, 1.0), form=FORM, shape_factor=SHAPE,
       outside=({"restitution": 0.0}, {"restitution": 1.0 + 1e-12}))  # fmt: skip
def _(found, sphere, storage_modulus, speed, restitution, form, shape_factor):
    k = mpmath.mpf(restitution)
    ratio = 2 if k == 1 else -(1 + k) * mpmath.log(k) / (1 - k)
    group = (15 / 16 if form == "corrected" else 5 / 8) * sphere.mass / (shape_factor * storage_modulus)
    group = mpmath.mpf(group / math.sqrt(sphere.radius)) ** 0.8
    assert found**2 == near(float(2 * ratio * group / (mpmath.mpf(speed) ** 0.4 * k**0.2)))


# Forces and geometry


@holds(force.elastic_coefficient, storage_modulus=MODULUS, radius=LENGTH, shape_factor=SHAPE)
def _(found, storage_modulus, radius, shape_factor):
    assert found == near(power_law(0.5 / radius, 0.5 / radius, shape_factor * storage_modulus))


@holds(
    force.viscous_coefficient,
    loss_modulus=st.just(0.0) | MODULUS,
    radius=LENGTH,
    shape_factor=SHAPE,
    frequency=FREQUENCY,
)
def _(found, loss_modulus, radius, shape_factor, frequency):
    """Twice the rate of the elastic force with E'' in place of E', over w."""
    at = [4 / 3 * shape_factor * loss_modulus * math.sqrt(radius) * x**1.5 for x in (1.0 - 1e-5, 1.0 + 1e-5)]
    assert found == close(2.0 * (at[1] - at[0]) / 2e-5 / frequency, rel=1e-9)


@holds(force.elastic_force, coefficient=MODULUS, depth=st.floats(-1.0, 1.0), outside=({"coefficient": -1.0},))
def _(found, coefficient, depth):
    assert found == near(float(coefficient * mpmath.mpf(max(depth, 0.0)) ** 1.5))


@holds(force.viscous_force, coefficient=MODULUS, depth=st.floats(-1.0, 1.0), speed=st.floats(-10.0, 10.0),
       outside=({"coefficient": -1.0},))  # fmt: skip
def _(found, coefficient, depth, speed):
    assert found == near(coefficient * speed * max(depth, 0.0) ** 0.5)


@holds(force.lowest_force, end=st.sampled_from(force.ENDS), infinite=True)
def _(found, end):
    assert found == {"force": 0.0, "gap": -math.inf}[end]


@holds(force.normal_law, elastic=MODULUS, viscous=st.just(0.0) | MODULUS, end=st.sampled_from(force.ENDS), infinite=True,
       outside=({"elastic": 0.0}, {"viscous": -1.0}))  # fmt: skip
def _(found, elastic, viscous, end):
    spring, damper = found
    assert (spring.coefficient, spring.exponent) == (elastic, 1.5)
    assert (damper.coefficient, damper.approach_exponent, damper.rate_exponent) == (viscous, 0.5, 1.0)
    assert damper.lowest_force == force.lowest_force(end)


@holds(geometry.effective_radius, radius_1=LENGTH, radius_2=st.just(math.inf) | LENGTH,
       outside=({"radius_1": math.inf, "radius_2": math.inf},))  # fmt: skip
def _(found, radius_1, radius_2):
    assert 1.0 / found == near(1.0 / radius_1 + 1.0 / radius_2)


PART = st.floats(1e-9, 1.0)


@holds(geometry.depth_note, depth=st.floats(0.0, 1.0), radius=st.just(1.0), outside=({"depth": 1.001},))
def _(found, depth, radius):
    assert (found is None) == (depth <= 0.3)


@holds(
    geometry.shape_factor,
    depth=st.floats(0.0, 1.0),
    radius=st.floats(1.0, 2.0),
    outside=({"depth": 2.01}, {"depth": -1e-9}),
)
def _(found, depth, radius):
    assert found**2 * radius * depth == close(radius**2 - (radius - depth) ** 2, rel=1e-9, abs=1e-15)


@holds(geometry.contact_radius, depth=PART, radius=st.floats(1.0, 2.0), outside=({"depth": 2.01},))
def _(found, depth, radius):
    """Pythagoras in the rigid overlap."""
    assert math.hypot(found, radius - depth) == near(radius)
    assert geometry.contact_radius(-depth, radius) == 0.0


@holds(geometry.overlap_radius, depth=PART, radius_1=st.floats(2.0, 5.0), radius_2=st.floats(2.0, 5.0),
       outside=({"depth": 2.6},))  # fmt: skip
def _(found, depth, radius_1, radius_2):
    """A point of the circle lies on both spheres."""
    apart = math.sqrt((radius_1 - found) * (radius_1 + found)) + math.sqrt((radius_2 - found) * (radius_2 + found))
    assert apart == close(radius_1 + radius_2 - depth, rel=1e-12)
    assert geometry.overlap_radius(depth, radius_2, radius_1) == near(found)


@holds(
    geometry.depth_factor,
    radius=LENGTH,
    body_radius=LENGTH,
    body_share=st.floats(0.0, 1.0),
    outside=({"body_share": 1.01},),
)
def _(found, radius, body_radius, body_share):
    assert (found + body_share) * body_radius == close(radius, rel=1e-12, abs=1e-15 * body_radius)


# Moduli


@holds(moduli.shear_modulus, young=MODULUS | COMPLEX, poisson=POISSON, outside=({"poisson": -1.0}, {"poisson": 0.501}))
def _(found, young, poisson):
    assert 2.0 * found * (1.0 + poisson) == close(young, rel=1e-14)


@holds(moduli.bulk_modulus, young=MODULUS | COMPLEX, poisson=st.floats(-0.99, 0.499), outside=({"poisson": 0.5},))
def _(found, young, poisson):
    assert 3.0 * found * (1.0 - 2.0 * poisson) == close(young, rel=1e-12)


@holds(moduli.young_modulus, shear=MODULUS, bulk=MODULUS | st.just(math.inf))
def _(found, shear, bulk):
    """Uniaxial stress: the strain is that of shear and of pressure, 1/E = 1/(3 G) + 1/(9 K)."""
    assert 1.0 / found == near(1.0 / (3.0 * shear) + 1.0 / (9.0 * bulk))


@holds(moduli.poisson_ratio, shear=MODULUS, bulk=MODULUS | st.just(math.inf))
def _(found, shear, bulk):
    assert found == close(moduli.young_modulus(shear, bulk) / (2.0 * shear) - 1.0, abs=1e-14)
    assert -1.0 <= found <= 0.5


@holds(moduli.dynamic_viscosities, modulus=COMPLEX, frequency=FREQUENCY)
def _(found, modulus, frequency):
    """A stress `eta* d(eps)/dt`: E* = i w (eta' - i eta'')."""
    assert 1j * frequency * complex(found[0], -found[1]) == close(modulus, rel=1e-12)


# Position of the contact surface

HALF_SPACE = st.builds(
    position.SampleHalfSpace, st.floats(0.01, 1.0), st.floats(0.2, 0.5), st.floats(0.0, 1e-3), st.floats(0.0, 50.0)
)
TOO_SOFT = {"depth": 1.0, "half_space": position.SampleHalfSpace(1.0, -0.9)}


def check_position(found, depth, radius, half_space, k_squared, share_factor):
    x1 = half_space.share * depth
    softness = 3.0 * (1.0 - 2.0 * half_space.poisson_ratio)  # E'/K'
    assert found.share_depth == near(x1)
    assert found.volume == close(0.5 * math.pi * k_squared * radius * x1**2, rel=1e-9)
    lost = 8 / 15 * share_factor * softness * math.sqrt(radius) * x1**2.5
    assert found.compression_volume == close(lost, rel=1e-9, abs=1e-12 * found.volume)
    assert found.heating_volume == close(found.volume * half_space.expansion * half_space.heating, rel=1e-12)
    held = found.volume - found.compression_volume + found.heating_volume
    assert found.contact_volume == close(held, rel=1e-9)
    cap = 0.5 * math.pi * found.surface_factor**2 * radius * found.surface_depth**2
    assert cap == close(held, rel=1e-9)  # the contact surface encloses what is left


@holds(position.position_variant_1, depth=positive(1e-6, 0.5), radius=st.just(1.0), half_space=HALF_SPACE,
       rule=st.sampled_from(["equal", "consistent"]), outside=(TOO_SOFT, {"depth": 1.01}))  # fmt: skip
def _(found, depth, radius, half_space, rule):
    squared = 2.0 - depth / radius
    if rule == "consistent":
        squared *= 1.0 + (depth - found.share_depth) / found.surface_depth
    check_position(found, depth, radius, half_space, squared, math.sqrt(squared))


@holds(position.position_variant_2, depth=positive(1e-6, 0.5), radius=st.just(1.0), half_space=HALF_SPACE,
       outside=(TOO_SOFT, {"depth": 1.01}))  # fmt: skip
def _(found, depth, radius, half_space):
    squared = (2.0 - depth / radius) / half_space.share
    check_position(found, depth, radius, half_space, squared, math.sqrt(squared))


test_each_holds_over_its_domain, test_each_refuses_what_it_cannot_do, test_each_public_function_has_a_property = (
    TABLE.tests("contact_sim_pkg.rigs.impact.theory", MODULES)
)


def test_the_error_is_that_of_the_impact_model():
    with pytest.raises(ImpactError, match=r"radius -1\.0 m: a finite number above 0 is needed"):
        geometry.contact_radius(1.0, -1.0)
