"""Message records against the definitions, as an independent parser reads them."""

import numpy
import pytest
from rosbags.interfaces import Nodetype
from rosbags.typesys import get_types_from_msg

from contact_sim_pkg.records import messages
from contact_sim_pkg.records.definitions import PACKAGE, STANDARD, definition_of, parsed, texts
from contact_sim_pkg.records.messages import BenchProgress, ContactForce, ContactPoints, RoadPatch, SolverCost

from .message_stub import STUB, stub

NAMES = sorted(name.rpartition("/")[2] for name in texts() if name.startswith(PACKAGE))


@pytest.mark.parametrize("type_name", texts())
def test_fields_and_constants_are_those_that_rosbags_finds(type_name):
    constants, fields = get_types_from_msg(texts()[type_name], type_name)[type_name]
    found = definition_of(type_name.rpartition("/")[2])
    assert found.constants == {name: value for name, _type, value in constants}
    assert [(each.name, each.is_array) for each in found.fields] == [
        (name, kind is Nodetype.SEQUENCE) for name, (kind, _detail) in fields
    ]


@pytest.mark.parametrize("name", NAMES)
def test_each_side_of_an_array_is_a_field_of_its_message(name):
    definition = definition_of(name)
    assert definition.sides <= {field.name for field in definition.fields}


@pytest.mark.parametrize("name", NAMES)
def test_a_record_has_the_fields_of_its_definition_but_the_header_and_what_a_shape_says(name):
    kept = set(getattr(messages, name)._fields)
    dropped = {field.name for field in definition_of(name).fields} - kept
    assert dropped <= {"header", "rows", "cols", "samples"}


def test_records_are_made_by_name_alone():
    with pytest.raises(TypeError, match="positional"):
        ContactForce(1, 1e-3)  # type: ignore[misc]
    with pytest.raises(TypeError, match="normal"):
        ContactForce(block=1, sample_period=1e-3)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="weight"):
        SolverCost(block=1, wall_time=1.0, real_time_factor=1.0, weight=2.0)  # type: ignore[call-arg]


def test_what_a_definition_lets_out_has_its_default():
    columns = dict.fromkeys(("normal", "tangential", "approach", "effective_height"), numpy.zeros(3))
    assert ContactForce(block=1, sample_period=1e-3, **columns).impulses.shape == (0,)
    cost = SolverCost(block=1, wall_time=1.0, real_time_factor=1.0, steps=4)
    assert (cost.steps, cost.events, cost.field_residual) == (4, 0, 0.0)


def test_constants_stand_beside_the_fields():
    assert (BenchProgress.IDLE, BenchProgress.FAILED, ContactPoints.SLIPS) == (0, 6, 3)


def test_the_sides_of_a_grid_are_no_fields_of_its_record():
    assert definition_of("RoadPatch").sides == {"rows", "cols"}
    assert set(RoadPatch._fields).isdisjoint({"header", "rows", "cols"})


def test_a_record_of_no_message_is_refused_by_name():
    with pytest.raises(ImportError, match="ContactForces"):
        from contact_sim_pkg.records.messages import ContactForces  # noqa: F401


def test_a_line_that_is_no_field_is_refused_with_its_text():
    with pytest.raises(ValueError, match=r"a/msg/A: 'float64\[3\] x' is no field"):
        parsed("a/msg/A", "float64[3] x\n")


def test_what_tools_see_is_made_from_the_definitions_of_today():
    """Otherwise: python -m tests.records.message_stub."""
    assert STUB.read_text(encoding="utf-8") == stub()


def test_standard_definitions_have_a_record_each():
    assert all(hasattr(messages, name.rpartition("/")[2]) for name in STANDARD)


def test_a_column_says_its_kind_and_other_columns_have_none():
    fields = {field.name: field for field in definition_of("AxleForce").fields}
    assert fields["longitudinal"].kind == "force"
    assert fields["longitudinal"].unit == "N"
    assert fields["moment_z"].kind == ""
    assert {field.name: field.kind for field in definition_of("ContactPatch").fields if field.kind} == {
        "peak": "peak",
        "area": "area",
    }


def test_a_kind_leaves_the_sides_of_an_array_as_they_are():
    position = next(field for field in definition_of("BodyMotion").fields if field.name == "position")
    assert position.shape == ("bodies", "samples")
    text = "float64[] time\nfloat64[] load # [N] of the contact; length time; kind force\n"
    assert parsed("mine/msg/Mine", text).fields[1].shape == ("time",)


def test_an_unknown_kind_is_refused():
    with pytest.raises(ValueError, match="load: kind 'forces' is none of force, motion, peak, area"):
        parsed("mine/msg/Mine", "float64 load # [N] of the contact; kind forces\n")


def test_an_array_with_a_kind_has_samples():
    """Values of two runs are compared at the same instants."""
    for name in texts():
        definition = definition_of(name.rpartition("/")[2])
        judged = [field for field in definition.record_fields if field.kind and field.is_array]
        assert not judged or {"sample_period", "period"} & {field.name for field in definition.fields}
