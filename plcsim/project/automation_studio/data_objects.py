"""Data objects (``Simple.dob``) that Cpu.sw brings to the controller, for the blocks of DataObj.

Their files are values between commas or line ends: texts in ``"``, which get a 0 at their end, and
numbers, decimal, behind ``$`` hexadecimal, with a decimal point REAL; ``;`` begins a comment.
Automation Studio's help on this is not public; a number takes four bytes here, as tables in public
projects have it.
"""

from __future__ import annotations

import re
import struct
from typing import TYPE_CHECKING, Final

from plcsim.library.dataobj.settings import MadeObjects
from plcsim.library.document import DocumentError, read_document
from plcsim.project.automation_studio.finding import Finding
from plcsim.project.automation_studio.names import in_any_case

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from plcsim.project.automation_studio.logical_view import Package
    from plcsim.project.automation_studio.names import FileNames
    from plcsim.project.automation_studio.software import DataObjectLine

LIST: Final = "Simple.dob"

_VALUE: Final = re.compile(
    rb"""(?P<skip>[\s,]+|;[^\n]*)
    |"(?P<text>[^"\n]*)"
    |\$(?P<hex>[0-9A-Fa-f]{1,8})(?![\w.])
    |(?P<real>[+-]?\d+(?:\.\d*(?:[eE][+-]?\d+)?|[eE][+-]?\d+))(?![\w.])
    |(?P<whole>[+-]?\d{1,10})(?![\w.])""",
    re.VERBOSE,
)


def read_data_objects(
    file: Path, lines: tuple[DataObjectLine, ...], root: Package, names: FileNames
) -> tuple[MadeObjects, list[Finding]]:
    """Read the data objects of a configuration.

    Args:
        file: Cpu.sw.
        lines: of it.
        root: of the logical view.
        names: of the project's files.
    """
    packages = {in_any_case(package.path): package.folder for package in root.walk()}
    contents: dict[str, bytes] = {}
    findings: list[Finding] = []
    for line in lines:
        parent = packages.get(in_any_case(line.source[:-1]))
        folder = None if parent is None else names.below(parent, line.source[-1])
        source = ".".join(line.source)
        if folder is None:
            message = f"data object {line.name}: the logical view has no {source}"
            findings.append(Finding(file, line.line, message, source))
            continue
        try:
            contents[line.name] = b"".join(_files(folder, names))
        except DocumentError as err:
            message = f"data object {line.name} is not there: {err}"
            findings.append(Finding(folder, err.line, message, source))
    return MadeObjects(contents), findings


def _files(folder: Path, names: FileNames) -> Iterator[bytes]:
    """Yield the contents of the files that an object lists.

    Raises:
        DocumentError: the list or one of them is not there, or cannot be read.
    """
    listed = names.below(folder, LIST)
    if listed is None:
        raise DocumentError(f"there is no {LIST}")
    for element in read_document(listed).all("File"):
        file = names.below(folder, element.text.strip())
        if file is None or not file.is_file():
            raise DocumentError(f"File {element.text.strip()} is listed and not there")
        try:
            data = file.read_bytes()
        except OSError as err:
            raise DocumentError(f"{file.name}: {err.strerror}") from None
        try:
            yield encoded(data)
        except DocumentError as err:
            raise DocumentError(f"{file.name}: {err}", err.line) from None


def encoded(data: bytes) -> bytes:
    """Return the bytes that a file of values stands for.

    Raises:
        DocumentError: something in it is no value.
    """
    found, at = bytearray(), 0
    data = data.removeprefix(b"\xef\xbb\xbf")
    while at < len(data):
        match = _VALUE.match(data, at)
        if match is None:
            line = data.count(b"\n", 0, at) + 1
            text = data[at : at + 20].split(b"\n")[0].decode("latin-1").strip()
            raise DocumentError(f"{text!r} is no value", line)
        found += _bytes_of(match)
        at = match.end()
    return bytes(found)


def _bytes_of(match: re.Match[bytes]) -> bytes:
    if (text := match["text"]) is not None:
        return text + b"\0"
    if (digits := match["hex"]) is not None:
        return struct.pack("<I", int(digits, 16))
    if (number := match["real"]) is not None:
        return struct.pack("<f", float(number))
    if (number := match["whole"]) is not None:
        return struct.pack("<I", int(number) & 0xFFFF_FFFF)
    return b""
