"""The wheels' paths of their build machine become this environment's."""

from pathlib import Path

import pytest

from set_up.relocation import Target, relocated

TARGET = Target(Path("/home/x/.ros2"), "/usr/include/python3.12", "/home/x/.ros2/lib/numpy/include")


@pytest.mark.parametrize(
    ("built", "here"),
    [
        ("/opt/python/cp312-cp312/include/python3.12;", "/usr/include/python3.12;"),
        ("/opt/python/cp313-cp313t/include/python3.13t", "/usr/include/python3.12"),
        (
            "/opt/python/cp310-cp310/lib/python3.10/site-packages/numpy/core/include",
            "/home/x/.ros2/lib/numpy/include",
        ),
        (
            "/opt/python/cp312-cp312/lib/python3.12/site-packages/numpy/_core/include",
            "/home/x/.ros2/lib/numpy/include",
        ),
        ('"/project/build/temp.linux-x86_64-cpython-312/install/share"', '"/home/x/.ros2/share"'),
        ("AMENT=/opt/python/cp311-cp311:/usr", "AMENT=/home/x/.ros2:/usr"),
        ("/opt/python/cp311-cp311/lib/other", "/opt/python/cp311-cp311/lib/other"),
        ("/usr/include/python3.12", "/usr/include/python3.12"),
    ],
)
def test_each_kind_of_foreign_path_is_replaced_and_no_other(built, here):
    assert relocated(built, TARGET) == here


def test_relocating_twice_changes_nothing_more():
    once = relocated("/opt/python/cp312-cp312/include/python3.12 /opt/python/cp312-cp312", TARGET)
    assert relocated(once, TARGET) == once
