"""What a reader must know before the numbers of a roller: time acceleration that errs, a track worn
far, samples too rare, a pressure beyond the elastic range.
"""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.records.messages import RollerTrack
from contact_sim_pkg.report.ranges import yield_warnings
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.roller.report.series import RollerSeries, roller_of

LARGEST_ERROR = 0.1
"""Of the change of heights over an interval ridden both ways: beyond it is warned."""
LARGEST_LOSS = 0.05
"""Of a body's radius, worn off by the mean: beyond it is warned, as its curvature stays that of the
scene.
"""
LARGEST_UNSEEN = 0.1
"""Of the load's variation round a track: what lies above half the sample rate may be so much."""
LEAST_VARIATION = 0.01
"""Of the mean load: below it the variation is not looked at."""


def roller_warnings(recording: Recording) -> list[str]:
    """Sentences; none where nothing is to be warned of."""
    roller = roller_of(recording)
    if roller is None:
        return []
    strength = (recording.scene.get("roller") or {}).get("yield_strength")
    pressed = yield_warnings("roller.yield_strength", strength, roller.time, roller.contact.peak_pressure)
    return pressed + warnings_of(roller)


def warnings_of(roller: RollerSeries) -> list[str]:
    """Sentences on a roller; none where nothing is to be warned of."""
    bodies = dict.fromkeys(each.body for each in roller.tracks)
    tracks = [[each for each in roller.tracks if each.body == body] for body in bodies]
    found = [_acceleration(each) for each in tracks[:1]] + [_loss(each[-1]) for each in tracks] + [_sampling(roller)]
    return [sentence for sentence in found if sentence]


def _acceleration(tracks: list[RollerTrack]) -> str:
    checked = [each for each in tracks if each.checked > 0.0]
    wrong = [each for each in checked if each.check_error > LARGEST_ERROR]
    if not wrong:
        return ""
    return (
        f"In {len(wrong)} of {len(checked)} intervals ridden both ways the time acceleration of "
        f"{wrong[0].cycles / wrong[0].turns:.6g} errs by more than {LARGEST_ERROR:g} of the change of the track's heights "
        f"(at most {max(each.check_error for each in wrong):.3g}), first after {wrong[0].cycles:.6g} cycles: from there on the "
        "track is not that of every turn ridden; a lower roller.acceleration errs less."
    )


def _loss(last: RollerTrack) -> str:
    share = last.lowered / last.radius
    if share <= LARGEST_LOSS:
        return ""
    return (
        f"The wear has taken {last.lowered * 1e3:.4g} mm off the {last.body} on average, {100.0 * share:.3g} % of its radius; "
        "the contact keeps the radii of the scene. A lower damage.gain or fewer cycles take less."
    )


def _sampling(roller: RollerSeries) -> str:
    half = 0.5 / roller.contact.period
    worst, unseen = None, 0.0
    for each in roller.tracks:
        total, above = variation_above(each, half)
        if total > LEAST_VARIATION * float(each.load.mean()) and above > LARGEST_UNSEEN * total and above > unseen:
            worst, unseen = each, above
    if worst is None:
        return ""
    return (
        f"The load round the {worst.body} varies by up to {unseen:.3g} N rms above {half:.6g} Hz, half the rate of the samples: "
        "there it is seen at wrong frequencies, and the samples miss its peaks; a higher outputs.force_rate shows them."
    )


def variation_above(track: RollerTrack, frequency: float) -> tuple[float, float]:
    """Rms [N] of the load round a track about its mean, and of what of it lies above a frequency
    [Hz].
    """
    sizes = np.abs(np.fft.rfft(track.load)) ** 2 / len(track.load) ** 2 * 2.0
    tones = np.arange(len(sizes)) / track.turn_time
    return float(np.sqrt(sizes[1:].sum())), float(np.sqrt(sizes[tones > frequency].sum()))
