"""Compiled kernels kept on disk: where, under which name, whom to trust, and what to do with
damage.

The directory is `<root>/<fingerprint>`, root = $CONTACT_BENCH_CACHE or
$XDG_CACHE_HOME/contact_bench or ~/.cache/contact_bench. The fingerprint hashes every module with
kernels and what it imports, the versions of everything that takes part in compiling and the
processor: an edited helper in another file, which numba itself does not notice, gives a new
directory. What depends on packages of others too (`outside.py`) lies in a directory of that set:
`<root>/<fingerprint>.<set>.<checksum of their sources>`. Cache files are pickles, and loading a
pickle can run code, so a directory or a file that anyone else owns or can write to is not used.
Each file starts with the hash of its content, which is checked before it is unpickled. The tables
of `pressure/kept_arrays.py` lie there too and are trusted by the same rules (`read_kept`).

A process holds a shared lock on each directory that it uses; one that holds it, or a day's use,
keeps a directory from being removed.
"""

# numba.core.caching has no types.
# mypy: disallow-untyped-calls=False

from __future__ import annotations

import fcntl
import hashlib
import logging
import os
import pickle
import platform
import shutil
import stat
import time
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import llvmlite
import llvmlite.binding
import numba
import numpy
from numba.core.caching import CompileResultCacheImpl, FunctionCache, _CacheLocator
from numba.core.serialize import dumps

from contact_sim_pkg.compiled import claims, linking
from contact_sim_pkg.compiled.outside import digest_of_packages, package_of, packages_in
from contact_sim_pkg.compiled.sources import digest_of_sources

__all__ = [
    "DamagedError", "UntrustedError", "attach_cache", "cache_directory", "fingerprint", "read_kept", "require_private",
    "write_kept",
]  # fmt: skip

_log = logging.getLogger(__name__)

KEPT_FINGERPRINTS = 2
"""Directories of older fingerprints that stay beside the current one, of each set of packages."""
KEPT_SECONDS = 86_400.0
"""[s] since its last use for which a directory stays in any case: other checkouts come back to theirs."""

_PACKAGE = Path(__file__).parents[1]
_DIGITS = 12  # of the name of a set, and of the checksum of its sources
_DIGEST_BYTES = hashlib.sha256().digest_size


def fingerprint(package: Path) -> str:
    """Name everything that machine code depends on: sources of kernels, versions of compiler and
    libraries, processor.
    """
    parts = (
        digest_of_sources(package),
        numba.__version__,
        llvmlite.__version__,
        numpy.__version__,
        _setting("CPU_NAME") or llvmlite.binding.get_host_cpu_name(),
        platform.python_version(),
        f"boundscheck={_setting('BOUNDSCHECK')} opt={_setting('OPT')}",
    )
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:20]


def _setting(name: str) -> Any:
    """A value of numba's configuration, which is made at run time and has no types."""
    return getattr(numba.config, name)


def cache_root() -> Path:
    """The per-user directory that holds one directory for each fingerprint."""
    override = os.environ.get("CONTACT_BENCH_CACHE")
    if override:
        return Path(override).absolute()
    base = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return (base if base.is_absolute() else Path.home() / ".cache") / "contact_bench"


def open_cache_directory(name: str) -> Path:
    """Make `<root>/<name>` (mode 0700) and check that nobody else can write there.

    Raises `OSError` with one sentence when the directory cannot be made, written or trusted.
    """
    root = cache_root()
    directory = root / name
    root.mkdir(mode=0o700, parents=True, exist_ok=True)
    sticky = root.parent.lstat().st_mode & stat.S_ISVTX  # nobody else can replace the root there
    _require_trusted(root.parent, owners=(os.getuid(), 0), forbidden=0 if sticky else stat.S_IWGRP | stat.S_IWOTH)
    _require_trusted(root, owners=(os.getuid(),), forbidden=stat.S_IWGRP | stat.S_IWOTH)
    while not _holds(directory):
        pass
    if not os.access(directory, os.W_OK | os.X_OK):
        raise PermissionError(f"{directory} cannot be written; run 'chmod u+rwx {directory}'")
    os.utime(directory)  # the date of last use, by which _prune chooses
    _prune(root, keep=directory)
    return directory


