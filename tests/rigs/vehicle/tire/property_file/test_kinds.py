"""Files of the kinds that are in use: each a scene within 6 % of its stiffness and deflection, or refused with the figures."""

import pytest
from tests.rigs.vehicle.tire.property_file.kinds import KINDS
from tests.rigs.vehicle.tire.property_file.tir_file import write

from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import squashed, standing_on_belt
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file
from contact_sim_pkg.rigs.vehicle.tire.property_file.scene_keys import scene_tire
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation

BEYOND = {
    "truck at 8 bar": ("IP is 800000 Pa", "at 400000 Pa and the file's deflection of 33.3 mm", "3.5e+04 N", "1.05e+06 N/m"),
    "truck at 6.5 bar, inflation in bar": (
        "INFLATION_PRESSURE is 650000 Pa", "at 400000 Pa and the file's deflection of 35.3 mm", "3e+04 N", "8.5e+05 N/m",
    ),
    "bus without inflation": ("carries FNOMIN 35000 N", "at 220000 Pa and the file's deflection of 35 mm", "1e+06 N/m"),
    "racing at 0.83 bar": ("INFLPRES is 83000 Pa", "at 100000 Pa and the file's deflection of 7.78 mm", "700 N", "9e+04 N/m"),
}  # fmt: skip
"""What the sentence on each that no scene stands for has."""


@pytest.mark.parametrize("name", [name for name in KINDS if name not in BEYOND])
def test_a_kind_makes_a_scene_within_6_percent_at_its_own_inflation(tmp_path, name):
    """Judged by the tire that a run has, not by the rows of the fit."""
    kind = KINDS[name]
    found = scene_tire(read_property_file(write(tmp_path, kind.text)))
    inflation = Inflation(**found.effects["inflation"])
    assert found.usable
    assert inflation.size == kind.size
    assert inflation.pressure == pytest.approx(kind.pressure, rel=2e-3)
    standing = standing_on_belt(inflation, kind.load)
    assert standing.stiffness == pytest.approx(kind.stiffness, rel=0.06)
    assert standing.deflection == pytest.approx(kind.deflection, rel=0.06)


@pytest.mark.parametrize("name", BEYOND)
def test_a_kind_that_no_scene_stands_for_is_refused_with_the_figures(tmp_path, name):
    with pytest.raises(PropertyFileError) as error:
        scene_tire(read_property_file(write(tmp_path, KINDS[name].text)))
    assert all(part in str(error.value) for part in BEYOND[name])
    assert str(error.value).count("(ratio ") == 2


def test_fifteen_kinds_and_more_are_there():
    assert len(KINDS) >= 15
    assert {*BEYOND} < {*KINDS}


def test_a_squashed_tire_carries_the_load_that_squashes_it():
    standing = standing_on_belt(Inflation(), 4000.0)
    load, stiffness = squashed(Inflation(), standing.deflection)
    assert load == pytest.approx(4000.0, rel=5e-3)  # on cells twice as wide
    assert stiffness == pytest.approx(standing.stiffness, rel=1e-2)
