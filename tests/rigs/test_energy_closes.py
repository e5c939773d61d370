"""No effect's energy is forgotten: with all that can act together, the ledger of each rig closes, and only so."""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.records.metric import MET, OUTSIDE
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.report.metrics.maker import energy_residual
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.studies.effects.reduced import all_together

BUMP_SOON = ("duration=0.2", "road.position=1.0")
ROLLED_TWICE = ("duration=4.1", "effects.roller.subsurface.instants=[0.0]")  # the second time over its own traces
SCENES = {  # rig -> scene, values, entries of the ledger that an effect could be forgotten in
    "tire": ("tire_bump", BUMP_SOON, "kinetic potential stored dissipated supplied"),
    "seat": ("seat_ride", ("duration=0.5",), "kinetic potential stored dissipated supplied"),
    "car": ("car_full_bench", ("duration=0.1",), "kinetic potential stored dissipated supplied"),
    "roller": ("roller_programme", ROLLED_TWICE, "stored supplied"),
    "impact": ("impact_rubber_drop", (), "kinetic potential dissipated"),
    "backrest": ("seat_slap", ("duration=0.5",), "kinetic potential stored dissipated supplied"),
    "block": ("block_fall", ("duration=0.5",), "kinetic potential stored dissipated"),
    "occupant": ("seat_ride_full", ("duration=0.5",), "kinetic potential stored dissipated supplied"),
}


def test_every_rig_is_here():
    assert {*SCENES} == {*rigs()}


@pytest.mark.parametrize("rig", SCENES)
def test_with_all_effects_the_ledger_closes_and_without_an_energy_it_does_not(rig, tmp_path):
    name, values, entries = SCENES[rig]
    scene = all_together(resolved(name, *values))
    assert run_offline(scene, tmp_path / "bag").failure == ""
    recording = read_recording(open_bag(tmp_path / "bag"))
    ledger = recording.ledger
    assert energy_residual(ledger, recording.duration, recording.scene).verdict == MET
    for entry in entries.split():
        kept = getattr(ledger, entry)
        open_ = ledger.residual + (-kept if entry == "supplied" else kept)
        lacking = ledger._replace(residual=open_, **{entry: numpy.zeros_like(kept)})
        assert energy_residual(lacking, recording.duration, recording.scene).verdict == OUTSIDE, entry
