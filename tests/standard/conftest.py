"""A short run of the car, and its export."""

import pytest
from tests.bench_process import resolved

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.standard.export import export_standard


@pytest.fixture(scope="session")
def recorded_car(tmp_path_factory):
    """0.3 s of the full car: road, tire, suspension, seat, occupant, two pressure fields."""
    path = tmp_path_factory.mktemp("standard") / "car"
    run_offline(resolved("car_full_bench", "duration=0.3"), path)
    return path


@pytest.fixture(scope="session")
def exported_car(recorded_car):
    """The same as standard messages, 20 a second of a topic."""
    path = recorded_car.with_name("car_std")
    export_standard(open_bag(recorded_car), path)
    return path
