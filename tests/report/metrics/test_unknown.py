"""A number that is none, anywhere in a bag of the bench: every metric of its topic is marked, and the page is made."""

import math

import numpy
import pytest
from tests.report import synthetic_bag as known

from contact_sim_pkg.records.messages import BodyMotion, ContactForce, ContactPatch, EnergyLedger
from contact_sim_pkg.report.metrics.listing import all_metrics
from contact_sim_pkg.report.metrics.views import verdict_text
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.report import write_report

BLOCKS, AT = 60, 30
FIELDS = {
    "tire/force": (ContactForce, ("normal", "tangential", "approach")),
    "tire/patch": (ContactPatch, ("pressure", "load", "peak", "area", "centre_x")),
    "bench/motion": (BodyMotion, ("position", "velocity", "acceleration")),
    "bench/energy": (EnergyLedger, ("kinetic", "dissipated", "supplied", "residual")),
}


def spoil(monkeypatch, kind, topic, field, value):
    """From now on block AT has one such value in this field of a topic."""
    make = known._ENCODERS[topic]

    def spoilt(block, *more):
        encode = known.encode
        if block != AT:
            return make(block, *more)
        with monkeypatch.context() as patch:
            patch.setattr(known, "encode", lambda record, *rest: encode(_with(record, field, value), *rest))
            return make(block, *more)

    monkeypatch.setitem(known._ENCODERS, topic, spoilt)


def _with(record, field, value):
    content = getattr(record, field)
    if isinstance(content, numpy.ndarray):
        content = content.copy()
        content[(0,) * content.ndim] = value
        value = content
    return record._replace(**{field: value})


@pytest.mark.fault("A16")
@pytest.mark.parametrize("topic", FIELDS)
def test_every_metric_of_the_topic_is_marked(topic, tmp_path, monkeypatch):
    kind, fields = FIELDS[topic]
    clean = {each.key: each for each in all_metrics(read_recording(known.car_bag(tmp_path / "clean", BLOCKS)))}
    of_topic = {key for key, each in clean.items() if each.topic == topic}
    assert of_topic or topic == "bench/energy"  # the page alone shows it in a car
    assert not any("unknown" in text for each in clean.values() for text in each.broken)
    for field, value in zip(fields * 2, [math.nan] * len(fields) + [math.inf] * len(fields), strict=True):
        with monkeypatch.context() as patch:
            spoil(patch, kind, topic, field, value)
            bag = known.car_bag(tmp_path / f"{field}_{value}", BLOCKS)
        found = {each.key: each for each in all_metrics(read_recording(bag))}
        marked = f"{topic}: unknown samples: {field} {value:g} in the message at 0.3 s"
        assert (
            {key for key, each in found.items() if marked in each.broken}
            == {key for key, each in found.items() if each.topic == topic}
            >= of_topic
        ), field
        assert not {verdict_text(found[key]) for key in of_topic} & {"good", "usual"}
    write_report(bag, tmp_path / "page.html")  # of the last one
