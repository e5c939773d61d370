"""`colcon test` runs a selection of the repository's tests (`pytest.ini` beside this folder); this one says where they
are missing.
"""

from pathlib import Path

import pytest

TESTS = Path(__file__).resolve().parents[2] / "tests"


def test_the_tests_of_the_repository_are_beside_the_package():
    if not TESTS.is_dir():
        pytest.skip(f"{TESTS} is not there: nothing of the package is tested; use a checkout of the whole repository")
