"""Every number of the schema, at and beside its bounds: a run ends right, or in a sentence, within bounds of time and memory.

A test run takes one in `TURNS` of the cases that run, the same ones on each day. CONTACT_BENCH_FUZZ=all takes every one, as
`make hard` does, and CONTACT_BENCH_FUZZ=3 those of turn 3. `pytest -s` shows counts and times.
"""

import collections
import os
import time

import pytest
from tests.faults.schema_fuzz import BASES, RARE_BASES, cases, end_of, missing_numbers, run_all

TURNS = 8
ASKED = os.environ.get("CONTACT_BENCH_FUZZ") or "0"
GOOD = ("right", "refused", "failed", "long")


def test_the_bases_hold_every_number_of_the_schema():
    assert missing_numbers() == set()


@pytest.mark.fault("A8")
@pytest.mark.parametrize("rig", BASES)
def test_a_value_outside_its_bounds_is_refused(rig):
    outside = [case for case in cases(rig) if not case.inside]
    assert [(case.assignment, end) for case in outside if (end := end_of(case)).kind != "refused"] == []


@pytest.mark.parametrize("rig", BASES)
def test_a_value_within_its_bounds_ends_right_or_in_a_sentence(rig):
    every = [case for case in cases(rig) if case.inside]
    usual = [case for case in every if case.base not in RARE_BASES.get(rig, ())]
    chosen = every if ASKED == "all" else usual[int(ASKED) % TURNS :: TURNS]
    began, ends = time.perf_counter(), list(run_all(chosen))
    counts = dict(collections.Counter(end.kind for _case, end in ends))
    spent = f"{sum(end.seconds for _case, end in ends):.1f} s of processor, {time.perf_counter() - began:.1f} s in all"
    print(  # noqa: T201  # for `pytest -s`
        f"\n{rig}: {len({case.where for case in every})} numbers, {len(chosen)} of {len(every)} cases: {counts}, {spent}"
    )
    bad = [f"{' '.join(case.base)} {case.assignment}: {end}" for case, end in ends if end.kind not in GOOD]
    assert bad == [], f"turn {ASKED}"
