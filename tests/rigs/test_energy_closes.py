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

CLEAT_SOON = ("duration=0.4", "road.position=0.6")
SHAKEN = ("duration=0.1", "vibration.amplitude=20")
SCENES = {  # rig, or part of it -> scene, values, entries of the ledger that an effect could be forgotten in
    "tire": ("tire_cleat", CLEAT_SOON, "kinetic potential stored dissipated supplied"),
    "seat": ("seat_ride", ("duration=0.5",), "kinetic potential stored dissipated supplied"),
    "car": ("car_full_bench", SHAKEN, "kinetic potential stored dissipated supplied"),
    "roller": ("roller_flutter", ("duration=1",), "kinetic potential stored supplied"),
    "roller heave": ("roller_corrugation", ("duration=2",), "potential stored dissipated supplied"),
    "impact": ("impact_rubber_drop", (), "kinetic potential dissipated"),
    "backrest": ("seat_slap", ("duration=0.5",), "kinetic potential stored dissipated supplied"),
    "block": ("block_fall", ("duration=0.5",), "kinetic potential stored dissipated"),
    "block alone": ("block_fall", ("duration=0.5",), "kinetic potential dissipated"),  # the one that is located
    "occupant": ("seat_ride_full", ("duration=0.5",), "kinetic potential stored dissipated supplied"),
}


def test_every_rig_is_here():
    assert {name.partition(" ")[0] for name in SCENES} == {*rigs()}


@pytest.mark.parametrize("part", SCENES)
def test_with_all_effects_the_ledger_closes_and_without_an_energy_it_does_not(part, tmp_path):
    name, values, entries = SCENES[part]
    scene = resolved(name, *values)
    if not part.endswith("alone"):
        scene = all_together(scene)
    assert run_offline(scene, tmp_path / "bag").failure == ""
    recording = read_recording(open_bag(tmp_path / "bag"))
    ledger = recording.ledger
    assert energy_residual(ledger, recording.duration, recording.scene).verdict == MET
    for entry in entries.split():
        kept = getattr(ledger, entry)
        open_ = ledger.residual + (-kept if entry == "supplied" else kept)
        lacking = ledger._replace(residual=open_, **{entry: numpy.zeros_like(kept)})
        assert energy_residual(lacking, recording.duration, recording.scene).verdict == OUTSIDE, entry
