"""What varies from case to case."""

import itertools
import math

import pytest

from contact_sim_pkg.sweep.variation import SweepError, read_variation, samples_of


def samples(*texts, sample="grid", seeds=0):
    return samples_of([read_variation(each) for each in texts], sample, seeds, 1)


def test_a_grid_is_every_combination_the_last_key_fastest():
    assert samples("travel.speed=5:20:4", "road.roughness_class=A,B") == [
        {"travel.speed": speed, "road.roughness_class": road} for speed in ("5", "10", "15", "20") for road in "AB"
    ]


def test_a_logarithmic_range_has_equal_ratios():
    found = [float(each["k"]) for each in samples("k=1e3:1e5:5:log")]
    assert [later / earlier for earlier, later in itertools.pairwise(found)] == pytest.approx([math.sqrt(10.0)] * 4)
    assert (found[0], found[-1]) == (1e3, 1e5)


@pytest.mark.parametrize("kind", ["lhs", "sobol"])
def test_drawn_samples_fill_every_stratum_once(kind):
    """N samples of a Latin hypercube, and of Sobol's sequence for a power of two, have one in each Nth of every range."""
    found = samples("a=0:1", "b=10:1000:log", sample=f"{kind}:16")
    parts = [[float(each["a"]) for each in found], [math.log(float(each["b"]) / 10.0, 100.0) for each in found]]
    assert all(sorted(int(16 * part) for part in of_key) == list(range(16)) for of_key in parts)
    assert found == samples("a=0:1", "b=10:1000:log", sample=f"{kind}:16")


def test_a_list_is_drawn_too():
    found = samples("road.roughness_class=A,B,C", sample="lhs:9")
    assert sorted(each["road.roughness_class"] for each in found) == sorted("AAABBBCCC")


def test_a_value_may_be_a_list_or_a_mapping():
    found = samples("road={kind: flat},{kind: bump, height: 0.02}", "impact.temperatures=[253.15, 260],[293.15]")
    assert [each["road"] for each in found] == ["{kind: flat}"] * 2 + ["{kind: bump, height: 0.02}"] * 2
    assert [each["impact.temperatures"] for each in found] == ["[253.15, 260]", "[293.15]"] * 2


def test_seeds_repeat_each_case():
    assert samples("k=1,2", seeds=2) == [{"k": k, "seed": seed} for k in "12" for seed in "12"]
    assert samples(seeds=3) == [{"seed": seed} for seed in "123"]


def test_a_file_names_keys_and_cases(tmp_path):
    path = tmp_path / "cases.csv"
    path.write_text("travel.speed, seed\n5, 1\n\n7.5, 2\n")
    assert samples(sample=str(path)) == [{"travel.speed": "5", "seed": "1"}, {"travel.speed": "7.5", "seed": "2"}]


@pytest.mark.parametrize(
    ("texts", "sample", "word"),
    [
        (("k",), "grid", "not of the form"), (("k=",), "grid", "not of the form"), (("k=1:x:3",), "grid", "not of the form"),
        (("k=3:1:3",), "grid", "low below high"), (("k=0:1:3:log",), "grid", "above 0"), (("k=1:2:0",), "grid", "at least 1"),
        (("k=1:2",), "grid", "number of points"), (("k=1,,2",), "grid", "empty"), (("k=1,1",), "grid", "twice"),
        (("k=1,2", "k=3,4"), "grid", "varies twice"), ((), "grid", "nothing varies"), (("k=1:2",), "lhs:x", "number of cases"),
        ((), "lhs:4", "there is none"), (("k=1:2",), "nowhere.csv", "no such file"),
        (("a=1:2:2000", "b=1:2:2000"), "grid", "at most 1000000"), (("a=1:2:1000000", "b=1:2:1000000"), "grid", "at most 1000000"),
        (("k=3,4,3.0",), "grid", "3.0 is there twice"),
    ],
)  # fmt: skip
def test_what_is_no_variation_is_one_sentence(texts, sample, word):
    with pytest.raises(SweepError, match=word) as refused:
        samples(*texts, sample=sample)
    assert "\n" not in str(refused.value)


def test_many_seeds_are_counted_before_a_list_is_built():
    with pytest.raises(SweepError, match="at most 1000000"):
        samples("k=1:2:1000000", seeds=10**9)
    with pytest.raises(SweepError, match="leave --seeds out"):
        samples("k=1:2", sample="saltelli:8", seeds=2)


def test_a_file_that_is_no_text_is_one_sentence(tmp_path):
    path = tmp_path / "cases.csv"
    path.write_bytes("travel.speed,größe\n1,2\n".encode("latin-1"))
    with pytest.raises(SweepError, match="UTF-8"):
        samples(sample=str(path))