_held: list[int] = []
"""Descriptors of the directories that this process uses, locked; the system closes them at its end."""


def _holds(directory: Path) -> bool:
    """Make a directory and mark it as used by this process; False where another process has just removed it."""
    directory.mkdir(mode=0o700, exist_ok=True)
    try:
        require_private(directory)
        descriptor = os.open(directory, os.O_RDONLY | os.O_DIRECTORY)
    except FileNotFoundError:
        return False
    with suppress(OSError):  # a file system without locks: its date alone protects it
        fcntl.flock(descriptor, fcntl.LOCK_SH)  # waits while another process is removing it
    _held.append(descriptor)
    return os.fstat(descriptor).st_nlink > 0


def require_private(directory: Path) -> None:
    """Raise `PermissionError` with one sentence unless a directory is the user's own and closed to others."""
    _require_trusted(directory, owners=(os.getuid(),), forbidden=stat.S_IRWXG | stat.S_IRWXO)


def _require_trusted(path: Path, owners: tuple[int, ...], forbidden: int) -> None:
    status = path.lstat()
    mode = stat.S_IMODE(status.st_mode)
    if not stat.S_ISDIR(status.st_mode):
        raise PermissionError(f"{path} is not a directory of its own (a link or a file); remove it")
    if status.st_uid not in owners:
        raise PermissionError(
            f"{path} belongs to user {status.st_uid}, not to user {os.getuid()}; remove it or set CONTACT_BENCH_CACHE"
        )
    if mode & forbidden:
        raise PermissionError(
            f"{path} is open to other users (mode {mode:04o}); remove its content and run 'chmod 700 {path}'"
        )


def _set_of(name: str) -> str:
    """Set of packages that the name of a directory stands for; empty: ours alone."""
    return name.partition(".")[2].partition(".")[0]


def _name_of_set(packages: frozenset[str]) -> str:
    """What follows the fingerprint in the name of the directory of a set of packages of others."""
    if not packages:
        return ""
    named = hashlib.sha256(" ".join(sorted(packages)).encode()).hexdigest()
    return f".{named[:_DIGITS]}.{digest_of_packages(packages)[:_DIGITS]}"


def _prune(root: Path, keep: Path) -> None:
    """Remove all but the most recently used directories of the same set of packages, those in use
    and those of the last day. What vanishes meanwhile, another process has removed.
    """
    last_use: dict[Path, float] = {}
    for path in root.iterdir():
        if path != keep and _set_of(path.name) == _set_of(keep.name):
            with suppress(OSError):
                status = path.lstat()
                last_use.update({path: status.st_mtime} if stat.S_ISDIR(status.st_mode) else {})
    for path in sorted(last_use, key=last_use.__getitem__, reverse=True)[KEPT_FINGERPRINTS:]:
        if time.time() - last_use[path] > KEPT_SECONDS:
            _remove_unused(path)


