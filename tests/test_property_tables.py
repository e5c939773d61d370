"""Each module of the laws and the pressure stands in a table of property tests, or here with its test.

A part that has no test of its own, as the steps of a rolling field, stands beside the test of the whole it belongs to.
"""

import pkgutil
from pathlib import Path

from tests.pressure.closed_form.test_closed_form_properties import TABLE as CLOSED_FORMS
from tests.pressure.field.test_pressure_properties import TABLE as FIELDS

from contact_sim_pkg import laws, pressure

TESTED_IN = {
    "laws.contact_force": "laws/test_force_laws.py",
    "laws.dynamic_stiffness": "laws/test_dynamic_stiffness.py",
    "laws.elastic_law": "laws/test_force_laws.py",
    "laws.foam_columns": "laws/test_foam_columns.py",
    "laws.foam_elastic": "laws/test_foam.py",
    "laws.foam_hysteresis": "laws/test_foam.py",
    "laws.friction": "laws/test_friction.py",
    "laws.general_dissipative": "laws/test_general_dissipative.py",
    "laws.normal_dissipative": "laws/test_force_laws.py",
    "laws.normal_elastic": "laws/test_force_laws.py",
    "laws.normal_force": "laws/test_force_laws.py",
    "laws.one_mass.parameters": "laws/test_absent_effects.py",
    "laws.one_mass.point_contact": "rigid/test_free_flight.py",
    "laws.one_mass.single": "integrate/test_orders.py",
    "laws.parameters": "laws/test_force_laws.py",
    "laws.point_friction": "laws/test_point_friction.py",
    "laws.restitution": "laws/test_restitution.py",
    "laws.restitution_law": "laws/test_restitution_law.py",
    "laws.tabulated_elastic": "laws/test_tabulated_elastic.py",
    "pressure.closed_form.jacobi": "pressure/closed_form/test_jacobi.py",
    "pressure.closed_form.lame": "pressure/closed_form/test_lame.py",
    "pressure.cushion.bonded_layer": "pressure/cushion/test_bonded_layer.py",
    "pressure.cushion.foam_layer": "pressure/cushion/test_foam_layer.py",
    "pressure.cushion.force_table": "pressure/cushion/test_force_table.py",
    "pressure.cushion.sitter": "pressure/cushion/test_sitter.py",
    "pressure.cushion.tissue": "pressure/cushion/test_tissue.py",
    "pressure.field.belt": "pressure/field/test_belt.py",
    "pressure.field.extent": "rigs/vehicle/tire/report/test_tire_metrics.py",
    "pressure.field.filtering": "pressure/field/test_filtering.py",
    "pressure.field.follow": "pressure/field/test_rolling.py",
    "pressure.field.instant": "pressure/field/test_rolling.py",
    "pressure.field.nested": "pressure/field/test_rolling.py",
    "pressure.field.outside": "pressure/field/test_outside.py",
    "pressure.field.prediction": "pressure/field/test_rolling.py",
    "pressure.field.rolling": "pressure/field/test_rolling.py",
    "pressure.field.window": "pressure/field/test_window.py",
    "pressure.field.winkler": "pressure/field/test_winkler.py",
    "pressure.kept_arrays": "pressure/cushion/test_force_table.py",
    "pressure.mat": "pressure/test_mat.py",
    "pressure.settings": "pressure/field/test_halfspace.py",
}


def test_every_module_of_laws_and_pressure_has_its_test():
    found = {
        module.name.removeprefix("contact_sim_pkg.")
        for package in (laws, pressure)
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
        if not module.ispkg
    }
    in_a_table = {case.name.rpartition(".")[0] for case in (*CLOSED_FORMS, *FIELDS)}
    assert found - in_a_table == set(TESTED_IN)


def test_the_test_of_each_module_is_there():
    here = Path(__file__).parent
    assert [path for path in TESTED_IN.values() if not (here / path).is_file()] == []
