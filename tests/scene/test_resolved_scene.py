"""A resolved scene hands out typed sections and effects."""

import subprocess
import sys

import pytest
from pydantic import ValidationError
from tests.run.scenes import resolved

from contact_sim_pkg.records.fields import Section
from contact_sim_pkg.rigs.backrest.schema import BackrestSection
from contact_sim_pkg.rigs.vehicle.tire.mount_section import MountSection
from contact_sim_pkg.rigs.vehicle.tire.schema import BrushSection, Envelopment, Inflation, TireField, TireSection
from contact_sim_pkg.scene.resolved_scene import MAY_BE_LEFT_OUT, plain
from contact_sim_pkg.scene.schema import general, travel
from contact_sim_pkg.scene.schema.laws import HuntCrossley
from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection


@pytest.fixture(scope="module")
def scene():
    return resolved("tire_braking", "tire.wheel_mass=33.0")


def test_a_section_has_the_values_of_the_scene(scene):
    assert scene.section(TireSection).wheel_mass == 33.0
    with pytest.raises(KeyError, match="the rig tire has no section BackrestSection"):
        scene.section(BackrestSection)


def test_an_effect_is_found_by_its_class_or_one_above_it_and_is_none_where_it_is_absent(scene):
    assert isinstance(scene.effect("tire", BrushSection), BrushSection)
    assert isinstance(scene.effect("tire", PressureFieldSection), TireField)
    assert scene.effect("tire", HuntCrossley).damping == 0.015
    assert scene.effect("tire", Envelopment) is None
    assert scene.effect("seat", HuntCrossley) is None


def test_a_value_that_the_schema_refuses_is_seen_where_it_is_read(scene):
    changed = type(scene)({**scene.data, "tire": {**scene.data["tire"], "wheel_mass": -1.0}})
    with pytest.raises(ValidationError):
        changed.section(TireSection)


def test_plain_keys_are_attributes_and_absent_ones_none(scene):
    assert scene.outputs.force_rate == scene.data["outputs"]["force_rate"]
    assert scene.vibration is None
    assert plain({"a": {"b": 2.0}}).a.b == 2.0
    assert plain({"speed": 1.0}).points is None


def test_a_name_that_no_section_may_leave_out_is_refused():
    with pytest.raises(AttributeError, match="no key 'heigth'"):
        assert plain({"height": 1.0}).heigth
    kinds = [
        *vars(general).values(),
        *vars(travel).values(),
        PressureFieldSection,
        Inflation,
        TireSection,
        MountSection,
    ]
    sections = [kind for kind in kinds if isinstance(kind, type) and issubclass(kind, Section)]
    optional = {
        name
        for kind in sections
        for name, field in kind.model_fields.items()
        if not field.is_required() and field.default is None
    }
    assert optional == MAY_BE_LEFT_OUT


def test_the_keys_of_every_scene_are_read_without_the_schema():
    code = (
        "import sys; from contact_sim_pkg.scene.resolved_scene import ResolvedScene as Scene;"
        "scene = Scene({'rig': 'seat', 'travel': {'speed': 5.0}}); assert scene.travel.speed == 5.0;"
        "sys.exit('pydantic' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
