"""Who installs the locked packages, from where, and how far it is."""

import sys
from pathlib import Path

import pytest

from set_up import environment
from set_up.environment import Packages, uv_variables
from set_up.errors import SetUpError
from set_up.progress import Count
from set_up.underlay import Underlay


class Installers:
    """In place of Progress: keeps the programs that are started; those named fail."""

    def __init__(self, *failing: str):
        self.failing, self.started = failing, []

    def run(self, command, what, **_):
        program = "uv" if command[0].endswith("/uv") else "uv's pip" if command[-1].startswith("uv==") else "pip"
        self.started.append(program)
        if program != "uv's pip":
            assert command[-3:] == ["--no-deps", "-r", str(environment.ENVIRONMENT / "requirements.txt")]
        return program in self.failing


@pytest.fixture
def install(tmp_path, monkeypatch):
    monkeypatch.setattr(environment, "ENVIRONMENT", tmp_path)
    monkeypatch.setattr(environment, "environment_python", lambda: Path(sys.executable))

    def install(*failing: str, **variables: str) -> list[str]:
        installers = Installers(*failing)
        environ = {"PATH": "/usr/bin:/bin", "PIP_CONFIG_FILE": "/dev/null", **variables}
        environment._install(Underlay(None, Path(sys.executable)), environ, installers)
        return installers.started

    return install


def test_uv_installs_the_lock_and_pip_where_uv_cannot(install):
    assert install() == ["uv's pip", "uv"]
    assert install("uv") == ["uv's pip", "uv", "pip"]
    assert install("uv's pip") == ["uv's pip", "pip"]
    assert install(PIP_PROXY="http://proxy.example") == ["pip"]
    with pytest.raises(SetUpError, match="could not be installed"):
        install("uv", "pip")


@pytest.mark.parametrize(
    ("lines", "counted"),
    [
        (["Collecting numpy==2.2.6", "  Downloading numpy-2.2.6.whl", "Collecting scipy"], Count(2, 9)),
        (["Resolved 9 packages in 1.2s", "Downloading scipy (33.7MiB)", "Downloading numpy (16.0MiB)",
          " Downloaded numpy"], Count(1, 2, "downloads")),
        (["Resolved 9 packages in 1.2s", "Installed 9 packages in 58ms"], None),
    ],
)  # fmt: skip
def test_packages_are_counted_in_the_lines_of_pip_and_of_uv(lines, counted):
    packages = Packages(9)
    assert [packages(line) for line in lines][-1] == counted


def test_uv_looks_for_packages_where_pip_is_told_to():
    configured = (
        ":env:.extra-index-url='https://a.example https://b.example'\n"
        ":env:.index-url='https://here.example'\n"
        "global.find-links='\\n/one\\n/two'\n"
        "global.index-url='https://there.example'\n"
        "global.timeout='60'\n"
    )
    assert uv_variables(configured) == {
        "UV_DEFAULT_INDEX": "https://here.example",
        "UV_INDEX": "https://a.example https://b.example",
        "UV_FIND_LINKS": "/one,/two",
    }
    assert uv_variables("") == {}


def test_pip_installs_by_itself_where_it_is_told_what_uv_cannot_be():
    assert uv_variables("global.proxy='http://proxy.example'\n") is None
    assert uv_variables(":env:.no-index='1'\n") is None
