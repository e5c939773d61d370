"""How the load divides between contact and bending."""

import pytest
from scipy.optimize import brentq, minimize_scalar

from contact_sim_pkg.rigs.roller.theory.load_split import load_of_approach, parallel_contact_load

K_C, K_B = 4.01e-6 / 100.0 ** (2.0 / 3.0), 6.985e-7


@pytest.mark.parametrize("load", [1e-6, 1.0, 100.0, 1e5])
@pytest.mark.parametrize("stiffer", [1.0, 1e-6, 1e6])
def test_the_parallel_split_has_the_least_energy(load, stiffer):
    def energy(share):
        contact = share * load
        return 0.6 * K_C * contact ** (5.0 / 3.0) + 0.5 * K_B * stiffer * (load - contact) ** 2

    found = minimize_scalar(energy, bounds=(0.0, 1.0), method="bounded", options={"xatol": 1e-12})
    assert parallel_contact_load(K_C, K_B * stiffer, load) / load == pytest.approx(found.x, abs=2e-6)


@pytest.mark.parametrize("approach", [1e-12, 1e-6, 1e-4, 0.1])
@pytest.mark.parametrize("compliance", [0.0, K_B, 1.0])
def test_the_load_of_an_approach(approach, compliance):
    expected = brentq(
        lambda f: K_C * f ** (2.0 / 3.0) + compliance * f - approach,
        0.0,
        1.1 * (approach / K_C) ** 1.5,
        xtol=1e-300,
        rtol=1e-15,
    )
    assert load_of_approach(K_C, compliance, approach) == pytest.approx(expected, rel=1e-13)


def test_separated_bodies_carry_no_load():
    assert load_of_approach(K_C, K_B, 0.0) == load_of_approach(K_C, K_B, -1.0) == 0.0
    assert parallel_contact_load(K_C, K_B, 0.0) == 0.0
