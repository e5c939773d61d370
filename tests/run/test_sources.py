"""What is told of an excitation before a run."""

import subprocess
import sys

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.run.sources import make_vibration


def notes(*values):
    return make_vibration(resolved("seat_slap", *values)).describe()["notes"]


def test_a_sine_that_its_samples_follow_to_the_accuracy_has_no_note():
    assert notes() == []
    assert notes("accuracy=1e-6", "vibration.sample_rate=12500") == []
    assert notes("accuracy=realtime") == []


@pytest.mark.parametrize(("values", "rate"), [(["accuracy=1e-6"], 12_500), (["vibration.frequency=40"], 4000)])
def test_the_largest_gap_between_a_sine_and_its_straight_lines_is_reported_with_the_cure(values, rate):
    (note,) = notes(*values)
    frequency = 40.0 if rate == 4000 else 5.25
    time = numpy.linspace(0.0, 1e-3, 2001) - 0.5e-3  # about a crest
    sine = numpy.cos(2.0 * numpy.pi * frequency * time)
    off = float((sine - sine[0]).max())
    assert f"up to {off:.2g} of its amplitude off" in note
    assert f"vibration.sample_rate: {rate} leaves" in note
    assert notes(*values, f"vibration.sample_rate={rate}") == []


def test_a_sine_is_made_without_readers_of_files_and_without_a_compiler():
    """As the node of the vibration starts: from the resolved scene of its supervisor."""
    text = resolved("seat_slap").to_yaml()
    code = (
        "import sys; import contact_sim_pkg.run.sources as sources; "
        "from contact_sim_pkg.scene.resolved_scene import ResolvedScene; "
        "made = sources.make_vibration(ResolvedScene.from_own_yaml(sys.stdin.read(), {})).block(0); "
        "late = ('numba', 'scipy', 'contact_sim_pkg.excitation.recorded', 'contact_sim_pkg.excitation.opencrg', "
        "'contact_sim_pkg.excitation.table_files', 'contact_sim_pkg.excitation.roads.iso8608'); "
        "sys.exit(' '.join(name for name in late if name in sys.modules) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], input=text, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
