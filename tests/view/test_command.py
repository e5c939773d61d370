"""`bench view` from the command line, without ROS."""

import re
import signal
import urllib.request

import pytest
from tests.bench_process import LONGEST, bench, end, start_bench
from tests.cli.test_missing_packages import ABSENT, RUN, run
from tests.view.frames import Client, written


def test_it_plays_a_bag_and_ends_at_a_signal(tmp_path):
    pytest.importorskip("websockets")
    process = start_bench("view", written(tmp_path))
    try:
        line = process.stdout.readline()
        port = int(re.fullmatch(r"view: http://127\.0\.0\.1:(\d+)/\n", line)[1])
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=30) as page:
            assert b"live view" in page.read()
        client = Client(port)
        client.until(lambda about, *_: about["maps"] and about["maps"][0]["load"] == 649.0)
        client.close()
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=LONGEST)
        assert (process.returncode, errors.strip()) == (0, "")
    finally:
        end(process)


def test_without_the_library_one_sentence_says_how_to_install_it(tmp_path):
    (tmp_path / "sitecustomize.py").write_text(ABSENT.format(name="websockets"))
    said = run(tmp_path, RUN, "view", "bag")
    assert said == (
        "bench: the live page needs websockets, which is not installed; pip install 'contact_sim_pkg[view]'\n"
    )


def test_a_bag_with_topics_and_one_that_is_not_there_are_refused(tmp_path):
    ended = bench("view", "bag", "--topics")
    assert (ended.returncode, "--topics follows running nodes" in ended.stderr) == (2, True)
    ended = bench("view", tmp_path / "none")
    assert (ended.returncode, ended.stderr.count("\n")) == (2, 1)
