"""Each option of `bench metrics` on each kind of bag: it acts, or it is refused by name; a seat by other weightings."""

import numpy as np
import pytest
from tests.report.metrics.test_of_bag import RATE, foreign_bag

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.report.metrics.foreign import ForeignOptions
from contact_sim_pkg.report.metrics.listing import all_metrics
from contact_sim_pkg.report.metrics.of_bag import metrics_of_bags
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.signal.metrics import ride_metrics
from contact_sim_pkg.report.signal.weighting import WEIGHTINGS
from contact_sim_pkg.rigs.vehicle.seat.report.metrics import weighted_metrics

OPTIONS = {
    "--all": {"whole": True},
    "--loaded": {"loaded": 500.0},
    "--axis": {"chosen": ForeignOptions(axis="Wd")},
    "--topic": {"chosen": ForeignOptions(topic="/sensor/imu")},
    "--unit": {"chosen": ForeignOptions(unit="m/s^2")},
    "--up": {"chosen": ForeignOptions(up="z")},
}
TAKEN = {
    "of the bench": {"--all", "--loaded", "--axis"},
    "accelerations": {"--axis", "--topic", "--unit", "--up"},
    "forces": set(),
}


@pytest.fixture(scope="module")
def bags(uneven, tmp_path_factory):
    folder = tmp_path_factory.mktemp("kinds")
    noise = np.random.default_rng(6).normal(size=(round(8 * RATE), 3)) + np.array([0.0, 0.0, 9.81])
    return {
        "of the bench": uneven.path,
        "accelerations": foreign_bag(folder / "imu", "imu", noise),
        "forces": foreign_bag(folder / "wrench", "wrench", noise),
    }


@pytest.mark.parametrize("option", OPTIONS)
@pytest.mark.parametrize("kind", TAKEN)
def test_an_option_acts_or_is_refused_by_its_name(bags, kind, option):
    given = {"whole": False, "loaded": None, "chosen": None} | OPTIONS[option]
    if option not in TAKEN[kind]:
        with pytest.raises(BagError, match=rf"{option}|{given['chosen'] and given['chosen'].topic}"):
            metrics_of_bags([bags[kind]], **given)
        return
    plain = {each.key: each.value for each in metrics_of_bags([bags[kind]]).metrics}
    found = {each.key: each.value for each in metrics_of_bags([bags[kind]], **given).metrics}
    assert found
    if option in ("--all", "--loaded", "--axis"):  # the others say what is known already of this bag
        assert found != plain


@pytest.mark.parametrize("name", ["Wb", "Wc", "Wd", "We", "Wf", "Wj", "Wk"])
def test_a_seat_is_weighted_by_each_weighting(uneven, name):
    recording: Recording = read_recording(uneven)
    found = {each.key: each for each in weighted_metrics(recording, WEIGHTINGS[name])}
    signal = recording.motion.acceleration["seat_frame_z"]
    expected = ride_metrics(signal, 1.0 / recording.motion.sample_period, WEIGHTINGS[name])
    assert found["seat.a_w"].value == pytest.approx(expected.weighted_rms, rel=1e-12)
    assert found["seat.factor"].name == f"SEAT, {name}"
    assert ("seat.sickness" in found) == (name == "Wf")
    assert ("seat.a_8" in found) == (name == "Wk")


def test_an_axis_that_no_run_has_is_refused(uneven):
    for axis, cure in (("x", "write --axis Wd"), ("y:Wb", "write --axis Wb"), ("rx", "write --axis We")):
        with pytest.raises(BagError, match=cure):
            metrics_of_bags([uneven.path], chosen=ForeignOptions(axis=axis))


def test_the_threshold_of_a_map_is_a_key_of_the_scene(uneven):
    """As `--loaded` has it, which comes before the key."""
    recording: Recording = read_recording(uneven)
    half = 0.5 * float(recording.fields["seat"].average.pressure.max())
    known = recording._replace(scene={**recording.scene, "outputs": {"loaded_pressure": half}})
    areas = [{each.key: each.value for each in all_metrics(*given)}["seat.map_area"]
             for given in ((recording,), (recording, half), (known,), (known, 1.0))]  # fmt: skip
    assert areas[1] == areas[2] < areas[0] == areas[3]


def test_a_list_by_another_weighting_is_whole(uneven):
    with pytest.raises(BagError, match="--all beside --axis"):
        metrics_of_bags([uneven.path], whole=True, chosen=ForeignOptions(axis="Wb"))
