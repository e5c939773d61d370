"""The tire that a property file describes, beside its force law evaluated and solved by scipy."""

import math

import pytest
from scipy.optimize import brentq
from tests.rigs.vehicle.tire.property_file.tir_file import write

from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.magic_formula import standing_tire
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file

RADIUS, LOAD = 0.316, 4000.0


def standing(folder, pressure=220e3, nominal=220e3, **keys):
    return standing_tire(read_property_file(write(folder, **keys)), RADIUS, pressure, nominal)


@pytest.mark.parametrize("pressure", [150e3, 220e3, 280e3])
@pytest.mark.parametrize("square", [0.0, 15.0, -20.0])
def test_stiffness_and_deflection_are_those_of_the_load_law(tmp_path, pressure, square):
    stiffness, effect = 220e3, 0.7
    linear = math.sqrt((stiffness * RADIUS / LOAD) ** 2 - 4.0 * square)

    def force(deflection):
        x = deflection / RADIUS
        return LOAD * (1.0 + effect * (pressure / 220e3 - 1.0)) * (linear * x + square * x**2)

    there = brentq(lambda r: force(r) - LOAD, 0.0, 0.06, xtol=1e-15)
    slope = (force(there + 1e-6) - force(there - 1e-6)) / 2e-6
    for given in ({}, {"VERTICAL_STIFFNESS": None, "Q_FZ1": linear}, {"VERTICAL_STIFFNESS": 110e3, "LCZ": 2.0}):
        found = standing(tmp_path, pressure, Q_FZ2=square, PFZ1=effect, **given)
        assert found.deflection == pytest.approx(there, rel=1e-9)
        assert found.stiffness == pytest.approx(slope, rel=1e-7)
        assert (found.length, found.width) == (None, None)


def test_the_contact_is_that_of_the_formula(tmp_path):
    """Figures of the formula for a 205/60 R15 of 4 kN: 132 mm by 141 mm."""
    found = standing_tire(
        read_property_file(write(
            tmp_path, UNLOADED_RADIUS=0.3135, ASPECT_RATIO=0.6, RIM_RADIUS=0.1905, VERTICAL_STIFFNESS=209.7e3, Q_RA1=0.671,
            Q_RA2=0.733, Q_RB1=1.059, Q_RB2=-1.1878,
        )), 0.3135, 220e3, 220e3,
    )  # fmt: skip
    assert found.length == pytest.approx(0.132, abs=5e-4)
    assert found.width == pytest.approx(0.141, abs=5e-4)


def test_without_load_or_stiffness_there_is_no_standing_tire(tmp_path):
    assert standing(tmp_path, FNOMIN=None) is None
    assert standing(tmp_path, VERTICAL_STIFFNESS=None) is None


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ({"Q_FZ2": 100.0}, "give no tire that carries 4000 N"),
        ({"PFZ1": -10.0, "pressure": 300e3}, "give no tire that carries 4000 N at 300000 Pa"),
        ({"VERTICAL_STIFFNESS": None, "Q_FZ1": 5.0, "Q_FZ2": -10.0}, "give no tire"),
        ({"Q_RA1": -1.0}, "Q_RA1 -1 and Q_RA2 0 give a contact of -0"),
        ({"Q_RB1": 1e4}, "1e-3 to 1 m is allowed"),
    ],
)
def test_coefficients_that_make_no_tire_are_refused(tmp_path, keys, sentence):
    with pytest.raises(PropertyFileError, match=sentence):
        standing(tmp_path, **keys)
