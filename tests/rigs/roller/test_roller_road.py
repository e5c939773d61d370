"""A measured road as kinetic disturbance of the roller."""

import math

import numpy
import pytest
from tests.excitation import crg_file
from tests.rigs.roller.test_simulation import BARE, column, run

AMPLITUDE, WAVE, SPACING = 1e-6, 0.1, 0.001  # [m]; straight from place to place
SPEED = 2.0 * math.pi * 0.02 * 50.0  # [m/s] of the roller on the shaft


@pytest.mark.parametrize("local_curvature", ["off", "on"])
def test_an_opencrg_road_moves_the_roller_as_a_harmonic_base(tmp_path, local_curvature):
    """0.1 m at 6.28 m/s, 62.8 Hz, below a natural frequency of 447 Hz: 1 / (1 - r^2) as high, the load of mass and drag."""
    rows = 1201
    heights = AMPLITUDE * numpy.sin(2.0 * math.pi * SPACING * numpy.arange(rows) / WAVE)
    numbers = numpy.repeat(heights[:, None], 3, axis=1).tolist()
    path = crg_file.write(tmp_path / "road.crg", "KDBI", numbers, rows=rows, increment=SPACING, phi=False)
    values = (*BARE, f"road={{kind: opencrg, file: {path}}}", "outputs.force_rate=20000")
    local = f"effects.roller.track_waves.local_curvature={local_curvature}"
    _scene, messages = run("roller_corrugation", *values, "effects.roller.damage.table_rows=2", local)
    heave, load = column(messages, "heave"), column(messages, "load")
    late = slice(len(heave) // 2, None)
    ratio = SPEED / WAVE / 446.757
    frequency = 2.0 * math.pi * SPEED / WAVE
    swing = 0.5 * numpy.ptp(heave[late])
    assert swing == pytest.approx(AMPLITUDE / (1.0 - ratio**2), rel=0.02)
    push = 0.175 * frequency * swing * math.hypot(frequency, 2.0 * 0.05 * 446.757 * 2.0 * math.pi)
    assert 0.5 * numpy.ptp(load[late]) == pytest.approx(push, rel=0.03)
