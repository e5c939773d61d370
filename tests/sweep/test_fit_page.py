"""The page of a fit, of results made by hand."""

import math

import numpy
import pytest

from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.sweep.fit_page import answer_of_fit, write_fit_page
from contact_sim_pkg.sweep.fit_result import Compared, Fit, Fitted

MODULUS = Fitted("impact.modulus", 7.29525e6, 7.08921e6, 7.50728e6, "")
UNSEEN = Fitted("impact.modulus", 7.29525e6, math.nan, math.nan, "not identifiable beside impact.mass")
ACROSS = numpy.arange(1.0, 4.0)


def fitted(parameter=MODULUS, axis="row of the table", **others):
    compared = Compared("impact.duration, ms", ACROSS, ACROSS + 1.0, ACROSS + 1.1, axis)
    return Fit([parameter], 0.5, "of its scatter", 0.4, 0.0, 48, {}, [compared])._replace(**others)


@pytest.mark.parametrize(
    ("found", "word"),
    [
        (fitted(), "Follows"), (fitted(UNSEEN), "Not identifiable"), (fitted(probability=math.nan), "Fitted"),
        (fitted(probability=1e-9), "Does not follow"), (fitted(probability=1e-9, coarse=1e-2), "Not judged"),
        (fitted(probability=1e-9, coarse=1e-2, recorded=1e-2), "Not judged"), (fitted(others=[[9e6]]), "Two answers"),
    ],
)  # fmt: skip
def test_the_worst_that_holds_comes_first(found, word):
    answer = answer_of_fit(found)
    assert answer.word == word
    assert ("7.08921e+06 to 7.50728e+06" in answer.text) == (word not in ("Not identifiable", "Does not follow"))


def test_another_minimum_and_a_recording_that_is_too_coarse_are_said_with_their_numbers():
    assert "impact.modulus 9e+06" in answer_of_fit(fitted(others=[[9e6]])).text
    assert "made at 0.001 decides" in answer_of_fit(fitted(probability=1e-9, coarse=1e-2, recorded=1e-2)).text


@pytest.mark.parametrize("axis", ["row of the table", "time, s", "frequency, Hz"])
def test_a_page_is_made_again_and_another_file_is_not(tmp_path, axis):
    page = tmp_path / "fit.html"
    for _ in range(2):
        write_fit_page(page, "impact_rubber_drop", fitted(axis=axis))
    text = page.read_text()
    assert "7.08921e+06" in text
    assert axis in text
    page.write_text("<!DOCTYPE html><title>somebody's</title>")
    with pytest.raises(FileRefusedError):
        write_fit_page(page, "impact_rubber_drop", fitted(axis=axis))