def _remove_unused(directory: Path) -> None:
    """Remove a directory unless a process holds it."""
    with suppress(OSError):
        descriptor = os.open(directory, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(directory, ignore_errors=True)
        finally:
            os.close(descriptor)


class _Session:
    """The cache of this process: opened at the first decorated function, closed at the first write
    that fails.
    """

    def __init__(self) -> None:
        self.name = ""
        self.directory: Path | None = None
        self._opened = False
        self._warned = False
        self._sets: dict[frozenset[str], Path] = {}

    def open(self) -> Path | None:
        if not self._opened:
            self._opened = True
            self.name = fingerprint(_PACKAGE)
            try:
                self.directory = open_cache_directory(self.name)
            except (OSError, RuntimeError) as error:  # RuntimeError: no home directory is known
                self.close(error)
        return self.directory

    def directory_of(self, packages: frozenset[str]) -> Path | None:
        """Directory of what depends on ``packages`` of others beside ours; None without a cache.

        Raises `OSError` as `open_cache_directory`.
        """
        if self.directory is None or not packages:
            return self.directory
        if packages not in self._sets:
            self._sets[packages] = open_cache_directory(self.name + _name_of_set(packages))
        return self._sets[packages]

    def close(self, error: Exception) -> None:
        """Go on without a cache and report it once."""
        if not self._warned:
            self._warned = True
            _log.warning("compiled kernels are not kept on disk (each start takes some seconds longer): %s", error)
        self.directory = None

    def pass_over(self, reason: str) -> None:
        """Report once that a file is not read; its kernel is compiled again and replaces it."""
        if not self._warned:
            self._warned = True
            _log.warning("%s; it is not read, and compiled again", reason)

    def rebuild(self, error: Exception) -> None:
        """Remove a damaged cache; kernels are compiled again and kept anew."""
        if self.directory is None:
            return
        _log.warning(
            "the cache of compiled kernels in %s is damaged (%s); it is removed and compiled again",
            self.directory,
            error,
        )
        for directory in (self.directory, *self._sets.values()):
            shutil.rmtree(directory, ignore_errors=True)
            with suppress(OSError):  # else the next write says that kernels are not kept
                directory.mkdir(mode=0o700, parents=True, exist_ok=True)


_session = _Session()


def cache_directory() -> Path | None:
    """The directory in use, or `None` when kernels are compiled without a cache."""
    return _session.open()


def attach_cache(dispatcher: Any, form: str = "") -> None:
    """Let a freshly decorated function load its machine code from the cache and save it there.

    ``form`` distinguishes the files of one function that is compiled in several ways. A function
    typed at a prompt has no source whose edit could be seen, and is not kept.
    """
    written = hasattr(dispatcher, "overloads") and Path(dispatcher.py_func.__code__.co_filename).is_file()
    if written and _session.open() is not None:
        try:
            dispatcher._cache = _CheckedCache(dispatcher.py_func, form)
        except (OSError, RuntimeError) as error:
            _session.close(error)


def _place(py_file: str) -> str:
    """Path of a module inside the package, the same in every copy of it and behind every link to
    it; else its name: where that stands is part of the name of the function.
    """
    path = Path(py_file)
    return str(path.relative_to(_PACKAGE)) if path.is_relative_to(_PACKAGE) else path.name


class _Locator(_CacheLocator):
    """Puts the files of a function into the session's directory; never into the source tree."""

    def __init__(self, py_func: Any, py_file: str) -> None:
        self._py_file = py_file  # numba names it where it declines to cache a function
        self._path = str(_session.directory)
        self._line = py_func.__code__.co_firstlineno
        self._module = hashlib.sha256(_place(py_file).encode()).hexdigest()[:8]

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> _Locator:
        return cls(py_func, py_file)

    def ensure_cache_path(self) -> None:
        # Somebody may have emptied the cache meanwhile
        Path(self._path).mkdir(mode=0o700, parents=True, exist_ok=True)

    def get_cache_path(self) -> str:
        return self._path

    def get_source_stamp(self) -> str:
        return _session.name

    def get_disambiguator(self) -> str:
        return f"{self._line}-{self._module}"


class _CheckedCacheImpl(CompileResultCacheImpl):
    _locator_classes = [_Locator]  # noqa: RUF012 - as declared by numba

    def reduce(self, cres: Any) -> Any:
        return linking.reduce(cres)

    def rebuild(self, target_context: Any, payload: Any) -> Any:
        return linking.rebuild(target_context, payload)


class UntrustedError(Exception):
    """A file of the cache that others own or can write to: a phrase that begins with its path."""


class DamagedError(Exception):
    """A file of the cache whose content does not match the hash in front of it: its path and a phrase."""


def read_kept(path: Path) -> bytes:
    """What `write_kept` has written.

    Raises:
        UntrustedError: others own the file or can write to it; it has not been read.
        DamagedError: the content does not match its hash.
        OSError: it is not there, or cannot be read.
    """
    with path.open("rb") as file:
        status = os.fstat(file.fileno())
        if status.st_uid != os.getuid():
            raise UntrustedError(f"{path} belongs to user {status.st_uid}, not to user {os.getuid()}")
        if status.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
            raise UntrustedError(f"{path} can be written by other users (mode {stat.S_IMODE(status.st_mode):04o})")
        content = file.read()
    digest, payload = content[:_DIGEST_BYTES], content[_DIGEST_BYTES:]
    if hashlib.sha256(payload).digest() != digest:
        raise DamagedError(f"{path}: the content does not match its hash")
    return payload


def write_kept(path: Path, payload: bytes) -> None:
    """Write a file of the user's own, led by the hash of its content: it appears whole, in one step
    for other processes, or not at all. Raises `OSError`.
    """
    written = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        written.write_bytes(hashlib.sha256(payload).digest() + payload)
        written.chmod(0o600)
        written.replace(path)
    except BaseException:
        with suppress(OSError):
            written.unlink()
        raise


class _CheckedFiles:
    """One file for each overload of a function, led by the hash of its content.

    numba keeps an index of numbered files, in which two processes that save at once can take each
    other's number. Here the name of a file follows from the key, which it also holds.
    """

    def __init__(self, package: str, name: str) -> None:
        """``package``: that of the function; empty where it is ours."""
        self._own, self._name = frozenset({package} - {""}), name

    def load(self, key: Any) -> Any:
        """What was saved under ``key``; None where nothing was."""
        try:
            payload = read_kept(self.path(key))
        except FileNotFoundError:
            return None
        except UntrustedError as error:
            _session.pass_over(str(error))
            return None
        saved, data = pickle.loads(payload)  # noqa: S301 - own directory, hash checked
        return data if saved == key else None

    def save(self, key: Any, data: Any) -> None:
        """Replace what was saved under ``key``, in one step for other processes."""
        path = self.path(key)
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)  # somebody may have emptied the cache meanwhile
        write_kept(path, dumps((key, data)))

    def path(self, key: Any) -> Path:
        """Where what is saved under ``key`` lies."""
        directory = _session.directory_of(self._own | packages_in(key[0]))
        assert directory is not None  # callers have looked
        return directory / f"{self._name}.{hashlib.sha256(repr(key).encode()).hexdigest()[:16]}"


