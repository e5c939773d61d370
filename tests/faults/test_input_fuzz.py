"""Spoilt inputs of every kind that the bench reads: each is read, or refused in a sentence; none ends in a traceback.

A test run takes 40 of each kind, the same ones on each day. CONTACT_BENCH_FUZZ=all takes 300 of each, as `make hard` does.
"""

import os
import random
import warnings

import pytest
from tests.faults.input_fuzz import KINDS, spoilt

from contact_sim_pkg.files import RefusedError
from contact_sim_pkg.memory import MemoryLimitError

ASKED = os.environ.get("CONTACT_BENCH_FUZZ") or ""
COUNT = 300 if ASKED == "all" else 40


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_whole_is_read(kind, tmp_path):
    ending, contents, read = KINDS[kind]
    for number, content in enumerate(contents()):
        file = tmp_path / f"whole_{number}{ending}"
        file.write_bytes(content)
        read(file, tmp_path / f"out_{number}")


@pytest.mark.fault("A16")
@pytest.mark.parametrize("kind", KINDS)
def test_what_is_spoilt_is_read_or_refused_in_a_sentence(kind, tmp_path):
    ending, contents, read = KINDS[kind]
    whole, sentences = list(contents()), {}
    for seed in range(COUNT):
        draw = random.Random(seed)
        file = tmp_path / f"spoilt{ending}"
        file.write_bytes(spoilt(draw.choice(whole), draw))
        folder = tmp_path / f"out_{seed}"
        folder.mkdir()
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error", RuntimeWarning)
                read(file, folder)
        except (RefusedError, MemoryLimitError) as error:
            sentences[seed] = str(error)
        except Exception as error:
            raise AssertionError(f"{kind}, seed {seed}: {type(error).__name__}: {error}") from error
    assert sentences
    assert {seed: text for seed, text in sentences.items() if "\n" in text or not 10 < len(text) < 2000} == {}
