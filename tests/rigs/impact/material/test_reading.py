"""Files of impacts: units, separators, names; every fault one sentence with its line."""

import numpy
import pytest

from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.groups import groups
from contact_sim_pkg.rigs.impact.material.options import Options
from contact_sim_pkg.rigs.impact.material.reading import Impacts, read_impacts


def write(tmp_path, text):
    path = tmp_path / "impacts.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


@pytest.mark.parametrize(
    "text",
    [
        "m,R,V0,tau,k,T\n0.02,0.01,2,0.001,0.7,293.15\n",
        "# ball 7\n\nm [g]; R [mm]; V0 [m/s]; tau [ms]; k; T [°C]; comment\n20; 10; 2; 1; 0.7; 20; a, b\n",
        "Mass [g]\tradius [mm]\tspeed\tcontact_time [us]\trestitution\ttemperature [C]\n20\t10\t2.0\t1e3\t.7\t20\n",
        "tau [us];k;T [°F];m [g];R [mm];V0\n;;;;;\n1000;.7;68;20;10;2\n;;;;;\n",
        "m\tR\tV0\ttau\tk\tT\tremark\n0.02\t0.01\t2\t0.001\t0.7\t293.15\t\n\t\t\t\t\t\t\n",
        "\ufeffT,k,tau,V0,R,m\r\n293.15,0.7,0.001,2,0.01,0.02\r\n",
    ],
)
def test_the_same_impact_reads_the_same_from_every_layout(tmp_path, text):
    found = read_impacts(write(tmp_path, text))
    values = [float(v[0]) for v in (found.mass, found.radius, found.speed, found.duration, found.restitution)]
    assert values == pytest.approx([0.02, 0.01, 2.0, 1e-3, 0.7], rel=1e-12)
    assert found.temperature[0] == pytest.approx(293.15)


def test_a_column_that_is_not_used_is_noted_and_a_missing_temperature_is_none(tmp_path):
    found = read_impacts(write(tmp_path, "m,R,V0,tau,k,sample\n0.02,0.01,2,0.001,0.7,A\n"))
    assert found.temperature is None
    assert found.notes == ("columns not used: sample",)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "0 lines"),
        ("m,R,V0,tau,k,T\n", "1 lines"),
        ("m,R,V0,k,T\n1,1,1,1,1\n", "line 1: no column tau"),
        ("m,R,V0,tau,k,T\n1,1,1,1,1\n", "line 2: 5 fields, the header names 6"),
        ("m,R,V0,tau,k,T\n1,1,1,1e-3,0.5,293\n1,1,1,x,0.5,293\n", "line 3: 'x' in column 'tau'"),
        ("m,R,V0,tau,k,T\n1,1,1,nan,0.5,293\n", "line 2: 'nan' in column 'tau'"),
        ("m,R,V0,tau,k,T\n1,1,1,1_0,0.5,293\n", "1_0"),
        ("m,R,V0,tau,k,T\n1,1,-1,1,0.5,293\n", "line 2: -1 in column 'V0'; a number above 0"),
        ("m,R,V0,tau,k,T\n1,1,1,1,0,293\n", "line 2: 0 in column 'k'"),
        ("m,R,V0,tau,k,T\n1,1,1,1,70,293\n", "line 2: 70 in column 'k'; a number above 0, 0 to 1.5"),
        ("m,R,V0,tau,k,T\n1,1,1,1e-300,0.7,293\n", "line 2: 1e-300 in column 'tau'"),
        ("m,R,V0,tau,k,T [C]\n1,1,1,1,0.7,-300\n", "column 'T'"),
        ("m [lb],R,V0,tau,k,T\n1,1,1,1,0.7,300\n", "unit 'lb' of column 'm'"),
        ("m,mass,R,V0,tau,k\n1,1,1,1,1,0.7\n", "column 'm' is named twice"),
        ("m;R;V0;tau;k;T\n0,02;0,01;2;0,001;0,7;293\n", "decimal point"),
        (b"\xff\xfe\x00m,R", "byte 0: this is no text"),
        (f"m,R,V0,tau,k,T\n1,1,1,{'1' * 131_073},0.5,293\n", "line 2: this is no row of a table: field larger than"),
    ],
)
def test_every_fault_is_one_sentence_with_its_place(tmp_path, text, sentence):
    with pytest.raises(MaterialError) as caught:
        read_impacts(write(tmp_path, text))
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)
    assert "impacts.csv" in str(caught.value)


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(MaterialError, match=r"nothing\.csv: cannot be read"):
        read_impacts(tmp_path / "nothing.csv")


def test_repeats_are_close_in_temperature_and_in_speed():
    temperature = numpy.array([293.0, 310.0, 293.1, 293.05, 310.2, 292.9])
    speed = numpy.array([1.0, 2.0, 2.02, 1.01, 1.99, 0.99])
    ones = numpy.ones(6)
    impacts = Impacts("x", numpy.arange(6), ones, ones, speed, ones, ones, temperature, ())
    assert [group.tolist() for group in groups(impacts, Options())] == [[0, 3, 5], [2], [1, 4]]
    alone = groups(impacts, Options(temperature_span=0.0, speed_ratio=1.0))
    assert len(alone) == 6
    without = impacts._replace(temperature=None)
    assert [group.tolist() for group in groups(without, Options())] == [[0, 3, 5], [1, 2, 4]]
