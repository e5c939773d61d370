"""`bench effects`: rows of a scene."""

import numpy
import pytest

from contact_sim_pkg.compare.changes import Change
from contact_sim_pkg.records.effect import Observed
from contact_sim_pkg.records.registry import effects
from contact_sim_pkg.studies.effects import ablation


@pytest.mark.parametrize(
    ("effect", "opens", "needed"),
    [("normal_dissipative", True, True), ("normal_dissipative", False, None), ("foam_hysteresis", True, None)],
)
def test_a_contact_that_opens_needs_a_loss(effect, opens, needed):
    observed = Observed({"backrest": numpy.ones(1)}, {"backrest": opens}, 0.0)
    assert effects()[effect]["backrest"].called_for(None, observed)[0] is needed


def test_an_effect_that_the_scene_cannot_take_has_a_row_with_the_reason():
    """Radii that change and heights of the track do not go together: the table stands all the same."""
    rows = {row["effect"]: row for row in ablation.study("roller_steady")}
    assert rows["track_waves"]["verdict"] == "not available"
    assert "the scene does not take it: roller." in rows["track_waves"]["why"]
    assert rows["subsurface"]["cost"] > 0.0
    assert Change("roller/volumes", "only with it", None)._asdict() in rows["subsurface"]["changes"]
