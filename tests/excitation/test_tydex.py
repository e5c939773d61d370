"""Measurements in the TYDEX format: channels with units and factors, and the sentences on files that are none."""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.table_files import read_recording

FILE = """\
**HEADER
RELEASE   Release of TYDEX-Format                 1.3
**COMMENTS
! a made-up sweep
**CONSTANTS
INFLPRES  Inflation pressure            bar       2.2
**MEASURCHANNELS
!Name    !Comment                      !Unit     !Factor
MEASNUMB  Measurement point no.         -         1
RUNTIME   Running time                  s         0.01
FZH       Vertical force                kN        0.001
SLIPANGL  Slip angle                    deg       1
INCLANGL  Inclination angle             deg       1
LONGSLIP  Longitudinal slip             %         1
TRAJVELW  Trajectory velocity           km/h      1
**MEASURDATA
1 0 4000 0 0 0 36
2 100 5000 -5.729577951308232 0 -10 72
3 200 5000 0 0 0 72
**END
"""


def written(tmp_path, text, name="sweep.tdx"):
    path = tmp_path / name
    path.write_text(text)
    return path


def test_channels_come_in_si_units_by_unit_and_factor(tmp_path):
    table = read_recording(written(tmp_path, FILE))
    numpy.testing.assert_allclose(table.column("FZH"), [4000.0, 5000.0, 5000.0])
    numpy.testing.assert_allclose(table.column("SLIPANGL"), [0.0, -0.1, 0.0])
    numpy.testing.assert_allclose(table.column("TRAJVELW"), [10.0, 20.0, 20.0])
    assert (table.units["fzh"], table.units["slipangl"], table.units["trajvelw"]) == ("N", "rad", "m/s")
    assert table.time(None)[0].tolist() == [0.0, 1.0, 2.0]


def test_a_measurement_is_a_programme_of_the_flat_track(tmp_path):
    scene = resolved("tire_flat_track", f"tire.programme={{file: {written(tmp_path, FILE)}}}")
    assert scene.data["tire"]["programme"]["load"] == pytest.approx([4000.0, 5000.0, 5000.0])
    assert scene.data["slip"]["points"][1] == pytest.approx([1.0, -0.1, -0.1])
    assert scene.data["travel"]["points"][0] == pytest.approx([0.0, 10.0])


BAD = {
    r"line 16: channel FZH is there twice, in kN and in N; keep one": (
        "**MEASURDATA", "FZH       Vertical force                N         1\n**MEASURDATA"),
    r"line 10: the factor of channel RUNTIME is 'x'": ("s         0.01", "s         x"),
    r"line 18: the row has 6 numbers, the file has 7 channels": ("2 100 5000", "2 5000"),
    r"line 19: '5\.0\.0' is no number": ("3 200 5000", "3 200 5.0.0"),
    r"there is nothing under \*\*MEASURDATA": ("**MEASURDATA", "**MODELDEFINITION"),
}  # fmt: skip


@pytest.mark.parametrize("said", BAD)
def test_a_file_that_is_none_is_refused_by_its_line(said, tmp_path):
    with pytest.raises(ExcitationError, match=said):
        read_recording(written(tmp_path, FILE.replace(*BAD[said])))


def test_a_camber_is_refused_only_where_there_is_one(tmp_path):
    leaning = FILE.replace("2 100 5000 -5.729577951308232 0", "2 100 5000 -5.729577951308232 2")
    with pytest.raises(Exception, match="column 'inclangl': the law has no camber"):
        resolved("tire_flat_track", f"tire.programme={{file: {written(tmp_path, leaning)}}}")
