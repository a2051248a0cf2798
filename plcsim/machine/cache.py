"""Compiled code on disk, so that a program is compiled once.

An entry is a file named by a hash of the module, the version and settings of the compiler, and the
processor. It begins with a hash of its content: machine code that has been damaged must not run. An
entry that cannot be used is no error, the code is compiled again; neither is a folder that cannot
be written.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import platform
import tempfile
from functools import cache
from pathlib import Path

MAX_BYTES = 256 << 20
"""Default size of a cache; beyond it the entries that were unused for longest go."""

MAX_ENTRIES = 8192
"""Default number of entries, for those that hold next to nothing."""

_LOOK = 16
"""The folder is looked through when this part of what it may hold was written since."""

_DIGEST = 32
_SUFFIX = ".code"


_written: dict[Path, int] = {}
"""Bytes that this process wrote since it looked through a folder; caches of one folder share it."""


def default_folder() -> Path | None:
    """Return the user's cache folder (XDG Base Directory), None where there is no home."""
    given = os.environ.get("XDG_CACHE_HOME", "")
    if Path(given).is_absolute():
        return Path(given) / "plcsim" / "code"
    try:
        return Path.home() / ".cache" / "plcsim" / "code"
    except RuntimeError:
        return None


class CodeCache:
    """Compiled code in a folder.

    Several processes may use one folder at the same time.

    Args:
        folder: where; it is made when something is stored. None keeps nothing.
        max_bytes: size of all entries together; another sixteenth may be written before it is
            looked at.
        max_entries: number of entries, likewise.
    """

    def __init__(
        self, folder: Path | None, max_bytes: int = MAX_BYTES, max_entries: int = MAX_ENTRIES
    ) -> None:
        self._folder = folder
        self._max_bytes = max_bytes
        self._max_entries = max_entries

    @property
    def keeps(self) -> bool:
        """Whether anything that is stored can be loaded again."""
        return self._folder is not None

    def load(self, key: str) -> bytes | None:
        """Return the code stored under a key, None where there is none that can be used."""
        if self._folder is None:
            return None
        file = self._folder / (key + _SUFFIX)
        try:
            with file.open("rb") as stream:
                status = os.fstat(stream.fileno())
                if status.st_uid not in (os.geteuid(), 0):
                    return None  # somebody else's machine code
                # as much as there is: Python makes room for all that is asked for, which is 256 MB
                # in pages that are locked and so are real
                size = min(status.st_size, self._max_bytes)
                digest, code = stream.read(_DIGEST), stream.read(size)
        except OSError:
            return None
        if digest != _hash(code):
            return None
        with contextlib.suppress(OSError):
            os.utime(file)
        return code

    def store(self, key: str, code: bytes) -> None:
        """Keep code under a key, if the folder can be written."""
        if self._folder is None or _DIGEST + len(code) > self._max_bytes:
            return
        with contextlib.suppress(OSError):
            self._folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            self._replace(self._folder / (key + _SUFFIX), _hash(code) + code)
            if self._is_due(_DIGEST + len(code)):
                self._shrink()

    def _is_due(self, size: int) -> bool:
        """Whether the folder is to be looked through after an entry of ``size`` bytes.

        At each entry it would take longer than what is saved: thousands of files are there.
        """
        assert self._folder is not None
        least = self._max_bytes // self._max_entries
        written = _written.get(self._folder, self._max_bytes) + max(size, least)
        is_due = written * _LOOK >= self._max_bytes
        _written[self._folder] = 0 if is_due else written
        return is_due

    def _replace(self, file: Path, content: bytes) -> None:
        """Write a file as a whole: who reads it meanwhile finds the old one or the new one."""
        handle, name = tempfile.mkstemp(dir=file.parent, prefix="new-")
        try:
            with os.fdopen(handle, "wb") as stream:
                stream.write(content)
            os.replace(name, file)  # noqa: PTH105  # a string from mkstemp
        except OSError:
            Path(name).unlink(missing_ok=True)
            raise

    def _shrink(self) -> None:
        """Delete the entries unused for longest, until the rest fits."""
        assert self._folder is not None
        entries = []
        with os.scandir(self._folder) as found:
            for entry in found:
                with contextlib.suppress(OSError):
                    status = entry.stat()
                    entries.append((status.st_mtime_ns, status.st_size, entry.path))
        total, count = sum(size for _, size, _ in entries), len(entries)
        for _, size, path in sorted(entries):
            if total <= self._max_bytes and count <= self._max_entries:
                return
            with contextlib.suppress(OSError):
                os.unlink(path)  # noqa: PTH108  # a string from scandir
            total, count = total - size, count - 1


def key_of(wasm: bytes, settings: str) -> str:
    """Return the key of a module compiled with ``settings`` for this processor."""
    state = hashlib.blake2b(wasm, digest_size=24)
    state.update(f"\0{settings}\0{_processor()}".encode())
    return state.hexdigest()


def _hash(code: bytes) -> bytes:
    return hashlib.blake2b(code, digest_size=_DIGEST).digest()


@cache
def _processor() -> str:
    """Return what tells processors apart for which code is compiled."""
    try:
        with Path("/proc/cpuinfo").open(encoding="utf-8", errors="replace") as lines:
            named = ("flags", "Features")
            flags = next((line for line in lines if line.startswith(named)), "")
    except OSError:
        flags = ""
    return platform.machine() + flags
