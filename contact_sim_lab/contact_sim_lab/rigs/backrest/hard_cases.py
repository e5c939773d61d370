"""Hard cases of the backrest rig: violent slaps, chatter, grazing, friction that vanishes, one
point, energy.
"""

from __future__ import annotations

import numpy

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly
from contact_sim_lab.rigs.backrest.drive import BackrestMotion, drive_of, fast_run, slow_run
from contact_sim_pkg.scene.resolve import load_resolved

MODEL = "backrest"
TIGHT = "integrator.relative_tolerance=1e-10"
GRAVITY = 9.81
VIOLENT = ("seat_slap", "vibration.amplitude=58.86", TIGHT)  # 6 g
CHATTER = ("seat_slap", "vibration.amplitude=9.0", "effects.backrest.normal_dissipative.restitution=0.9", TIGHT)
ONE_POINT = (
    "seat_slap", "effects.backrest.shell_modes={modes: 9, points_up: 1, points_across: 1}", "backrest.preload=20", TIGHT,
)  # fmt: skip


def _run(*scene: str, duration: float = 2.0) -> BackrestMotion:
    drive = drive_of(load_resolved(*scene), duration)
    return fast_run(drive, drive.model.scale)


def _shaking(*scene: str) -> float:
    return float(numpy.abs(drive_of(load_resolved(*scene), 0.1).acceleration).max())


def _against_twin(*scene: str, duration: float) -> tuple[BackrestMotion, BackrestMotion]:
    drive = drive_of(load_resolved(*scene), duration)
    twin = slow_run(drive)
    assert twin is not None
    return fast_run(drive, drive.model.scale), twin


def violent_slaps() -> Finding:
    """Largest difference of the approach from scipy's over its largest value, 6 g for 2 s."""
    found, twin = _against_twin(*VIOLENT, duration=2.0)
    return at_most(
        float(numpy.abs(found.approach - twin.approach).max() / numpy.abs(twin.approach).max()),
        1e-6,
        hard=len(found.touches),
    )


def _periods(amplitude: float) -> tuple[int, int]:
    """Drive periods after which the motion repeats within 1e-5 m, 5 Hz at ``amplitude`` [g], behind
    8 s, 0 for none up to 8; and the touches.
    """
    values = f"vibration.amplitude={GRAVITY * amplitude}", "vibration.frequency=5", "duration=12"
    found = _run("seat_slap", *values, TIGHT, duration=12.0)
    settled = found.approach[8000:, 0]
    shifts = (count for count in range(1, 9) if numpy.ptp(settled[200 * count :] - settled[: -200 * count]) < 1e-5)
    return next(shifts, 0), len(found.touches)


def period_doubling() -> Finding:
    """Periods of the motion in drive periods at 1.5, 3 and 5 g as one number: 1, 2, 4."""
    found = [_periods(g) for g in (1.5, 3.0, 5.0)]
    return exactly(
        float(sum(count * place for (count, _touches), place in zip(found, (100, 10, 1), strict=True))),
        124.0,
        hard=min(touches for _count, touches in found),
    )


def chattering_touches() -> Finding:
    """Largest difference of an instant of touch from scipy's, [s], 2 s near the amplitude that
    lifts off, restitution 0.9.
    """
    found, twin = _against_twin(*CHATTER, duration=2.0)
    if len(found.touches) != len(twin.touches):
        return exactly(len(found.touches), len(twin.touches), hard=len(found.touches))
    return at_most(float(numpy.abs(found.touches - twin.touches).max(initial=0.0)), 1e-7, hard=len(found.touches))


def at_rest_under_nothing() -> Finding:
    """Largest motion [m] of a back that is not shaken: it grazes nothing, slaps nothing, drifts
    nowhere.
    """
    scene = "seat_slap", "vibration.amplitude=0", TIGHT
    found = _run(*scene)
    return at_most(
        float(numpy.abs(found.approach - found.approach[0]).max()) + len(found.touches), 1e-12, hard=_shaking(*scene)
    )


def grazing() -> Finding:
    """Force [N] on a back whose preload vanishes and which is not shaken: it only just touches."""
    found = _run("seat_slap", "backrest.preload=0", "vibration.amplitude=0", TIGHT)
    return exactly(float(found.normal.max()), 0.0, hard=found.approach[0].max())


def friction_that_vanishes() -> Finding:
    """Largest friction over mu N, mu = 1e-9, slapping and sliding: largest excess, relative."""
    mu = 1e-9
    limits = f"{{coefficient_static: {mu}, coefficient_kinetic: {mu}}}"
    found = _run("seat_slip", "vibration.amplitude=14.715", f"effects.backrest.friction={limits}")
    return at_most(
        float((numpy.abs(found.friction) - mu * found.normal).max() / (mu * found.normal.max())),
        1e-9,
        hard=len(found.touches),
    )


def no_force_without_overlap() -> Finding:
    """Samples of a 6 g slap with a negative force, or with one where the back is off the seat."""
    found = _run(*VIOLENT)
    separated = found.approach[:, 0] <= 0.0
    return exactly(int((found.normal < 0.0).sum() + (found.normal[separated] != 0.0).sum()), 0, hard=separated.sum())


def energy_of_violent_slaps() -> Finding:
    """Residual of the energy over the work supplied, 6 g for 2 s, requested 1e-10."""
    found = _run(*VIOLENT)
    return at_most(abs(found.residual / found.supplied), 1e-9, hard=len(found.touches))


def one_point() -> Finding:
    """A shell with one contact point: residual of the energy over the work supplied, 9 modes,
    requested 1e-10.
    """
    found = _run(*ONE_POINT, duration=0.5)
    return at_most(abs(found.residual / found.supplied), 1e-8, hard=found.approach.shape[1])


def weight_of_kept_contact() -> Finding:
    """Mean force [N] over ten periods of 5 Hz with contact kept, against the weight: the mean
    acceleration is zero.
    """
    found = _run("seat_slap", "vibration.frequency=5", "vibration.amplitude=2", TIGHT, duration=4.0)
    return close_to(
        float(found.normal[2000:4000].mean()),
        45.6 * GRAVITY,
        0.5,
        hard=numpy.ptp(found.normal[2000:4000]) / found.normal[2000:4000].mean(),
    )


CASES = (
    HardCase(MODEL, "6 g slaps, 2 s: approach against scipy", violent_slaps, guard.touches(5)),
    HardCase(MODEL, "period doubling: drive periods of the motion at 1.5, 3, 5 g, one digit each", period_doubling,
        guard.touches(20)),
    HardCase(MODEL, "chatter at restitution 0.9: instants of touch against scipy [s]", chattering_touches,
        guard.touches(5)),
    HardCase(MODEL, "not shaken: motion and touches", at_rest_under_nothing, guard.zero("acceleration [m/s²]")),
    HardCase(MODEL, "preload 0, not shaken: force of a grazing back [N]", grazing,
        guard.zero("approach at the start [m]")),
    HardCase(MODEL, "μ = 1e-9, sliding and slapping: friction beyond μN", friction_that_vanishes, guard.touches(5)),
    HardCase(MODEL, "6 g slaps: negative forces, and forces without overlap", no_force_without_overlap,
        guard.contact_lost(100)),
    HardCase(MODEL, "6 g slaps: energy not accounted for", energy_of_violent_slaps, guard.touches(5)),
    HardCase(MODEL, "shell with one point: energy not accounted for", one_point, guard.at_most("contact points", 1)),
    HardCase(MODEL, "contact kept: mean force is the weight [N]", weight_of_kept_contact,
        guard.at_least("swing of the force over its mean", 0.3)),
)  # fmt: skip
