"""Makes the Python environment inside the project: ROS 2 from PyPI, or what a sourced ROS 2 lacks."""

import re
import shutil
import subprocess
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from .errors import SetUpError
from .layout import BUILD_TOOLS_LOCK, ENVIRONMENT, LOCK, environment_python
from .progress import Count, Progress
from .relocation import relocate
from .shell_files import write_shell_files
from .underlay import Underlay

CMAKE_OLDEST = (3, 20)

# What a ROS 2 of the system has in versions of its own, which its message generators and classes were made with.
SYSTEM_NAMES = {"catkin-pkg", "empy", "lark-parser", "numpy", "pyyaml", "setuptools"}


# Where pip looks for packages: its option, uv's variable and what that puts between two values.
_UV_NAMES = {
    "index-url": ("UV_DEFAULT_INDEX", " "),
    "extra-index-url": ("UV_INDEX", " "),
    "find-links": ("UV_FIND_LINKS", ","),
    "trusted-host": ("UV_INSECURE_HOST", " "),
    "cert": ("SSL_CERT_FILE", " "),
}
_PIP_ALONE = {"client-cert", "constraint", "no-binary", "no-index", "only-binary", "proxy", "require-hashes"}
_SECTIONS = ("global", "install", ":env:")  # of pip's configuration, the strongest last


def make_environment(underlay: Underlay, environ: dict[str, str], progress: Progress) -> None:
    """Make the environment anew: virtual environment, locked packages, paths, shell files.

    Raises SetUpError where venv or pip fail.
    """
    progress.remove(ENVIRONMENT)
    options = [] if underlay.prefix is None else ["--system-site-packages"]
    command = [str(underlay.python), "-m", "venv", *options, str(ENVIRONMENT)]
    if progress.run(command, "making the virtual environment", environ=environ, cwd=Path("/")):
        raise SetUpError("the virtual environment could not be made, its message stands above: name another Python.")
    (ENVIRONMENT / "base_python").write_text(f"{underlay.python}\n", encoding="utf-8")
    _install(underlay, environ, progress)
    if underlay.prefix is None:
        relocate(ENVIRONMENT, environment_python(), environ)
    write_shell_files(ENVIRONMENT, underlay)


@contextmanager
def modules_compiled(environ: dict[str, str]) -> Iterator[None]:
    """Meanwhile the installed modules are compiled to bytecode, at the lowest priority: uv leaves that to the first start."""
    compile_all = [str(environment_python()), "-m", "compileall", "-q", "-x", "/tests?/", str(ENVIRONMENT / "lib")]
    with subprocess.Popen(
        ["nice", "-n", "19", *compile_all], env=environ, cwd="/", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        close_fds=False,
    ) as program:  # fmt: skip
        try:
            yield
        finally:
            program.terminate()


def system_requirements(lock: Iterable[str], system_has_colcon: bool) -> list[str]:
    """The lines of the lock that a sourced ROS 2 lacks."""
    return [line for line in lock if not _comes_with_ros(line, system_has_colcon)]


def missing_build_tools(environ: dict[str, str]) -> list[str]:
    """The names, cmake and ninja, that have to come from PyPI."""
    path = environ.get("PATH")
    missing = [] if _cmake_version(environ) >= CMAKE_OLDEST else ["cmake"]
    if not any(shutil.which(name, path=path) for name in ("ninja", "make", "gmake")):
        missing.append("ninja")
    return missing


def uv_variables(pip_configuration: str) -> dict[str, str] | None:
    """Variables by which uv finds packages where pip does, from the output of `pip config list`; None where pip is
    configured by what it alone understands.
    """
    options = [
        re.fullmatch(r"(global|install|:env:)\.([a-z-]+)='(.*)'", line) for line in pip_configuration.splitlines()
    ]
    found: dict[str, str] = {}
    for match in sorted(filter(None, options), key=lambda match: _SECTIONS.index(match[1])):
        if match[2] in _PIP_ALONE:
            return None
        if match[2] in _UV_NAMES:
            name, between = _UV_NAMES[match[2]]
            found[name] = between.join(match[3].replace("\\n", " ").split())
    return found


