"""Grid and accuracy of a scene's pressure field. Knows no kernels, as the node that sends the road."""

from __future__ import annotations

from typing import TYPE_CHECKING

from contact_sim_pkg.pressure.settings import BeltSettings, FieldSettings, InflatedBelt

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection

FIELD_ITERATIONS = 400


def field_settings(
    field: PressureFieldSection | None, modulus: float, belt: BeltSettings | InflatedBelt | None = None
) -> FieldSettings | None:
    """Grid and accuracy of a resolved pressure field over a ``modulus`` [Pa]; None where the scene
    calls for none.
    """
    if field is None:
        return None
    # A resolved scene leaves none of these open.
    length, width, rows, cols = field.length, field.width, field.rows, field.cols
    tolerance, passes = field.tolerance, field.corrector_passes
    assert length is not None
    assert width is not None
    assert rows is not None
    assert cols is not None
    assert tolerance is not None
    assert passes is not None
    return FieldSettings(
        rows=rows,
        cols=cols,
        cell_x=length / rows,
        cell_y=width / cols,
        modulus=modulus,
        tolerance=tolerance,
        maximum_iterations=FIELD_ITERATIONS,
        corrector_passes=passes,
        belt=belt,
    )
