"""Influence function of the bonded layer against the Navier equations, solved by matrix exponentials, and its limits."""

import numpy
import pytest
from scipy.linalg import expm

from contact_sim_pkg.pressure.cushion.bonded_layer import layer_influence

H, E = 0.08, 5.0e4


def navier_influence(q, nu, inextensible):
    """-W(h) under the normal stress -1, for u_x = U(z) sin qx, u_z = W(z) cos qx on a base without motion."""
    shear = E / 2 / (1 + nu)
    lame = 2 * shear * nu / (1 - 2 * nu)
    both, axial = lame + shear, lame + 2 * shear
    # State U, W, U', W' of the two equations of equilibrium.
    system = numpy.array([
        [0, 0, 1, 0], [0, 0, 0, 1], [axial * q**2 / shear, 0, 0, both * q / shear],
        [0, shear * q**2 / axial, -both * q / axial, 0],
    ])  # fmt: skip
    from_slopes = expm(system * H)[:, 2:]
    shear_stress = shear * (from_slopes[2] - q * from_slopes[1])
    normal_stress = lame * (q * from_slopes[0] + from_slopes[3]) + 2 * shear * from_slopes[3]
    slopes = numpy.linalg.solve([from_slopes[0] if inextensible else shear_stress, normal_stress], [0.0, -1.0])
    return -from_slopes[1] @ slopes


@pytest.mark.parametrize("inextensible", [False, True])
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.45])
@pytest.mark.parametrize("t", [0.01, 0.1, 0.5, 1.0, 2.0, 5.0])
def test_it_is_the_solution_of_the_navier_equations(t, nu, inextensible):
    found = layer_influence(numpy.array([t / H]), H, E, nu, inextensible=inextensible)
    assert found[0] == pytest.approx(navier_influence(t / H, nu, inextensible), rel=1e-9)


@pytest.mark.parametrize("nu", [0.0, 0.3])
def test_long_waves_see_independent_columns_and_short_ones_the_half_space(nu):
    oedometric = E * (1 - nu) / (1 + nu) / (1 - 2 * nu)
    half_space = 2 * (1 - nu**2) / E
    for inextensible, ratio in ((False, 1.0), (True, (3 - 4 * nu) / 4 / (1 - nu) ** 2)):
        long = layer_influence(numpy.array([0.0, 1e-6, 1.3e-3]) / H, H, E, nu, inextensible=inextensible)
        assert long == pytest.approx(H / oedometric, rel=1e-6)
        q = numpy.array([400.0, 1e6]) / H  # exp(t) is beyond the range of numbers
        short = layer_influence(q, H, E, nu, inextensible=inextensible)
        assert short * q == pytest.approx(ratio * half_space, rel=1e-12)


def test_a_half_space_is_too_soft_at_the_wavelengths_of_a_seat():
    """Of a cushion of 80 mm at wavelengths of 0.5 and 1 m: 2 and 4 times."""
    q = numpy.array([1.0, 0.5]) / H
    assert (2 / E / q) / layer_influence(q, H, E) == pytest.approx([2.06, 4.01], rel=2e-3)


def test_a_layer_outside_its_range_is_refused():
    q = numpy.array([1.0])
    for change in ({"thickness": 0.0}, {"modulus": -1.0}, {"poisson": 0.5}, {"wave_number": numpy.array([-1.0])}):
        with pytest.raises(ValueError, match="is needed"):
            layer_influence(**{"wave_number": q, "thickness": H, "modulus": E, **change})