class Packages:
    """Counts packages in the lines of an installer: of pip all, of uv the large ones, which alone it names."""

    def __init__(self, total: int) -> None:
        """Before the first line; `total` is what pip has to collect."""
        self._total, self._collected, self._begun, self._downloaded = total, 0, 0, 0

    def __call__(self, line: str) -> Count | None:
        """The count after this line."""
        words = line.split(" ")
        self._collected += words[0] == "Collecting"
        self._begun += words[0] == "Downloading"
        self._downloaded += words[:2] == ["", "Downloaded"]
        if self._collected:
            return Count(min(self._collected, self._total), self._total)
        return Count(self._downloaded, self._begun, "downloads") if self._begun else None


def _install(underlay: Underlay, environ: dict[str, str], progress: Progress) -> None:
    lines = _pins(LOCK)
    if underlay.prefix is not None:
        lines = system_requirements(lines, _has_colcon(environ))
    tools = missing_build_tools(environ)
    lines += [pin for pin in _pins(BUILD_TOOLS_LOCK) if _name(pin) in tools]
    wanted = ENVIRONMENT / "requirements.txt"
    wanted.write_text("\n".join(lines) + "\n", encoding="utf-8")
    # The lock is complete: nobody has to look for what a package asks for.
    options = ["--no-deps", "-r", str(wanted)]
    python = str(environment_python())
    pip = [python, "-m", "pip"]
    install = [*pip, "install", "--progress-bar", "off"]
    asked = subprocess.run([*pip, "config", "list"], env=environ, cwd="/", capture_output=True, text=True, check=False)
    variables = uv_variables(asked.stdout)

    def succeeds(command: list[str], what: str, count: Packages, environ: dict[str, str] = environ) -> bool:
        return progress.run(command, what, environ=environ, cwd=Path("/"), count=count) == 0

    if variables is not None:
        (uv_pin,) = [pin for pin in lines if _name(pin) == "uv"]
        uv = [str(ENVIRONMENT / "bin" / "uv"), "pip", "install", "--python", python]
        if succeeds([*install, uv_pin], "installing uv, the installer", Packages(1)) and succeeds(
            [*uv, *options],
            f"installing {len(lines)} packages",
            Packages(0),
            variables | environ,
        ):
            return
    what = "installing packages by pip, some minutes"
    if not succeeds([*install, "--prefer-binary", *options], what, Packages(len(lines))):
        raise SetUpError(
            "the locked packages could not be installed (pip's message stands above): "
            "check the network and call make setup again, it starts over."
        )


def _pins(lock: Path) -> list[str]:
    lines = (line.strip() for line in lock.read_text(encoding="utf-8").splitlines())
    return [line for line in lines if line and not line.startswith("#")]


def _name(pin: str) -> str:
    return re.split(r"[\[=<>;~! ]", pin, maxsplit=1)[0].lower().replace("_", "-")


def _comes_with_ros(pin: str, system_has_colcon: bool) -> bool:
    name = _name(pin)
    return name.startswith("ros-") or name in SYSTEM_NAMES or (system_has_colcon and name.startswith("colcon-"))


def _has_colcon(environ: dict[str, str]) -> bool:
    command = [str(environment_python()), "-c", "import colcon_core, colcon_cmake, colcon_ros, colcon_defaults"]
    return subprocess.run(command, env=environ, cwd="/", capture_output=True, check=False).returncode == 0


def _cmake_version(environ: dict[str, str]) -> tuple[int, int]:
    if not shutil.which("cmake", path=environ.get("PATH")):
        return (0, 0)
    shown = subprocess.run(["cmake", "--version"], env=environ, capture_output=True, text=True, check=False).stdout
    match = re.search(r"version (\d+)\.(\d+)", shown)
    return (int(match[1]), int(match[2])) if match else (0, 0)
