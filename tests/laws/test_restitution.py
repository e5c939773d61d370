import math

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_lab.twins import impact
from contact_sim_pkg.laws.restitution import damping_of_restitution


@pytest.mark.parametrize(
    ("restitution", "loss"),
    [
        (0.95, 0.07893),
        (0.90, 0.16648),
        (0.80, 0.37315),
        (0.70, 0.63483),
        (0.50, 1.43275),
        (0.30, 3.08708),
        (0.10, 9.99816),
    ],
)
def test_the_damping_is_that_of_the_published_table(restitution, loss):
    assert damping_of_restitution(restitution, 1.0) == pytest.approx(loss, abs=6e-6)


@pytest.mark.parametrize("restitution", [0.011, 0.05, 0.1, 0.2, 1 / 3, 0.39999, 0.4, 0.5, 0.75, 0.9, 0.99, 0.9999])
@pytest.mark.parametrize("speed", [1e-3, 0.5, 20.0])
def test_the_damping_inverts_the_exact_relation(restitution, speed):
    exact = impact.damping_of_restitution(restitution, speed)
    assert damping_of_restitution(restitution, speed) == pytest.approx(exact, rel=2e-8)
    assert impact.restitution(damping_of_restitution(restitution, speed) * speed) == pytest.approx(
        restitution, abs=1e-12
    )


def test_no_loss_gives_no_damping():
    assert damping_of_restitution(1.0, 0.3) == 0.0


@pytest.mark.parametrize("restitution", [0.0, 0.0099, 1.01, -1.0, math.nan])
def test_a_restitution_outside_its_range_is_refused_with_its_value(restitution):
    with pytest.raises(ValueError, match=str(restitution)):
        damping_of_restitution(restitution, 1.0)


@settings(max_examples=60)
@given(st.one_of(st.floats(0.01, 1.0), st.floats(1e-16, 1e-3).map(lambda loss: 1.0 - loss)), st.floats(0.0, 1e6))
def test_the_damping_is_right_over_the_whole_range(restitution, speed):
    """Against the root of the exact relation in 60 digits; the speed counts from 1 mm/s."""
    damping = damping_of_restitution(restitution, speed) * max(speed, 1e-3)
    with mpmath.workdps(60):
        e = mpmath.mpf(restitution)

        def relation(d):
            return d * (1 + e) - mpmath.log((1 + d) / (1 - d * e))

        if e == 1:
            assert damping == 0.0
            return
        low, high = damping * (1 - mpmath.mpf("1e-8")), damping * (1 + mpmath.mpf("1e-8"))
        assert relation(low) * relation(min(high, (1 - mpmath.mpf(10) ** -50) / e)) < 0


@pytest.mark.parametrize("speed", [math.nan, math.inf, -1e-9, 1.1e6])
def test_an_impact_speed_outside_its_range_is_refused(speed):
    with pytest.raises(ValueError, match="impact speed"):
        damping_of_restitution(0.5, speed)
