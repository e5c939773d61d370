"""Pictures of the tracks of the roller rig: heights and places of the contact round each body,
hardness, error of the time acceleration.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from contact_sim_pkg.records.messages import RollerTrack
from contact_sim_pkg.report.drawing import ACCENT, MUTED, Margins, Picture, legend_above, new_figure, picture
from contact_sim_pkg.rigs.roller.model import build_roller
from contact_sim_pkg.rigs.roller.report.series import RollerSeries
from contact_sim_pkg.rigs.roller.report.warnings import LARGEST_ERROR
from contact_sim_pkg.rigs.roller.wear import hardness_round
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

BESIDE_BAR = Margins(across=1.4)
"""Room between a colour bar with its label and the axes at its right."""


def track_pictures(roller: RollerSeries, scene: dict[str, Any]) -> list[Picture]:
    """Heights round each body's circumference over cycles, the axial wave of a roller that tilts,
    the hardness where the scene gives one, and the error of the time acceleration where it was
    looked at.
    """
    bodies = dict.fromkeys(each.body for each in roller.tracks)
    tracks = {body: [each for each in roller.tracks if each.body == body] for body in bodies}
    found = [_track_over_cycles(body, rows) for body, rows in tracks.items() if len(rows) > 1]
    found += [_axial_over_cycles(body, rows) for body, rows in tracks.items() if len(rows) > 1 and len(rows[0].axial)]
    found += [each for rows in tracks.values() for each in _hardness(rows[-1], scene)]
    checked = [each for each in next(iter(tracks.values()), []) if each.checked > 0.0]
    return found + ([_acceleration_error(checked)] if checked else [])


def _track_over_cycles(body: str, tracks: list[RollerTrack]) -> Picture:
    cycles = np.array([each.cycles for each in tracks])
    heights = np.array([each.height for each in tracks]) * 1e6
    length = 2.0 * np.pi * tracks[0].radius * 1e3
    figure, (left, right) = new_figure(3.2, 1, 2, BESIDE_BAR)
    largest = float(np.abs(heights).max()) or 1.0
    places = np.linspace(0.0, length, heights.shape[1])
    image = left.pcolormesh(places, cycles, heights, cmap="RdBu_r", vmin=-largest, vmax=largest, rasterized=True)
    figure.colorbar(image, ax=left, label="height, µm")
    left.set_xlabel("along the circumference, mm")
    left.set_ylabel("cycles")
    right.semilogy(cycles, [each.range * 1e6 for each in tracks], color=ACCENT, label="range of heights")
    if tracks[-1].lowered > 0.0:
        right.semilogy(cycles, [each.lowered * 1e6 for each in tracks], color=MUTED, label="lost by the mean")
    right.locator_params(axis="x", nbins=4)
    right.set_xlabel("cycles")
    right.set_ylabel("µm")
    legend_above(right)
    last = tracks[-1]
    # The strongest wave round the track, without its mean.
    strength = np.abs(np.fft.rfft(last.height))
    waves = int(strength[1:].argmax()) + 1
    caption = (
        f"Heights of the {body}'s track round its circumference over {last.cycles:.6g} cycles, {last.turns:.6g} turns ridden: "
        f"range {tracks[0].range * 1e6:.4g} to {last.range * 1e6:.4g} µm, at the end strongest {waves} waves round it "
        f"({length / waves:.4g} mm long); contact lost for {100.0 * last.free:.3g} % of the last turn. "
        "The paper's own measured waves (figures 3 and 4) are drawn there without numbers; these are simulated."
    )
    return picture(f"roller-track-{body}", figure, f"Heights round the {body} over cycles", caption)


def _axial_over_cycles(body: str, tracks: list[RollerTrack]) -> Picture:
    """The axial wave: where along the shaft the tilted roller touches, x_c = R sin(tilt)."""
    cycles = np.array([each.cycles for each in tracks])
    places = np.array([each.axial for each in tracks]) * 1e6
    length = 2.0 * np.pi * tracks[0].radius * 1e3
    round_it = np.linspace(0.0, length, places.shape[1])
    figure, (left, right) = new_figure(3.2, 1, 2)
    image = left.pcolormesh(round_it, cycles, places, cmap="viridis", rasterized=True)
    figure.colorbar(image, ax=left)
    left.set_title("x_c, µm")
    left.set_ylabel("cycles")
    right.plot(round_it, places[-1], color=ACCENT)
    right.set_title("x_c of the last turn, µm")
    for axes in (left, right):
        axes.set_xlabel("along the circumference, mm")
    first, last = (float(np.ptp(each)) for each in (places[0], places[-1]))
    caption = (
        f"Place x_c = R sin ψ along the shaft where the roller touches, round the {body}'s track: mean "
        f"{places[-1].mean():.4g} µm in the last turn, range {first:.4g} µm in the first and {last:.4g} µm in the last turn "
        "recorded. The paper's measured axial wave (figure 3) is plastic and drawn there without numbers; this is that of "
        "the contact."
    )
    return picture(f"roller-axial-{body}", figure, f"Place of the contact along the shaft, round the {body}", caption)


def _hardness(track: RollerTrack, scene: dict[str, Any]) -> list[Picture]:
    """Hardness round a track above its heights; none where it is 1 everywhere."""
    hardness = hardness_round(build_roller(ResolvedScene(scene)).damage, track.body, len(track.height))
    if not np.ptp(hardness) > 0.0:
        return []
    round_it = np.linspace(0.0, 2.0 * np.pi * track.radius * 1e3, len(hardness), endpoint=False)
    figure, (above, below) = new_figure(3.2, 2, sharex=True)
    above.plot(round_it, hardness, color=ACCENT)
    above.set_ylabel("hardness c")
    below.plot(round_it, track.height * 1e6, color=ACCENT)
    below.set_ylabel("height, µm")
    below.set_xlabel("along the circumference, mm")
    figure.align_ylabels([above, below])
    caption = (
        f"Limits of the {track.body} over those of subsurface round its track, {hardness.min():.4g} to {hardness.max():.4g}, "
        f"and its heights after {track.cycles:.6g} cycles: soft places wear more. The paper measured micro-hardness (figure "
        "6); it is input here."
    )
    return [picture(f"roller-hardness-{track.body}", figure, f"Hardness and heights round the {track.body}", caption)]


def _acceleration_error(checked: list[RollerTrack]) -> Picture:
    figure, (axes,) = new_figure(2.4)
    cycles, errors = [each.cycles for each in checked], [each.check_error for each in checked]
    axes.semilogy(cycles, errors, color=ACCENT, marker="o", markersize=4, linewidth=0.9)
    axes.axhline(LARGEST_ERROR, color=MUTED, linestyle=(0, (4, 3)), linewidth=0.8, label="warned beyond")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0))
    axes.set_xlabel("cycles")
    axes.set_ylabel("error of the change")
    finite = [error for error in errors if np.isfinite(error)]
    worst = f"{min(finite):.2g} to {max(finite):.2g}" if finite else "none could be measured"
    first = checked[0]
    caption = (
        f"Each turn that is ridden stands for {first.cycles / first.turns:.6g}. At {len(checked)} places of the run the next "
        f"{first.checked:.6g} turns were ridden by that time acceleration and turn by turn; the difference of the heights' "
        f"change over the change turn by turn, rms: {worst}. While waves grow, the errors of the intervals add up over the run."
    )
    return picture("roller-acceleration", figure, "Interval procedure beside every turn ridden", caption)