class _CheckedCache(FunctionCache):
    """numba's function cache; damage leads to a new compilation, a failed write to a run without
    cache.
    """

    _impl_class = _CheckedCacheImpl

    def __init__(self, py_func: Any, form: str) -> None:
        super().__init__(py_func)
        self._cache_file: Any = _CheckedFiles(package_of(py_func.__module__), self._impl.filename_base + form)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        if _session.directory is None:
            return None
        try:
            found = super().load_overload(sig, target_context)
            if found is None and claims.claim(self._path_of(sig, target_context.codegen())):
                found = super().load_overload(sig, target_context)
                if found is not None:
                    claims.release(self._path_of(sig, target_context.codegen()))
        except OSError as error:
            _session.close(error)
            return None
        except Exception as error:  # noqa: BLE001 - whatever unpickling damaged code raises; answered by compiling
            _session.rebuild(error)
            return None
        return found

    def save_overload(self, sig: Any, data: Any) -> None:
        linking.when_loaded(data, partial(self._save, sig, data))
        if _session.directory is not None:
            claims.release(self._path_of(sig, data.codegen))

    def _path_of(self, sig: Any, codegen: Any) -> Path:
        path: Path = self._cache_file.path(self._index_key(sig, codegen))
        return path

    def _save(self, sig: Any, data: Any) -> None:
        if _session.directory is None:
            return
        try:
            super().save_overload(sig, data)
        except OSError as error:
            _session.close(error)
        except Exception as error:  # noqa: BLE001 - a damaged index, read before it is written
            _session.rebuild(error)
