"""Bags of closed forms, written once."""

import pytest
from tests.report import rolling_bag, synthetic_bag, uneven_bag
from tests.rigs.backrest.report import backrest_bag


@pytest.fixture(scope="session")
def car(tmp_path_factory):
    """Ten seconds of the synthetic car."""
    return synthetic_bag.car_bag(tmp_path_factory.mktemp("bags") / "car")


@pytest.fixture(scope="session")
def seat(tmp_path_factory):
    """Two seconds of the synthetic seat."""
    return synthetic_bag.seat_bag(tmp_path_factory.mktemp("bags") / "seat")


@pytest.fixture(scope="session")
def bare(tmp_path_factory):
    """A bag of force messages alone."""
    return synthetic_bag.bare_bag(tmp_path_factory.mktemp("bags") / "bare")


@pytest.fixture(scope="session")
def rolling(tmp_path_factory):
    """One second of the synthetic rolling tire."""
    return rolling_bag.rolling_bag(tmp_path_factory.mktemp("bags") / "rolling")


@pytest.fixture(scope="session")
def uneven(tmp_path_factory):
    """Seven blocks in which no two quantities are equal."""
    return uneven_bag.uneven_bag(tmp_path_factory.mktemp("bags") / "uneven")


@pytest.fixture(scope="session")
def backrest(tmp_path_factory):
    """Two seconds of the synthetic backrest, which slaps, with six contact points."""
    return backrest_bag.backrest_bag(tmp_path_factory.mktemp("bags") / "backrest", points=6)
