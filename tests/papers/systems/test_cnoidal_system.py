"""System *cnoidal*: the motion of a quadratic oscillator is one term of cn^2, whose parameter follows from its turning
points.
"""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from contact_sim_lab.papers.driver_seat.system_cnoidal import cnoidal, last_period
from contact_sim_lab.records.paper import PaperError

VALUES = {"contact": "backrest", "column": "approach", "frequency": 0.0, "terms": 1}
STIFFNESS, QUADRATIC, RELEASE = 987.0, 6e4, 0.006


def motion():
    """y'' = -w^2 y - k y^2 from rest, by scipy; its turning points y1 < y2 < y3; its period 2 K(m)/W."""
    level = QUADRATIC * RELEASE**3 / 3.0 + 0.5 * STIFFNESS * RELEASE**2
    y1, y2, y3 = sorted(numpy.roots([QUADRATIC / 3.0, 0.5 * STIFFNESS, 0.0, -level]).real)
    m = (y3 - y2) / (y3 - y1)
    period = 2.0 * ellipk(m) / math.sqrt(QUADRATIC * (y3 - y1) / 6.0)
    time = numpy.linspace(0.0, 3.3 * period, 800)
    found = solve_ivp(lambda _, s: [s[1], -STIFFNESS * s[0] - QUADRATIC * s[0] ** 2], (0.0, time[-1]), [RELEASE, 0.0],
                      t_eval=time, rtol=1e-11, atol=1e-14)  # fmt: skip
    return time, found.y[0], m, period


def test_the_fit_finds_the_parameter_of_the_exact_motion(tmp_path):
    time, values, m, period = motion()
    path = tmp_path / "motion.csv"
    rows = "\n".join(f"{t!r},{y!r}" for t, y in zip(time.tolist(), values.tolist(), strict=True))
    path.write_text(f"# a motion\ntime,value\n{rows}\n", encoding="utf-8")
    result = cnoidal(path, VALUES)
    assert result.rows[0]["residual"] < 1e-5
    term = result.rows[3]
    # Without the quotient only the sum of both amplitudes is determined: y3 - y2, twice the size of the cn^2 motion.
    assert term["alpha"] is None
    assert term["beta"] is None
    assert term["alpha_plus_beta"] == pytest.approx(values.max() - values.min(), rel=1e-4)
    # B of eq A5: q = exp(B/2) = exp(-pi K(1 - m)/K(m)).
    assert term["m"] == pytest.approx(m, rel=1e-3)
    assert term["B"] == pytest.approx(-2.0 * math.pi * ellipk(1.0 - term["m"]) / ellipk(term["m"]), rel=1e-9)
    assert term["A5_difference"] < 1e-12
    assert last_period(time, values).frequency == pytest.approx(1.0 / period, rel=1e-6)


def test_a_requested_frequency_is_taken_and_two_periods_are_needed():
    time = numpy.linspace(0.0, 1.0, 400)
    values = numpy.cos(2.0 * math.pi * 5.0 * time)
    assert last_period(time, values, 5.0).mismatch < 1e-6
    assert last_period(time, values, 4.0).mismatch > 0.1
    with pytest.raises(PaperError, match=r"holds 1\.5 periods of 1\.5 Hz; two are needed"):
        last_period(time, values, 1.5)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("time,height\n0,1\n", "columns time, value are needed, not time, height"),
        ("time,value\n0,1\n", "1 rows of numbers, at least 8 are needed"),
        ("time,value\n" + "0,1\n" * 9, "time does not rise"),
        ("time,value\n" + "\n".join(f"{k},x" for k in range(9)), "line 2: value: 'x' is no number"),
        ("", "holds no line"),
    ],
)
def test_a_table_that_is_no_motion_is_refused_by_line(tmp_path, text, sentence):
    path = tmp_path / "motion.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(PaperError, match=sentence):
        cnoidal(path, VALUES)
