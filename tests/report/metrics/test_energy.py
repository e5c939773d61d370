"""The balance of energy is judged in every run, by what its ledger leaves open."""

import pytest
from tests.report import synthetic_bag as known

from contact_sim_pkg.records.metric import MET, OUTSIDE
from contact_sim_pkg.report.metrics.listing import all_metrics, metrics_of
from contact_sim_pkg.report.reading import read_recording

KEY = "energy.residual"


def residual_of(bag):
    recording = read_recording(bag)
    lists = [{each.key: each for each in make(recording)} for make in (metrics_of, all_metrics)]
    assert lists[0].get(KEY) == lists[1].get(KEY)
    return lists[0].get(KEY)


@pytest.mark.parametrize("make", [known.car_bag, known.seat_bag], ids=["car", "seat"])
def test_a_balance_that_closes_is_good(make, tmp_path):
    found = residual_of(make(tmp_path / "bag", 200))
    assert found.value == pytest.approx(known.RESIDUAL / known.SUPPLIED)
    assert (found.verdict, found.band.high, found.topic) == (MET, 0.01, "bench/energy")
    assert found.name == "energy residual"  # of the run, not of a contact


def test_an_energy_that_is_left_out_lies_outside(tmp_path, monkeypatch):
    encode = known.encode

    def without_dissipated(record, *more):
        if type(record).__name__ == "EnergyLedger":
            record = record._replace(residual=record.residual + record.dissipated, dissipated=0.0)
        return encode(record, *more)

    monkeypatch.setattr(known, "encode", without_dissipated)
    found = residual_of(known.car_bag(tmp_path / "bag", 200))
    assert found.value == pytest.approx((known.RESIDUAL + known.DISSIPATED) / known.SUPPLIED)
    assert found.verdict == OUTSIDE


def test_a_bag_without_a_ledger_has_no_such_metric(tmp_path):
    assert residual_of(known.bare_bag(tmp_path / "bag")) is None


def test_a_balance_in_which_nothing_is_exchanged_is_not_judged(tmp_path, monkeypatch):
    encode = known.encode

    def at_rest(record, *more):
        if type(record).__name__ == "EnergyLedger":
            record = record._replace(residual=0.0, supplied=0.0, kinetic=0.0, potential=0.0, stored=0.0, dissipated=0.0)
        return encode(record, *more)

    monkeypatch.setattr(known, "encode", at_rest)
    assert residual_of(known.car_bag(tmp_path / "bag", 200)) is None
