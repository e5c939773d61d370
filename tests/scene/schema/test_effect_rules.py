"""Which effects go together: pairs and triples of every contact's effects, as their records say."""

from itertools import combinations

import pytest

from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.records.registry import contacts, effects

KEYS = {"magic_formula": {"file": "data/car_205_55R16.tir"}}
"""Of effects that have no defaults."""


def allowed(contact, named):
    """Whether effects may stand together: one carries the load, each has what it needs, none excludes another."""
    own = {effect.name: effect for effect in contact.effects}
    carriers = named & set(contact.carriers)
    if len(carriers) != 1 or not named <= set(own):
        return False
    usual = contact.carriers[0]
    have = named | ({usual} if carriers else set())  # what needs the usual carrier is content with another
    return all(set(own[name].needs) <= have and not named & set(own[name].excludes) for name in named)


@pytest.mark.parametrize("contact", contacts().values(), ids=contacts())
def test_pairs_and_triples_of_effects_are_allowed_or_refused_as_their_records_say(maker, contact):
    names = [effect.name for effect in contact.effects]
    chosen = [set(names), *({name} for name in names)]
    chosen += [
        {carrier, *few} for carrier in contact.carriers for count in (1, 2) for few in combinations(names, count)
    ]
    chosen += [{carrier, *closed(contact, name)} for carrier in contact.carriers for name in names]
    others = set(effects()) - set(names)
    chosen += [{contact.carriers[0], other} for other in sorted(others)]
    for named in {frozenset(each) for each in chosen}:
        faults = maker.faults(
            contact.name, {f"effects.{contact.name}": {name: KEYS.get(name, {}) for name in sorted(named)}}
        )
        assert (faults == []) == allowed(contact, named), sorted(named)


def closed(contact, name):
    """An effect with all that it needs, and what that needs."""
    own = {effect.name: effect for effect in contact.effects}
    named, new = set(), {name}
    while new:
        named |= new
        new = {need for each in new for need in own[each].needs} - named
    return named


@pytest.mark.parametrize(
    ("name", "needed"),
    [("envelopment", "contact_field"), ("brush", "contact_field"), ("tread_viscoelasticity", "contact_field")],
)
def test_an_effect_without_what_it_needs_names_both(maker, name, needed):
    (fault,) = maker.faults("tire", {"effects.tire": {"normal_elastic": {}, name: {}}})
    assert fault.startswith(f"effects.tire.{name}: {name} needs {needed}")


@pytest.mark.parametrize("name", ["normal_dissipative", "general_dissipative", "friction", "half_space_field"])
def test_without_an_effect_that_carries_the_load_that_alone_is_said(maker, name):
    (fault,) = maker.faults("seat", {"effects.seat": {name: {}}})
    assert fault.startswith(
        "effects.seat.normal_elastic: is missing: the contact seat carries no load without it or cushion"
    )


@pytest.mark.parametrize("value", [True, [], {"thicknes": 0.08}])
def test_an_effect_that_carries_the_load_but_is_faulty_is_not_missing(maker, value):
    (fault,) = maker.faults("seat", {"effects.seat": {"cushion": value, "foam_hysteresis": {}, "friction": {}}})
    assert fault.startswith("effects.seat.cushion")


def test_what_is_needed_but_faulty_is_not_missing(maker):
    (fault,) = maker.faults("tire", {"effects.tire": {"normal_elastic": {}, "contact_field": True, "brush": {}}})
    assert fault.startswith("effects.tire.contact_field")


def test_friction_at_the_tire_is_refused_as_an_effect_not_as_a_misspelling(maker):
    (fault,) = maker.faults("tire", {"effects.tire.friction": {}})
    assert "the effect friction is not available at the contact tire, only at seat and backrest" in fault


@pytest.mark.parametrize(("rig", "contact"), [("tire", "seat"), ("seat", "tire")])
def test_a_contact_that_the_rig_lacks_is_refused(maker, rig, contact):
    (fault,) = maker.faults(rig, {f"effects.{contact}": {"normal_elastic": {}}})
    assert fault.startswith(f"effects.{contact}: the rig {rig} has no contact {contact}")


@pytest.mark.parametrize(("rig", "contact"), [("tire", "tire"), ("seat", "seat"), ("car", "tire"), ("car", "seat")])
def test_a_contact_of_the_rig_without_elastic_force_is_refused(maker, rig, contact):
    (fault,) = maker.faults(rig, {f"effects.{contact}": ...})
    assert fault.startswith(f"effects.{contact}.normal_elastic: is missing")


def test_effects_that_exclude_each_other_are_both_named(maker):
    (fault,) = maker.faults("seat", {"effects.seat.foam": {}, "effects.seat.half_space_field": {}})
    assert "foam and half_space_field exclude each other" in fault


@pytest.mark.parametrize("contact", contacts().values(), ids=contacts())
def test_a_record_names_effects_and_topics_that_its_contact_has(contact):
    names = [effect.name for effect in contact.effects]
    assert len(set(names)) == len(names)
    assert tuple(effect.name for effect in contact.effects if effect.carries) == contact.carriers != ()
    for effect in contact.effects:
        assert {*effect.needs, *effect.excludes} <= {*names} - {effect.name}
        assert f"{contact.name}/{effect.publishes or contact.topics[0].name}" in TOPICS
        assert not effect.publishes or effect.publishes in effect.feeds
