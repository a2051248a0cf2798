"""Two files, written in turn: whenever a process dies, one of them is whole.

A file is a head (magic, number of the generation, sizes), the variables with their types as JSON,
their bytes, and the SHA-256 of all that. The older file is written over and given to the disk
(fdatasync(2)) before the other one is touched; the one with the higher number is valid, unless its
checksum says that it was not finished.
"""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
from contextlib import contextmanager
from struct import Struct
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.core.tag import Tag
from plcsim.retain.errors import RetainError
from plcsim.shared_image.directory import describe_type, type_from
from plcsim.shared_image.errors import ImageError
from st_types.errors import TypeSystemError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

MAGIC: Final = b"plcsim retained 1\n"
NAMES: Final = ("retained.1", "retained.2")
LOCK: Final = "lock"
MOST_BYTES: Final = 1 << 31
"""No larger file is read; the PLC memory is not larger either."""

_HEAD: Final = Struct("<18sQII")
_SUM: Final = 32


class Generation(NamedTuple):
    """What a file holds.

    Attributes:
        number: of the generation, from 1.
        variables: their addresses count within ``data``.
        data: their bytes.
    """

    number: int
    variables: Sequence[Tag]
    data: bytes


def describe(variables: Sequence[Tag]) -> bytes:
    """Return names and types of variables, as a file has them."""
    rows = [[tag.path, describe_type(tag.data_type)] for tag in variables]
    return json.dumps(rows, separators=(",", ":")).encode()


def encode(number: int, described: bytes, data: bytes) -> bytes:
    """Return the file of a generation."""
    body = _HEAD.pack(MAGIC, number, len(described), len(data)) + described + data
    return body + hashlib.sha256(body).digest()


def decode(text: bytes) -> Generation:
    """Return the generation that a file holds.

    Raises:
        ValueError: it holds none; the argument says why.
    """
    if len(text) < _HEAD.size + _SUM:
        raise ValueError("it is truncated")
    magic, number, described, size = _HEAD.unpack_from(text)
    if magic != MAGIC:
        raise ValueError("it holds no retained variables of this version of plcsim")
    end = _HEAD.size + described + size
    if len(text) < end + _SUM:
        raise ValueError("it is truncated")
    if hashlib.sha256(text[:end]).digest() != text[end : end + _SUM]:
        raise ValueError("its checksum is wrong")
    rows = json.loads(text[_HEAD.size : _HEAD.size + described])
    return Generation(number, _variables(rows, size), text[end - size : end])


def _variables(rows: list[list[Any]], size: int) -> list[Tag]:
    """Return what a file describes, one after another."""
    found, at = [], 0
    try:
        for path, kind in rows:
            found.append(Tag(path, type_from(kind), at))
            at += found[-1].data_type.size
    except (ImageError, TypeSystemError, KeyError, TypeError, ValueError) as err:
        raise ValueError(f"its types cannot be read: {err}") from None
    if at != size:
        raise ValueError("its types do not fit its bytes")
    return found


class Generations:
    """The two files of a folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._files = [folder / name for name in NAMES]
        self._newest = -1
        self._number = 0

    def latest(self) -> tuple[Generation | None, list[str]]:
        """Return the newest generation that is whole, and what is wrong with the files.

        Raises:
            RetainError: they cannot be read.
        """
        found: Generation | None = None
        wrong = []
        for index, file in enumerate(self._files):
            try:
                with file.open("rb") as opened:
                    generation = decode(opened.read(MOST_BYTES))
            except FileNotFoundError:
                continue
            except OSError as err:
                raise RetainError(f"{file}: cannot be read: {err.strerror}") from None
            except ValueError as err:
                wrong.append(f"{file}: {err}")
                continue
            if found is None or generation.number > found.number:
                found, self._newest = generation, index
                self._number = generation.number
        return found, wrong

    def write(self, described: bytes, data: bytes) -> None:
        """Write a generation over the older one; `latest` was called before.

        Raises:
            RetainError: it cannot be written; the newer one is as it was.
        """
        index = 1 - self._newest if self._newest >= 0 else 0
        file = self._files[index]
        try:
            write_file(file, encode(self._number + 1, described, data))
        except OSError as err:
            raise RetainError(f"{file}: cannot be written: {err.strerror}") from None
        self._newest, self._number = index, self._number + 1

    def clear(self) -> None:
        """Delete both."""
        for file in self._files:
            file.unlink(missing_ok=True)

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Have the folder for oneself.

        Raises:
            RetainError: another run has it, or it cannot be made.
        """
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            fd = os.open(self.folder / LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
        except OSError as err:
            raise RetainError(f"{self.folder}: cannot be written: {err.strerror}") from None
        try:
            fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
            yield
        except BlockingIOError:
            raise RetainError(f"{self.folder}: another run keeps its variables here") from None
        finally:
            os.close(fd)


def write_file(file: Path, text: bytes) -> None:
    """Write a file and give it to the disk; there is no moment without the file."""
    fd = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_CLOEXEC, 0o644)
    try:
        left = memoryview(text)
        while left:
            left = left[os.write(fd, left) :]
        os.ftruncate(fd, len(text))
        os.fdatasync(fd)
    finally:
        os.close(fd)
