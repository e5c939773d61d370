"""Files from outside: what is no plain file is refused without waiting for it, and no output replaces what is there."""

import os
import socket
import threading

import pytest

from contact_sim_pkg.excitation.opencrg.road import OpenCrgRoad
from contact_sim_pkg.excitation.recorded import RecordedVibration
from contact_sim_pkg.files import FileRefusedError, check_output, new_file, open_regular_file, read_regular_file
from contact_sim_pkg.identify.report.input import hull_of_file
from contact_sim_pkg.rigs.impact.material.reading import read_impacts
from contact_sim_pkg.scene.load import load_scene

READERS = {
    "recording": lambda path: RecordedVibration(path, 100.0),
    "road": OpenCrgRoad,
    "impacts": read_impacts,
    "corners": hull_of_file,
    "scene": load_scene,
}


@pytest.fixture(autouse=True)
def nothing_waits():
    """A test that opens a pipe and waits would wait for ever."""
    late = threading.Timer(20.0, os._exit, [70])
    late.start()
    yield
    late.cancel()


@pytest.fixture
def odd_files(tmp_path):
    """By kind: a path that is no plain file, and what the sentence says of it."""
    os.mkfifo(tmp_path / "pipe.yaml")
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(str(tmp_path / "s.yaml"))
        yield {
            "named pipe": tmp_path / "pipe.yaml",
            "device": "/dev/zero",
            "directory": tmp_path,
            "socket": tmp_path / "s.yaml",
            "content but no size": "/proc/kmsg",
            "No such file|no such file": tmp_path / "none.yaml",
        }


@pytest.mark.fault("A1")
@pytest.mark.parametrize("reader", READERS)
def test_every_reader_refuses_what_is_no_plain_file(reader, odd_files):
    for sentence, path in odd_files.items():
        with pytest.raises((ValueError, FileRefusedError), match=sentence):
            READERS[reader](path)


def test_a_file_above_its_limit_is_refused_with_both_sizes(tmp_path):
    (tmp_path / "a").write_bytes(bytes(11))
    assert read_regular_file(tmp_path / "a", 11) == bytes(11)
    with pytest.raises(FileRefusedError, match="has 11 bytes; at most 10 bytes are read; cut it"):
        read_regular_file(tmp_path / "a", 10, "cut it")


def test_an_empty_file_is_a_file(tmp_path):
    (tmp_path / "a").touch()
    assert open_regular_file(tmp_path / "a").read() == b""


def test_an_output_appears_whole_or_not_at_all(tmp_path):
    with pytest.raises(TypeError), new_file(tmp_path / "a") as file:
        file.write(file.write(b"half"))
    assert list(tmp_path.iterdir()) == []
    with new_file(tmp_path / "a") as file:
        file.write(b"whole")
    assert [path.name for path in tmp_path.iterdir()] == ["a"]
    assert (tmp_path / "a").read_bytes() == b"whole"


def test_an_output_that_exists_is_left_as_it_is_unless_forced(tmp_path):
    path = tmp_path / "a"
    path.write_bytes(b"old")
    with pytest.raises(FileRefusedError, match="exists already and is not written over"), new_file(path):
        pytest.fail("the file was opened")
    assert path.read_bytes() == b"old"
    with new_file(path, overwrite=True) as file:
        file.write(b"new")
    assert path.read_bytes() == b"new"


def test_an_output_that_appears_meanwhile_is_left_as_it_is(tmp_path):
    path = tmp_path / "a"
    with pytest.raises(FileRefusedError, match="exists already"), new_file(path):
        path.write_bytes(b"somebody else's")
    assert path.read_bytes() == b"somebody else's"
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


@pytest.mark.parametrize("link", ["same", "hard", "symbolic", "dotted"])
def test_an_input_is_never_an_output_whatever_it_is_called(tmp_path, link):
    given = tmp_path / "a.csv"
    given.write_text("x")
    other = {"same": given, "dotted": tmp_path / ".." / tmp_path.name / "a.csv"}.get(link, tmp_path / "b.csv")
    if link == "hard":
        other.hardlink_to(given)
    if link == "symbolic":
        other.symlink_to(given)
    with pytest.raises(FileRefusedError, match="is read by this command"):
        check_output(other, [None, given], overwrite=True)


def test_outputs_that_cannot_be_are_refused_before_any_work(tmp_path, odd_files):
    (tmp_path / "dangling").symlink_to(tmp_path / "nowhere")
    for path, sentence in (
        (tmp_path / "no" / "a", "its directory is not there"),
        (tmp_path / "dangling", "link to nothing"),
        (odd_files["named pipe"], "named pipe"),
        (tmp_path, "is a directory"),
    ):
        with pytest.raises(FileRefusedError, match=sentence):
            check_output(path, overwrite=True)
