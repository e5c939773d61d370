"""With a version of numba whose inside nobody has tested: slower, same numbers."""

import os
import subprocess
import sys
from pathlib import Path

import numpy

from contact_sim_pkg.pressure.field.halfspace import displacement, make_buffers, make_half_space

TESTS = Path(__file__).parents[1]
QUICK = ("compiled/test_fourier.py", "compiled/test_held.py", "pressure/field/test_halfspace.py")
PROGRAM = """
import sys
import numba
numba.__version__ = "99.0.0"
INSIDE
"""
DISPLACED = f"""
sys.path.insert(0, {str(TESTS.parent)!r})
from contact_sim_pkg.compiled.lanes import WIDTH
from tests.compiled.test_untested_numba import displaced
print(WIDTH, displaced().tobytes().hex())
"""


def displaced():
    """Displacement under pressures at random."""
    half_space = make_half_space(12, 10, 0.01, 0.02, 1e6)
    result = numpy.zeros((12, 10))
    pressure = numpy.random.default_rng(1).random((12, 10))
    displacement(half_space, make_buffers(half_space), pressure, result)
    return result


def untested(program, *arguments):
    """What a process with a numba of such a version prints."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM.replace("INSIDE", program), *arguments], cwd=TESTS.parent, capture_output=True,
        text=True, check=False, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_transforms_held_tuples_and_half_spaces_pass_their_tests():
    # Alone, a number is read in the order of the array, so an array that is not contiguous need not be refused
    options = ["-q", "-p", "no:cacheprovider", "-k", "not contiguous"]
    said = untested(
        "import pytest; sys.exit(pytest.main(sys.argv[1:]))", *options, *(str(TESTS / each) for each in QUICK)
    )
    assert "[100%]" in said


def test_a_displacement_has_the_same_bits():
    assert untested(DISPLACED).split() == ["1", displaced().tobytes().hex()]
