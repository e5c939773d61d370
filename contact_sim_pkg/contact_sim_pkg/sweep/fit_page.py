"""The page of a fit: what was measured beside the fitted scene, the keys between what they are."""

from __future__ import annotations

import math
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.ticker import MaxNLocator

from contact_sim_pkg.files import new_file
from contact_sim_pkg.report.answer import Answer
from contact_sim_pkg.report.drawing import ACCENT, MUTED, Margins, Picture, draw_series, new_figure, picture, style
from contact_sim_pkg.report.place import is_page
from contact_sim_pkg.report.tables import Table
from contact_sim_pkg.sweep.fit_result import Compared, Fit, Fitted
from contact_sim_pkg.sweep.page import Call, Part, page_of_parts

__all__ = ["answer_of_fit", "coarse_sentence", "late_words", "others_sentence", "write_fit_page"]

MOST_PICTURES = 6
LEAST_LATE = 5e-6
"""[s] that is printed as more than 0.00 ms"""
ROOM = Margins(left=0.92, shared=0.16)
NONE = "–"


def write_fit_page(path: Path, scene: str, found: Fit) -> Path:
    """Write the page of a fit, which may be one of an earlier call. Raises FileRefusedError where another file is in the way."""
    with style():
        drawn = [_compared(each, f"fit-{place}") for place, each in enumerate(found.compared[:MOST_PICTURES])]
    fitted = shlex.quote(str(path.parent / "fitted.yaml"))
    again = Call("fitted.yaml", "the fitted scene", [f"bench run {fitted} --offline"])
    part = Part("fit", "Measured and fitted", [_keys(found.parameters)], drawn, [], [again])
    page = page_of_parts("fit", Path(scene).stem, found.cases, answer_of_fit(found), [part])
    with new_file(path, ours=is_page) as file:
        file.write(page.encode())
    return path


def answer_of_fit(found: Fit) -> Answer:
    """Whether the scene follows what was measured, whether its keys are identifiable, and the keys."""
    keys = "; ".join(_said(each) for each in found.parameters)
    left = f"misfit {found.misfit:.3g} {found.unit}".rstrip()
    late = late_words(found)
    if found.recorded:
        late += f"; with the error of the recorded run, made at accuracy {found.recorded:.2g}"
    if not found.follows:
        noise = f"what is left is no noise (probability {found.probability:.1g})"
        reason = f"{noise}: an effect, a filter, a delay or another model is missing"
        return Answer("outside", "Does not follow", f"{reason}; {left}{late}; the intervals hold nothing.")
    if found.coarse:
        return Answer("doubtful", "Not judged", f"{coarse_sentence(found)}; {keys}; {left}{late}.")
    if found.others:
        return Answer("doubtful", "Two answers", f"{keys}; {others_sentence(found)}; {left}{late}.")
    if not found.is_identified:
        return Answer("doubtful", "Not identifiable", f"{keys}; {left}{late}.")
    if math.isnan(found.probability):
        return Answer(
            "usual", "Fitted", f"{keys}; {left}{late}; the scatter is not known, whether it follows was not judged."
        )
    return Answer("good", "Follows", f"{keys}; {left}{late}.")


def late_words(found: Fit) -> str:
    """By how much a recording is late, where that is more than nothing."""
    return f", the recording {1e3 * found.shift:.2f} ms late" if abs(found.shift) > LEAST_LATE else ""


def others_sentence(found: Fit) -> str:
    """Other minima that are as good; empty where there is none."""
    listed = [
        ", ".join(f"{each.key} {_digits(value)}" for each, value in zip(found.parameters, values, strict=True))
        for values in found.others
    ]
    return f"as good, by chance: {'; or '.join(listed)}" if listed else ""


def coarse_sentence(found: Fit) -> str:
    """What is missing where the runs, or the run that was recorded, are less accurate than what is left."""
    if found.recorded:
        return (
            f"what is left is no noise, and within what the recorded run errs by at accuracy {found.recorded:.2g}: a recording "
            f"made at {0.1 * found.recorded:.1g} decides"
        )
    return (
        f"what is left is no noise, and within what the runs may err by at accuracy {found.coarse:.2g}: "
        f"--set accuracy={0.1 * found.coarse:.1g} decides"
    )


def _digits(value: float) -> str:
    """Enough of them to tell an interval of a thousandth."""
    return f"{value:.6g}" if math.isfinite(value) else NONE


def _said(fitted: Fitted) -> str:
    interval = f" ({_digits(fitted.low)} to {_digits(fitted.high)})" if math.isfinite(fitted.low) else ""
    return f"{fitted.key} {_digits(fitted.value)}{interval}" + (f", {fitted.remark}" if fitted.remark else "")


def _keys(parameters: Sequence[Fitted]) -> Table:
    rows = [
        (each.key, *(_digits(value) for value in (each.value, each.low, each.high)), each.remark) for each in parameters
    ]
    return Table("Keys with their 90 % intervals.", ("key", "value", "from", "to", "remark"), rows)


def _compared(compared: Compared, name: str) -> Picture:
    """Measured and fitted above, what is left between them below; densities and their ratio by logarithms."""
    figure, (above, below) = new_figure(3.6, 2, 1, ROOM, sharex=True)
    is_density = compared.axis.startswith("frequency")
    is_series = compared.axis.startswith("time")
    marks: dict[str, Any] = {} if is_series or is_density else {"marker": "o", "linestyle": "", "markersize": 4.0}
    left = compared.fitted / compared.measured if is_density else compared.fitted - compared.measured
    said = ""
    for axes, values, colour, label in (
        (above, compared.measured, MUTED, "measured"), (above, compared.fitted, ACCENT, "fitted"), (below, left, ACCENT, None),
    ):  # fmt: skip
        if is_series:
            said = draw_series(axes, compared.across, values, color=colour, label=label)
        else:
            axes.plot(compared.across, values, color=colour, label=label, **marks)
    if is_density:
        for axes in (above, below):
            axes.set_yscale("log")
    else:
        below.ticklabel_format(axis="y", style="sci", scilimits=(-2, 4))
    if marks:
        below.xaxis.set_major_locator(MaxNLocator(integer=True))
    above.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderaxespad=0.1)
    above.set_ylabel(
        compared.name.replace(" of ", " of\n").replace("/", "/\n", 1) if len(compared.name) > 24 else compared.name
    )
    below.set_ylabel("fitted over\nmeasured" if is_density else "fitted less\nmeasured")
    below.set_xlabel(compared.axis)
    caption = f"Grey: measured, blue: fitted; below what is left of it.{said}"
    return picture(name, figure, f"{compared.name}, measured and fitted", caption)
