"""Rainflow cycles: the example of ASTM E1049, figure 6, and the damage of a constant amplitude."""

import builtins

import numpy as np
import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.report.signal.cycles import rainflow_cycles


def test_the_example_of_the_standard():
    found = rainflow_cycles(np.array([-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]))
    counts = {span: found.counts[found.ranges == span].sum() for span in np.unique(found.ranges)}
    assert counts == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}


def test_cycles_of_one_range_are_equivalent_to_themselves():
    """And half as many, with twice their number, to 2^(1/m) of the range."""
    found = rainflow_cycles(np.tile([1.0, 5.0], 51))
    total = found.counts.sum()
    assert found.equivalent(3.0, total) == pytest.approx(4.0)
    assert found.equivalent(5.0, 0.5 * total) == pytest.approx(4.0 * 2.0**0.2)


def test_without_the_library_the_sentence_says_what_to_install(monkeypatch):
    usual = builtins.__import__

    def refused(name, *given, **named):
        if name == "rainflow":
            raise ImportError(name)
        return usual(name, *given, **named)

    monkeypatch.setattr(builtins, "__import__", refused)
    with pytest.raises(BagError, match=r"pip install 'contact_sim_pkg\[fatigue\]'"):
        rainflow_cycles(np.array([0.0, 1.0, 0.0]))
