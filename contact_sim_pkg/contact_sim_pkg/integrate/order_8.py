"""Dormand and Prince's pair of order 8 with embedded orders 5 and 3: long steps to tight
tolerances.

Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., chapter II, section 10;
coefficients of their code DOP853.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.stage import evaluate

STAGES = 12
POWER = 8.0
INSIDE_CONTACT = 0.2
# Found by trial: with these, rubber at loss tangents 0 to 1 and the seat slap follow their
# tolerance.
TOO_COARSE, FAR_ABOVE = 0.03, 500.0
TOO_LONG = 100.0  # an error that halves the step


class Order8(NamedTuple):
    """Stages of the pair: rates over the part of the step."""

    stages: Vector  # [12, states]


@borrowing_kernel
def step_of_order_8(stages, rig, drive, mode, course, state, out):  # noqa: C901 (a loop over the states a stage)
    """Step from ``state`` along ``course`` into ``out``; the first row of ``stages`` must hold the
    rate at its start.
    """
    k = stages
    n = state.shape[0]
    for i in range(n):
        out[i] = state[i] + 0.05260015195876773 * k[0, i]
    evaluate(rig, drive, mode, course, 0.05260015195876773, out, k[1])
    for i in range(n):
        out[i] = state[i] + 0.0197250569845379 * k[0, i] + 0.0591751709536137 * k[1, i]
    evaluate(rig, drive, mode, course, 0.0789002279381516, out, k[2])
    for i in range(n):
        out[i] = state[i] + 0.02958758547680685 * k[0, i] + 0.08876275643042054 * k[2, i]
    evaluate(rig, drive, mode, course, 0.1183503419072274, out, k[3])
    for i in range(n):
        out[i] = state[i] + 0.2413651341592667 * k[0, i] - 0.8845494793282861 * k[2, i] + 0.924834003261792 * k[3, i]
    evaluate(rig, drive, mode, course, 0.2816496580927726, out, k[4])
    for i in range(n):
        out[i] = (
            state[i] + 0.037037037037037035 * k[0, i] + 0.17082860872947386 * k[3, i] + 0.12546768756682242 * k[4, i]
        )
    evaluate(rig, drive, mode, course, 0.3333333333333333, out, k[5])
    for i in range(n):
        out[i] = state[i] + (
            0.037109375 * k[0, i] + 0.17025221101954405 * k[3, i] + 0.06021653898045596 * k[4, i]
            - 0.017578125 * k[5, i]
        )  # fmt: skip
    evaluate(rig, drive, mode, course, 0.25, out, k[6])
    for i in range(n):
        out[i] = state[i] + (
            0.03709200011850479 * k[0, i] + 0.17038392571223998 * k[3, i] + 0.10726203044637328 * k[4, i]
            - 0.015319437748624402 * k[5, i] + 0.008273789163814023 * k[6, i]
        )  # fmt: skip
    evaluate(rig, drive, mode, course, 0.3076923076923077, out, k[7])
    for i in range(n):
        out[i] = state[i] + (
            0.6241109587160757 * k[0, i] - 3.3608926294469414 * k[3, i] - 0.868219346841726 * k[4, i]
            + 27.59209969944671 * k[5, i] + 20.154067550477894 * k[6, i] - 43.48988418106996 * k[7, i]
        )  # fmt: skip
    evaluate(rig, drive, mode, course, 0.6512820512820513, out, k[8])
    for i in range(n):
        out[i] = state[i] + (
            0.47766253643826434 * k[0, i] - 2.4881146199716677 * k[3, i] - 0.590290826836843 * k[4, i]
            + 21.230051448181193 * k[5, i] + 15.279233632882423 * k[6, i] - 33.28821096898486 * k[7, i]
            - 0.020331201708508627 * k[8, i]
        )  # fmt: skip
    evaluate(rig, drive, mode, course, 0.6, out, k[9])
    for i in range(n):
        out[i] = state[i] + (
            -0.9371424300859873 * k[0, i] + 5.186372428844064 * k[3, i] + 1.0914373489967295 * k[4, i]
            - 8.149787010746927 * k[5, i] - 18.52006565999696 * k[6, i] + 22.739487099350505 * k[7, i]
            + 2.4936055526796523 * k[8, i] - 3.0467644718982196 * k[9, i]
        )  # fmt: skip
    evaluate(rig, drive, mode, course, 0.8571428571428571, out, k[10])
    for i in range(n):
        out[i] = state[i] + (
            2.273310147516538 * k[0, i] - 10.53449546673725 * k[3, i] - 2.0008720582248625 * k[4, i]
            - 17.9589318631188 * k[5, i] + 27.94888452941996 * k[6, i] - 2.8589982771350235 * k[7, i]
            - 8.87285693353063 * k[8, i] + 12.360567175794303 * k[9, i] + 0.6433927460157636 * k[10, i]
        )  # fmt: skip
    evaluate(rig, drive, mode, course, 1.0, out, k[11])
    for i in range(n):
        out[i] = state[i] + (
            0.054293734116568765 * k[0, i] + 4.450312892752409 * k[5, i] + 1.8915178993145003 * k[6, i]
            - 5.801203960010585 * k[7, i] + 0.3111643669578199 * k[8, i] - 0.1521609496625161 * k[9, i]
            + 0.20136540080403034 * k[10, i] + 0.04471061572777259 * k[11, i]
        )  # fmt: skip


@borrowing_kernel
def _too_long(k, i, coarse):
    """Whether the error of order 3 of state ``i`` (``coarse``, as a rate) is a large part of its
    largest rate in the step.
    """
    change = 0.0
    for j in range(k.shape[0]):
        change = max(change, abs(k[j, i]))
    return abs(coarse) > TOO_COARSE * change


@borrowing_kernel
def error_of_order_8(stages, course, scale):
    """Largest error of a state over ``scale``: that of order 5, corrected by that of order 3 to the
    power 8 of the step.

    Inside a contact the true error lies 30 to 100 times below that estimate, towards an event 1.5
    to 10 times (measured on the seat slap), so that ``INSIDE_CONTACT`` of it is returned but for
    the step that ends at an event. A step that would be accepted while that of order 3 is above 3 %
    of the change over it, and far above what is allowed, is ``TOO_LONG``: that of order 5 is small
    by chance there (seen behind a first contact: 1e-3 off at a tolerance of 1e-6).
    """
    k = stages
    worst = 0.0
    doubtful = False
    for i in range(scale.shape[0]):
        fine = (
            0.01312004499419488 * k[0, i] - 1.2251564463762044 * k[5, i] - 0.4957589496572502 * k[6, i]
            + 1.6643771824549864 * k[7, i] - 0.35032884874997366 * k[8, i] + 0.3341791187130175 * k[9, i]
            + 0.08192320648511571 * k[10, i] - 0.022355307863886294 * k[11, i]
        )  # fmt: skip
        coarse = (
            -0.18980075407240762 * k[0, i] + 4.450312892752409 * k[5, i] + 1.8915178993145003 * k[6, i]
            - 5.801203960010585 * k[7, i] - 0.4226823213237919 * k[8, i] - 0.1521609496625161 * k[9, i]
            + 0.20136540080403034 * k[10, i] + 0.02265179219836082 * k[11, i]
        )  # fmt: skip
        if abs(coarse) > FAR_ABOVE * scale[i]:
            doubtful = doubtful or _too_long(k, i, coarse)
        if coarse != 0.0:
            fine *= abs(fine) / math.sqrt(fine * fine + 0.01 * coarse * coarse)
        ratio = abs(fine) / scale[i]
        if not ratio <= worst:  # also true for NaN
            worst = ratio
    if course.ends_at_event:
        return worst
    worst *= INSIDE_CONTACT
    return TOO_LONG if doubtful and worst <= 1.0 else worst
