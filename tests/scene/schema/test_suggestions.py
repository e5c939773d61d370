"""Numbers that a sentence suggests are accepted: each is put into the scene that was refused, and mends it there."""

import math
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.schema.catalog import show_below

NUMBER = r"(-?[0-9][0-9.]*(?:e[-+]?[0-9]+)?)"
TRACK = "effects.roller.track_waves.track=both"


def faults_of(scene, values):
    try:
        load_scene(scene, [set_value(value) for value in values])
    except SceneError as error:
        return {fault.where: fault.sentence for fault in error.faults}
    return {}


def suggested(sentence, patterns):
    """Key and number of each suggestion in a sentence; ``patterns`` by key, with NUMBER where a number stands."""
    return [(key, text) for key, pattern in patterns for found in re.findall(pattern, sentence) for text in
            ((found,) if isinstance(found, str) else found) if text]  # fmt: skip


def nearest(unit):
    return rf"nearest allowed (?:is|are) {NUMBER}(?: and {NUMBER})? {unit}$"


HALF_MILLIMETRES = st.integers(2, 60).map(lambda n: n / 2000.0)  # radii [m]
RULES = {
    # scene, values that vary, key of the sentence, its suggestions
    "block_length": (
        "block_slope", {"block_length": st.floats(0.001, 0.1)}, "block_length", [("block_length", nearest("s"))],
    ),
    "duration": (
        "block_slope", {"duration": st.floats(0.005, 3600.0), "block_length": st.sampled_from([0.01, 0.003, 0.001000001, 0.1])},
        "duration", [("duration", nearest("s"))],
    ),
    **{
        f"outputs.{name}": (
            "block_slope",
            {f"outputs.{name}": st.integers(1, 9999).map(float), "block_length": st.sampled_from([0.01, 0.02, 0.003, 0.007])},
            f"outputs.{name}", [(f"outputs.{name}", nearest("Hz"))],
        )
        for name in ("force_rate", "display_rate", "field_rate")
    },
    "vibration.sample_rate": (
        "seat_slap", {"vibration.sample_rate": st.integers(100, 9999).map(float)}, "vibration.sample_rate",
        [("vibration.sample_rate", nearest("Hz"))],
    ),
    "vibration.duration": (
        "seat_shock", {"vibration.duration": st.floats(1e-4, 9e-3), "vibration.sample_rate": st.just(1000.0)},
        "vibration.duration", [("vibration.sample_rate", rf"the sample rate {NUMBER} Hz")],
    ),
    "roller.speed": (
        "roller_corrugation",
        {"roller.radius": HALF_MILLIMETRES, "roller.shaft_radius": HALF_MILLIMETRES,
         "roller.speed": st.floats(0.5, 500.0), "block_length": st.sampled_from([0.01, 0.05])},
        "roller.speed", [("roller.speed", rf"take {NUMBER} 1/s"), ("block_length", rf"a block_length of {NUMBER} s")],
    ),
    "roller.radius": (
        "roller_corrugation", {"roller.radius": st.floats(0.001, 0.1), "roller.speed": st.just(100.0), TRACK[:-5]: st.just("both")},
        "roller.radius", [("larger", rf"take {NUMBER} m for the larger")],
    ),
    "roller.inertia_product": (
        "roller_flutter", {"roller.inertia_tilt": st.floats(1e-6, 1e-3), "roller.inertia_product": st.just(0.01)},
        "roller.inertia_product", [("roller.inertia_product", rf"from {NUMBER} to {NUMBER} kg")],
    ),
    "impact.speeds": (
        "impact_pendulum", {"impact.arm": st.floats(0.05, 5.0), "impact.speeds": st.just([50.0])}, "impact.speeds.0",
        [("impact.speeds", rf"horizontal, {NUMBER} m/s")],
    ),
    "backrest.back.radius_up": (
        "seat_shell", {"backrest.back.height": st.floats(0.3, 0.9), "backrest.back.radius_up": st.just(0.05)},
        "backrest.back.radius_up", [("backrest.back.radius_up", rf"below {NUMBER} m, where")],
    ),
    "block.position": (
        "block_slope", {"block.position": st.floats(-0.05, 0.03).map(lambda z: [0.0, 0.0, z])}, "block.position",
        [("rise", rf"raise its z by {NUMBER} m")],
    ),
    "seat.response_segment": (
        "seat_ride", {"seat.response_segment": st.just(1e-3), "outputs.force_rate": st.sampled_from([100.0, 200.0, 1e3, 5e3])},
        "seat.response_segment", [("seat.response_segment", rf"outside {NUMBER} to {NUMBER} s")],
    ),
}  # fmt: skip


def mended(values, key, text):
    """The values with a suggested number; of lists, and of what is told by its part, the whole value."""
    changed = dict(values)
    if key == "rise":
        changed["block.position"] = [0.0, 0.0, values["block.position"][2] + float(text)]
    elif key == "larger":
        shaft = 0.005
        changed["roller.radius" if values["roller.radius"] > shaft else "roller.shaft_radius"] = text
    elif key == "impact.speeds":
        changed[key] = [float(text)]
    else:
        changed[key] = text
    return changed


@pytest.mark.parametrize("rule", RULES)
def test_what_a_sentence_suggests_is_accepted(rule):
    scene, strategies, where, patterns = RULES[rule]
    seen = []

    @settings(max_examples=25)
    @given(st.fixed_dictionaries(strategies))
    def suggestions_hold(values):
        sentence = faults_of(scene, [f"{key}={value}" for key, value in values.items()]).get(where, "")
        for key, text in suggested(sentence, patterns):
            after = faults_of(scene, [f"{each}={value}" for each, value in mended(values, key, text).items()])
            assert where not in after, (sentence, text)
            seen.append(text)

    suggestions_hold()
    assert seen, "nothing was suggested: the rule's words have changed"


def test_the_speed_that_a_periodic_ratio_of_radii_needs_is_taken_as_it_is_printed():
    radii = ("roller.radius=0.021", "roller.shaft_radius=0.0055")
    sentence = faults_of("roller_corrugation", (*radii, "roller.speed=50"))["roller.speed"]
    (speed,) = re.findall(rf"take {NUMBER} 1/s", sentence)
    assert float(speed) == pytest.approx(10 / 0.05 / (0.021 / 0.0055), rel=1e-9)
    assert faults_of("roller_corrugation", (*radii, f"roller.speed={speed}")) == {}


def test_a_number_below_a_bound_is_rounded_towards_0():
    for value in (2.2147234590350102, 3.1320919526731647, 9.9999999, 1e-7, 123456.7):
        assert value * (1.0 - 1e-3) < float(show_below(value, 4)) < value or math.isclose(value, 1e-7)
