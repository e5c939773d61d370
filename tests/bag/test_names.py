"""Names of bags never leave the folder of bags."""

import re
from datetime import datetime, timezone
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from contact_sim_pkg.bag.names import default_directory, safe_name

HOSTILE = st.one_of(
    st.text(), st.sampled_from(["../x", "/etc/passwd", "a\nb", "x" * 300, "..", ".", "", "~", "-rf", "é"])
)


@given(HOSTILE)
def test_any_text_becomes_one_plain_path_component(text: str) -> None:
    name = safe_name(text)
    assert re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9._-]{0,99}", name)
    assert Path("bags", name).resolve().parent == Path("bags").resolve()


@given(HOSTILE)
def test_the_default_directory_stays_inside_its_root_and_is_short(text: str) -> None:
    directory = default_directory(text, Path("bags"))
    assert directory.parent == Path("bags")
    assert len(directory.name) <= 100


def test_a_plain_name_stays_as_it_is_with_utc_time_and_suffix() -> None:
    moment = datetime(2025, 3, 4, 5, 6, 7, tzinfo=timezone.utc)
    assert default_directory("seat_ride", now=moment, token="0a1b2c") == Path("bags/seat_ride_20250304T050607Z_0a1b2c")


def test_two_bags_of_one_second_differ() -> None:
    moment = datetime(2025, 3, 4, tzinfo=timezone.utc)
    assert default_directory("a", now=moment) != default_directory("a", now=moment)
