"""Pictures of the bench itself: energy ledger and cost."""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.records.report import LedgerScope
from contact_sim_pkg.report.drawing import (
    ACCENT,
    INK,
    MUTED,
    Margins,
    Picture,
    draw_series,
    legend_above,
    new_figure,
    picture,
)
from contact_sim_pkg.report.energy import AT_REST, relative_residual, residual_scale, throughput
from contact_sim_pkg.report.series import CostSeries, LedgerSeries
from contact_sim_pkg.report.signal.decimate import envelope
from contact_sim_pkg.report.summary import longest_block_sentence, solver_numbers


def energy_balance(ledger: LedgerSeries, scope: LedgerScope | None = None) -> Picture:
    """Work in, energy stored and dissipated, and below them the residual over the throughput; ``scope``
    None: of the whole rig.
    """
    figure, axes = new_figure(4.0, 2, sharex=True, height_ratios=[2, 1])
    held = ledger.kinetic + ledger.potential + ledger.stored
    axes[0].plot(*envelope(ledger.time, ledger.supplied), color=INK, label="supplied")
    axes[0].plot(*envelope(ledger.time, ledger.dissipated), color=ACCENT, label="dissipated")
    axes[0].plot(*envelope(ledger.time, held), color=MUTED, linestyle=(0, (4, 2)), label="kinetic + potential + stored")
    axes[0].set_ylabel("energy, J")
    legend_above(axes[0])
    scale = residual_scale(ledger)
    at_rest = throughput(ledger) < AT_REST
    named = (
        f"{AT_REST:g} J (the rig was at rest)"
        if at_rest
        else f"the throughput ({scale:.4g} J, the largest entry of the ledger)"
    )
    axes[1].plot(*envelope(ledger.time, ledger.residual / scale), color=ACCENT, linewidth=0.9)
    axes[1].axhline(0.0, color=MUTED, linewidth=0.7)
    axes[1].set_ylabel("residual / 1e-6 J" if at_rest else "residual /\nthroughput")
    axes[1].ticklabel_format(axis="y", style="sci", scilimits=(-2, 3), useMathText=False)
    axes[1].set_xlabel("simulated time, s")
    axes[1].set_xlim(ledger.time[0], max(ledger.time[-1], ledger.time[0] + 1e-3))
    caption = (
        f"Energy since the start: {ledger.supplied[-1]:.4g} J supplied, {ledger.dissipated[-1]:.4g} J dissipated at "
        f"the end. The residual is at most {np.abs(ledger.residual).max():.2g} J, "
        f"{relative_residual(ledger):.1e} of {named}: what its entries leave open."
    )
    title = "Energy ledger over time and its residual"
    if scope is not None:
        title = f"{title}: {scope.motion}"
        caption += f" This is the balance of the {scope.motion}"
        caption += f"; outside it: {', '.join(scope.outside)}." if scope.outside else "."
    return picture("bench-energy", figure, title, caption)


def real_time_factor(cost: CostSeries) -> Picture:
    """Real-time factor of the blocks over time, and how often each wall time occurs."""
    figure, axes = new_figure(2.7, 1, 2, Margins(left=0.95), width_ratios=[3, 2])
    draw_series(axes[0], cost["time"], cost["real_time_factor"], color=ACCENT, linewidth=0.8)
    axes[0].axhline(1.0, color=INK, linewidth=0.9, linestyle=(0, (4, 3)))
    axes[0].set_yscale("log")
    axes[0].set_xlabel("simulated time, s")
    axes[0].set_ylabel("real-time factor\nof the physics")
    milliseconds = cost["wall_time"] * 1e3
    # The slowest hundredth is counted in the last bin, so that one slow first block does not
    # squeeze the rest.
    limit = float(np.percentile(milliseconds, 99.0)) * 1.1
    axes[1].hist(np.minimum(milliseconds, limit), bins=40, color=ACCENT)
    axes[1].set_xlabel("wall time of a block, ms")
    axes[1].set_ylabel("blocks")
    return picture(
        "bench-cost", figure, "Speed of the physics over time and histogram of wall times", _cost_caption(cost)
    )


def _cost_caption(cost: CostSeries) -> str:
    numbers = solver_numbers(cost)
    milliseconds = cost["wall_time"] * 1e3
    text = (
        f"{numbers['blocks']} blocks took {numbers['physics_wall_s']:.3g} s of wall time for the physics: "
        f"{numbers['physics_real_time_factor']:.3g} times as fast as the clock. Median "
        f"{np.median(milliseconds):.3g} ms a block, {longest_block_sentence(numbers)}; {numbers['overruns']} blocks were "
        "slower than real time (dashed: 1). The last bar holds the slowest hundredth. Wall times differ "
        f"from run to run. {numbers['steps']} time steps, {numbers['rejected_steps']} rejected, "
        f"{numbers['events']} events."
    )
    # A run without pressure fields
    if not numbers["field_iterations"]:
        return text
    return text + (
        f" Pressure fields: {numbers['field_iterations']} iterations, largest relative residual "
        f"{numbers['field_residual_max']:.1e}; they were solved for "
        f"{numbers['coupling_steps']} coupling steps ({numbers['coupling_steps_repeated']} repeated, shorter), in which a force is "
        f"wrong by an estimated {numbers['coupling_error_max']:.2g} of its standing load at most; where two steps meet a force "
        f"jumped by at most {numbers['field_jump_max_N']:.3g} N."
    )
