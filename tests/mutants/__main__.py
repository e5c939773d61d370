"""`make mutants`: break the code one line at a time on a copy, run the tests that must notice, list what they missed.

    python -m tests.mutants [NAME …]     NAME: part of a function's name, `energies`, `outputs` or `papers`; without one, all

Exit status 1 where a mutant survives that is not marked equivalent, or a test fails without any mutant.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tests.mutants.energies import ENERGIES
from tests.mutants.listed import MUTANTS, Mutant
from tests.mutants.outputs import OUTPUTS
from tests.mutants.papers import PAPERS
from tests.mutants.source import PACKAGES, file_of, mutated, noticing

ROOT = Path(__file__).resolve().parents[2]
TIME_LIMIT = 600.0  # [s] for the tests of one mutant; a mutant that hangs is noticed


def main(names: list[str]) -> int:
    lists = {"energies": ENERGIES, "outputs": OUTPUTS, "papers": PAPERS}
    if len(names) == 1 and names[0] in lists:
        chosen = [*lists[names[0]]]
    else:
        every = (*MUTANTS, *ENERGIES, *OUTPUTS, *PAPERS)
        chosen = [each for each in every if not names or any(name in each.function for name in names)]
    with tempfile.TemporaryDirectory(prefix="mutants-") as folder:
        copy = Path(folder) / "copy"
        _copy(copy)
        print(f"{len(chosen)} mutants; first their tests without any", flush=True)
        for interpreted in (False, True):
            alike = [each for each in chosen if each.interpreted == interpreted]
            tests = sorted({test for each in alike for test in noticing(each, copy / "tests")})
            if tests and _failed(copy, tests, interpreted):
                print("a test fails without any mutant; mend that first")
                return 1
        missed = [
            each for number, each in enumerate(chosen, 1) if not _is_noticed(each, copy, f"{number}/{len(chosen)}")
        ]
    survived = [each for each in missed if not each.equivalent]
    print(f"{len(chosen) - len(missed)} noticed, {len(missed) - len(survived)} equivalent, {len(survived)} survived")
    return 1 if survived else 0


def _copy(target: Path) -> None:
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        check=True,
    )
    for name in filter(None, listed.stdout.decode().split("\0")):
        if (ROOT / name).exists():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target / name, follow_symlinks=False)


def _is_noticed(mutant: Mutant, copy: Path, place: str) -> bool:
    started = time.monotonic()
    path = file_of(mutant, copy)
    source = path.read_text()
    path.write_text(mutated(mutant, source))
    try:
        noticed = _failed(copy, noticing(mutant, copy / "tests"), mutant.interpreted)
    finally:
        path.write_text(source)
    word = "noticed" if noticed else f"equivalent: {mutant.equivalent}" if mutant.equivalent else "SURVIVED"
    seconds = time.monotonic() - started
    print(f"{place} {mutant.function}: {mutant.text!r} -> {mutant.becomes!r}: {word} ({seconds:.0f} s)", flush=True)
    return noticed


def _failed(copy: Path, tests: list[str], interpreted: bool) -> bool:
    """Whether a test fails. Tests that cannot be run at all are an error of this tool, not a verdict."""
    packages = [str((copy / package).parent) for package in PACKAGES]
    paths = [str(copy), *packages, os.environ.get("PYTHONPATH", "")]
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(filter(None, paths)),
        "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
        **({"NUMBA_DISABLE_JIT": "1"} if interpreted else {}),
    }
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests]
    try:
        done = subprocess.run(
            command, cwd=copy, env=environment, capture_output=True, text=True, timeout=TIME_LIMIT, check=False
        )
    except subprocess.TimeoutExpired:
        return True
    if done.returncode not in (0, 1):
        raise RuntimeError(f"pytest ended with status {done.returncode}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.returncode == 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
