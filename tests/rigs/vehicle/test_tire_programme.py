"""What a test machine runs over time: a table in the scene or a file, and the sentences on those that do not fit."""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.run.sources import make_travel
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolve import read_resolved

TRACK = "tire_flat_track"
COLUMNS = "tire.programme={time: [0, 1], load: [2000, 4000], slip_angle: [0, 0.1], slip: [0, -0.05], speed: [10, 20]}"
TABLE = """\
time [s],load [kN],slip_angle [deg],slip [%],speed [km/h],remark [-]
0,2,0,0,36,1
1,4,5.729577951308232,-5,72,2
"""


def test_columns_become_travel_slips_and_loads():
    scene = resolved(TRACK, COLUMNS)
    assert scene.data["travel"] == {"points": [[0.0, 10.0], [1.0, 20.0]]}
    assert scene.data["slip"] == {"points": [[0.0, 0.0, 0.0], [1.0, -0.05, 0.1]]}
    model = build(scene)
    assert model.rolling_friction.slips.at(0.5) == pytest.approx((-0.025, 0.05))
    assert make_travel(scene).position(1.0) == 15.0
    assert scene.data["tire"]["mount"]["load"] == 4000.0  # the largest, by which errors are judged
    assert (model.machine.start, model.machine.largest) == (2000.0, 4000.0)
    mass = model.quarter.wheel.mass
    servo = model.machine.acceleration(numpy.array([0.0, 0.5]), mass, mass, 9.81)
    numpy.testing.assert_allclose(mass * (9.81 - servo), [2000.0, 3000.0])


def test_a_file_is_the_table_in_si_units_and_goes_with_the_scene(tmp_path):
    (tmp_path / "sweep.csv").write_text(TABLE)
    of_file, table = resolved(TRACK, f"tire.programme={{file: {tmp_path / 'sweep.csv'}}}"), resolved(TRACK, COLUMNS)
    found = of_file.data["tire"]["programme"]
    for name, values in table.data["tire"]["programme"].items():
        assert found[name] == pytest.approx(values, rel=1e-15)
    again = read_resolved(of_file.to_yaml())  # without the file
    assert again.data == of_file.data


BAD_FILES = {
    r"column 'camber': the law has no camber": ("time [s],camber [deg]\n0,0\n1,2\n"),
    r"column 'inflation' goes from 180000 to 220000: a run has one inflation": (
        "time [s],load [kN],inflation [bar]\n0,4,1.8\n1,4,2.2\n"
    ),
    r"column 'fz' gives the load a second time": ("time [s],load [N],fz [kN]\n0,1,1\n1,2,2\n"),
    r"column 'load' has no unit that fits; write it behind the name, as load \[N\]": ("time [s],load\n0,1\n1,2\n"),
    r"column 'slip_angle' has no unit that fits": ("time [s],slip_angle [m]\n0,0\n1,0.1\n"),
    r"load of row 2 is -3000 N, outside 0 to 1000000 N": ("time [s],load [kN]\n0,4\n1,-3\n"),
    r"1 s does not come after 1 s": ("time [s],load [N]\n0,4000\n1,4000\n1,4100\n"),
    r"the first time is 1 s; it must be 0": ("time [s],load [N]\n1,4000\n2,4000\n"),
    r"there is no column load, deflection, slip, slip_angle, speed": ("time [s],temperature [K]\n0,300\n1,310\n"),
    r"there is no column time": ("load [N],speed [m/s]\n4000,1\n4000,2\n"),
}


@pytest.mark.parametrize("said", BAD_FILES)
def test_a_file_that_is_no_programme_is_refused_in_one_sentence(said, tmp_path):
    (tmp_path / "bad.csv").write_text(BAD_FILES[said])
    with pytest.raises(SceneError, match=said) as error:
        resolved(TRACK, f"tire.programme={{file: {tmp_path / 'bad.csv'}}}", "travel={speed: 10}")
    assert len(error.value.faults) == 1


def test_a_file_that_is_not_there_is_said_once():
    with pytest.raises(SceneError, match=r"gone\.csv") as error:
        resolved(TRACK, "tire.programme={file: gone.csv}")
    assert len(error.value.faults) == 1


BAD_KEYS = {
    "acts on a test machine, the tire carries a quarter car": ("tire_bump", "tire.programme={time: [0, 1], load: [4000, 4100]}"),
    "the mount keeps the load; take control: height": (TRACK, "tire.programme={time: [0, 1], deflection: [0, 0.02]}",
                                                       "tire.mount.control=load", "travel={speed: 10}"),
    "the programme of the tire gives it too": (TRACK, COLUMNS, "travel={speed: 10}"),
    "has 3 numbers, time has 2": (TRACK, "tire.programme={time: [0, 1], load: [1000, 1100, 1200]}", "travel={speed: 10}"),
    "is missing; give it with the columns, or a file": (TRACK, "tire.programme={load: [1000, 1100]}", "travel={speed: 10}"),
    "acts through the effect brush or magic_formula": ("tire_drum", "tire.programme={time: [0, 1], slip: [0, -0.1]}",
                                                       "travel={speed: 10}"),
    "the rim turns by effects.tire.wheel_spin": ("tire_cleat", "tire.programme={time: [0, 1], slip: [0, -0.1]}"),
}  # fmt: skip


@pytest.mark.parametrize("said", BAD_KEYS)
def test_columns_that_do_not_fit_are_refused_in_one_sentence(said):
    name, *values = BAD_KEYS[said]
    with pytest.raises(SceneError, match=said) as error:
        resolved(name, *values)
    assert len(error.value.faults) == 1


def test_slips_by_a_programme_act_on_a_quarter_car_too():
    scene = resolved("tire_braking", "slip=null", "tire.programme={time: [0, 1], slip_angle: [0, 0.1]}")
    assert scene.data["slip"]["points"] == [[0.0, 0.0, 0.0], [1.0, 0.0, 0.1]]
    assert "mount" not in scene.data["tire"]
