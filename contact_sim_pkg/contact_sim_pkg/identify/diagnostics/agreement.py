"""Contacts that agree with each other: the sum of squares that the best parameters leave, against
its chi-square distribution.

Where all contacts together leave more than noise explains, those are left out, one after the other,
without which the least is left, until the others agree. More than half stay, with an equation more
than they determine. Where more would have to go, all are used, and the contradiction is reported.
Where all of them fit nothing, half is enough, with SURE equations. One impact that was two within a
sample is such a contact. Source: data snooping of geodesy, W. Baarda, A testing procedure for use
in geodetic networks, 1968.
"""

from __future__ import annotations

import numpy
from scipy.stats import chi2

from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.motion.linearised import Linearised

__all__ = ["SLIGHT", "agreeing", "contradicts"]

QUANTILE = 0.9999
SURE = 2  # equations left over by which half of the contacts agree: a single one may do so by chance
SLIGHT = 1e-6  # standard deviation over the size of a parameter, contradictions counted, below which they do not matter


def contradicts(found: ParameterEstimate) -> bool:
    """Whether contacts and flights contradict each other by more than noise explains, and by so
    much that it matters.
    """
    if not found.freedom:
        return False
    spread = float((numpy.sqrt(numpy.diag(found.covariance)) / found.scale).max(initial=0.0))
    limit = float(numpy.sqrt(chi2.ppf(QUANTILE, found.freedom) / found.freedom))
    return found.misfit > limit and found.misfit * spread > SLIGHT


def agreeing(linear: Linearised, left_out: int, *, half: bool) -> list[int]:
    """Numbers of the contacts that agree; all where it is open which of them do.

    Args:
        linear: where the flights alone are.
        left_out: how many contacts besides contradicted the others before.
        half: whether half of them are enough.
    """
    everyone = list(range(len(linear.problem.contacts)))
    kept = everyone
    while kept and not _agree(linear, kept):
        without = [[each for each in kept if each != number] for number in kept]
        kept = min(without, key=lambda contacts: linear.contradiction(contacts)[0])
        majority = 2 * len(kept) - len(everyone) - left_out
        if majority < (0 if half else 1) or linear.redundancy(kept) < (1 if majority else SURE):
            return everyone
    return kept


def _agree(linear: Linearised, contacts: list[int]) -> bool:
    square, freedom = linear.contradiction(contacts)
    return freedom == 0 or square <= float(chi2.ppf(QUANTILE, freedom))
