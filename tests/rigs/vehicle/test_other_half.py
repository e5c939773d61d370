"""What the second process compiles at a first start is what the run needs."""

import os
import subprocess
import sys

from tests.run.scenes import resolved

from contact_sim_pkg.run.compilation import compile_other_half

SCENE = ("tire_bump", "duration=0.02", "effects.tire.contact_field.rows=32", "effects.tire.contact_field.cols=32")

RUN = f"""
from contact_sim_pkg.run import compilation, offline
compilation.accompanied = lambda *_: __import__("contextlib").nullcontext()
from tests.run.scenes import resolved
offline.run_offline(resolved(*{SCENE!r}), None)
from contact_sim_pkg.compiled.jit import compiled_functions
for function in compiled_functions():
    if sum(function.stats.cache_misses.values()):
        print(function.py_func.__module__)
"""


def in_new_process(program, cache, *arguments):
    environment = {**os.environ, "CONTACT_BENCH_CACHE": str(cache), "PYTHONPATH": os.pathsep.join(sys.path)}
    return subprocess.run(
        [sys.executable, "-c", program, *arguments],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
        timeout=300,
    ).stdout


def test_the_first_process_is_left_with_the_kernels_of_the_pressure_field(tmp_path):
    tmp_path.chmod(0o700)
    called = f"import sys; from {compile_other_half.__module__} import compile_other_half as run; run(sys.argv[1])"
    in_new_process(called, tmp_path, resolved(*SCENE).to_yaml())
    compiled = set(in_new_process(RUN, tmp_path).split())
    assert compiled
    fields = ("contact_sim_pkg.pressure.field", "contact_sim_pkg.compiled.held")  # whose buffers are held
    assert all(module.startswith(fields) for module in compiled), compiled
