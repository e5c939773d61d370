"""Which effects go together: all subsets, against a table that is written out here."""

from itertools import combinations, pairwise

import pytest

from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.records.registry import contacts, effects

EFFECTS = (
    "normal_elastic", "normal_dissipative", "general_dissipative", "foam", "foam_hysteresis", "friction", "contact_field",
    "cushion", "half_space_field", "softening", "shell_modes", "contact_search", "rigid_ring", "envelopment",
    "tread_viscoelasticity", "brush", "sidewall_compliance", "wheel_spin", "asperity_impulses", "inflation",
    "shift", "contact_stress", "surface_waves", "micro_front", "thermal_volume", "history", "gauge_noise",
    "rigid_contact", "compliant_contact",
    "tilt_yaw", "gyroscope", "rolling_friction", "shaft_bending", "track_waves", "subsurface", "damage",
)  # fmt: skip
TIRE_ONLY = {
    "inflation", "rigid_ring", "envelopment", "tread_viscoelasticity", "brush", "sidewall_compliance", "wheel_spin",
    "asperity_impulses",
}  # fmt: skip
OF_THE_ROLLER = (
    "tilt_yaw", "gyroscope", "rolling_friction", "shaft_bending", "track_waves", "subsurface", "damage",
)  # fmt: skip
BODY_ONLY = ("rigid_contact", "compliant_contact", *OF_THE_ROLLER)
"""Of the rigid body on the ground, and of the roller on its shaft."""
SEAT_ONLY = {
    "general_dissipative",
    "foam",
    "foam_hysteresis",
    "friction",
    "cushion",
    "half_space_field",
    "softening",
}
"""Of the vehicle's contacts."""
IN_THE_FIELD = {"envelopment", "tread_viscoelasticity", "brush"}
"""What acts cell by cell, and so needs the pressure field."""
OF_THE_BACK = (
    "normal_elastic", "normal_dissipative", "general_dissipative", "foam", "foam_hysteresis", "friction", "shell_modes",
    "contact_search", "cushion",
)  # fmt: skip
ELSEWHERE = set(EFFECTS) - set(OF_THE_BACK)
OF_THE_IMPACT = (
    "shift", "contact_stress", "surface_waves", "micro_front", "thermal_volume", "history", "gauge_noise",
)  # fmt: skip
OF_FOAM = ("foam", "foam_hysteresis", "cushion", "half_space_field", "softening")
SHELL = ("shell_modes", "contact_search")
OF_VEHICLES = tuple(name for name in EFFECTS if name not in (*SHELL, *OF_FOAM, *OF_THE_IMPACT, *BODY_ONLY))
SUBSETS = {
    "tire": [set(chosen) for count in range(len(OF_VEHICLES) + 1) for chosen in combinations(OF_VEHICLES, count)]
    + [{"normal_elastic", name} for name in (*SHELL, *OF_FOAM, *OF_THE_IMPACT, *BODY_ONLY)],
    "backrest": [set(chosen) for count in range(10) for chosen in combinations(OF_THE_BACK, count)]
    + [{"normal_elastic", name} for name in sorted(ELSEWHERE)],
    "impact": [
        set(chosen)
        for count in (0, 1, 2, 3, 8, 9)
        for chosen in combinations(("normal_elastic", "normal_dissipative", *OF_THE_IMPACT), count)
    ]
    + [{"normal_elastic", "friction"}, {"normal_elastic", "contact_field"}],
    "roller": [set(chosen) for count in range(9) for chosen in combinations(("normal_elastic", *OF_THE_ROLLER), count)]
    + [{"normal_elastic", "friction"}, {"normal_elastic", "rigid_contact"}],
    "seat": [set(chosen) for count in range(10) for chosen in combinations(EFFECTS[:9], count)]
    + [{"normal_elastic", name} for name in sorted(TIRE_ONLY)],
}


def stands_on_the_others(named):
    """A wheel that spins needs a belt that yields, and that bristles."""
    chain = ("brush", "sidewall_compliance", "wheel_spin")
    return all(first in named or second not in named for first, second in pairwise(chain))


def allowed(contact, named):
    """Whether these effects may stand together, written out once more."""
    refused = {
        "tire": {*SEAT_ONLY, *SHELL, *OF_THE_IMPACT, *BODY_ONLY},
        "seat": {*TIRE_ONLY, *SHELL, *OF_THE_IMPACT, *BODY_ONLY},
        "backrest": ELSEWHERE, "roller": set(EFFECTS) - {"normal_elastic", *OF_THE_ROLLER},
        "impact": set(EFFECTS) - {"normal_elastic", "normal_dissipative", *OF_THE_IMPACT},
    }[contact]  # fmt: skip
    if named & {"surface_waves", "history"} and "normal_dissipative" not in named:
        return False
    if len(named & {"normal_elastic", "cushion", "inflation"}) != 1 or named & refused:
        return False
    if named >= {"inflation", "envelopment"} or not stands_on_the_others(named):
        return False
    if "cushion" in named and named & {"foam", "shell_modes", "half_space_field"}:
        return False
    if contact == "seat":
        if "contact_field" in named and "cushion" not in named:
            return False
        if "half_space_field" in named and named & {"foam", "foam_hysteresis"}:
            return False
    if named & {"gyroscope", "rolling_friction"} and "tilt_yaw" not in named:
        return False
    if "damage" in named and not named >= {"track_waves", "subsurface"}:
        return False
    if ("contact_search" in named and "shell_modes" not in named) or named >= {
        "normal_dissipative",
        "general_dissipative",
    }:
        return False
    return "contact_field" in named or not named & IN_THE_FIELD


def test_the_records_are_exactly_these_effects():
    assert set(effects()) == set(EFFECTS)


@pytest.mark.parametrize("contact", ["tire", "seat", "backrest", "impact", "roller"])
def test_every_set_of_effects_is_allowed_or_refused_as_tabled(maker, contact):
    for named in SUBSETS[contact]:
        faults = maker.faults(contact, {f"effects.{contact}": {name: {} for name in named}})
        assert (faults == []) == allowed(contact, named), named


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
