"""``IoMap.iom``, ``PvMap.vvm`` and ``Cpu.per``: variables by I/O channel, by variable, by memory.

All three are a VAR_CONFIG::

    ::Belt:start AT %IX."X20DI9371".DigitalInput01 INVERSE;   (* IoMap.iom *)
    ::Plant.level AT %Q.::Belt:level;                         (* PvMap.vvm: copies to the right *)
    gCount AT %MD200;                                         (* Cpu.per *)
"""

from __future__ import annotations

import codecs
import re
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.project.automation_studio.finding import Finding
from st_types.syntax.source import read_at_most

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from pathlib import Path
    from typing import TypeVar

    T = TypeVar("T")

MAX_BYTES: Final = 16 << 20
"""Bytes of a file that are read; real ones stay below 1 MiB."""

_COMMENT = re.compile(r"\(\*.*?(?:\*\)|\Z)|//[^\n]*", re.DOTALL)
_FRAME = re.compile(r"\b(VAR_CONFIG|END_VAR)\b", re.IGNORECASE)
_LINE = re.compile(r"(?P<pv>.+?) AT ?%(?P<place>.*)", re.IGNORECASE)
_CHANNEL = re.compile(
    r'(?P<direction>[IQ])(?P<width>[XBWDO])\s*\.\s*"(?P<module>[^"]+)"\s*\.\s*(?P<channel>\S+?)'
    r"\s*(?P<inverse>\bINVERSE)?",
    re.IGNORECASE,
)
_COPY = re.compile(r"Q\s*\.\s*(?P<target>.+)", re.IGNORECASE)
_VARIABLE = re.compile(
    r"(?:Cyclic#(?P<number>[1-8])\.)?(?:::)?(?:(?P<task>[^:.\s]+):)?(?P<path>[^:\s][^:]*)",
    re.IGNORECASE,
)


class Pv(NamedTuple):
    """A variable as a map names it.

    Attributes:
        task: it belongs to, "" for a global variable, or for one that may be either.
        path: of the variable there, members and indices included.
        task_class: that is named with it, None where none is.
    """

    task: str
    path: str
    task_class: int | None = None

    @property
    def tag(self) -> str:
        """Path of its tag."""
        return f"{self.task}.{self.path}" if self.task else self.path


class Channel(NamedTuple):
    """A line of IoMap.iom.

    Attributes:
        pv: the variable.
        direction: "I" or "Q".
        width: "X", "B", "W", "D" or "O": bit, 1, 2, 4, 8 bytes.
        module: the I/O module.
        channel: of the module, with what follows it.
        is_inverse: the variable has the negated value.
        location: file and line.
    """

    pv: Pv
    direction: str
    width: str
    module: str
    channel: str
    is_inverse: bool
    location: str

    @property
    def name(self) -> str:
        """The channel as the map spells it."""
        return f'%{self.direction}{self.width}."{self.module}".{self.channel}'


class PvMapLine(NamedTuple):
    """A line of PvMap.vvm: the value of a variable goes to another one.

    Attributes:
        source: the variable that is read.
        target: the one that is written.
        location: file and line.
    """

    source: Pv
    target: Pv
    location: str


class Permanent(NamedTuple):
    """A line of Cpu.per: a variable that outlives a cold restart.

    Attributes:
        pv: the variable.
        location: file and line.
    """

    pv: Pv
    location: str


class Maps(NamedTuple):
    """What the maps of a configuration say.

    Attributes:
        channels: of I/O modules.
        copies: of variables to variables.
        permanent: variables that outlive a cold restart.
    """

    channels: Sequence[Channel] = ()
    copies: Sequence[PvMapLine] = ()
    permanent: Sequence[Permanent] = ()


NO_MAPS: Final = Maps()


class _Line(NamedTuple):
    """A line of a map: the variable, what stands after ``AT %``, and where.

    What is no such line has no variable, and all its text is the place.
    """

    pv: Pv | None
    place: str
    number: int


def read_maps(
    channels: Iterable[Path], copies: Iterable[Path], permanent: Iterable[Path]
) -> tuple[Maps, list[Finding]]:
    """Read the files of a configuration's maps, and what is wrong in them."""
    findings: list[Finding] = []
    return Maps(
        _all(read_channels, channels, findings),
        _all(read_copies, copies, findings),
        _all(read_permanent, permanent, findings),
    ), findings


def _all(
    read: Callable[[Path], tuple[Sequence[T], list[Finding]]],
    files: Iterable[Path],
    findings: list[Finding],
) -> tuple[T, ...]:
    result: list[T] = []
    for file in files:
        found, wrong = read(file)
        result += found
        findings += wrong
    return tuple(result)


def read_channels(file: Path) -> tuple[list[Channel], list[Finding]]:
    """Read IoMap.iom."""
    lines, findings = _lines(file)
    channels: list[Channel] = []
    for line in lines:
        found = _CHANNEL.fullmatch(line.place)
        if found is None or line.pv is None:
            findings.append(_unknown(file, line, "no mapping of an I/O channel"))
        else:
            channels.append(_channel(line.pv, found, _location(file, line)))
    return channels, findings


def _channel(pv: Pv, found: re.Match[str], location: str) -> Channel:
    direction, width = found["direction"].upper(), found["width"].upper()
    inverse = found["inverse"] is not None
    return Channel(pv, direction, width, found["module"], found["channel"], inverse, location)


def read_copies(file: Path) -> tuple[list[PvMapLine], list[Finding]]:
    """Read PvMap.vvm."""
    lines, findings = _lines(file)
    copies: list[PvMapLine] = []
    for line in lines:
        found = _COPY.fullmatch(line.place)
        target = None if found is None else _pv(found["target"])
        if line.pv is None or target is None:
            findings.append(_unknown(file, line, "no mapping of a variable to another"))
        else:
            copies.append(PvMapLine(line.pv, target, _location(file, line)))
    return copies, findings


def read_permanent(file: Path) -> tuple[list[Permanent], list[Finding]]:
    """Read the names of permanent variables from Cpu.per."""
    lines, findings = _lines(file)
    variables: list[Permanent] = []
    for line in lines:
        if line.pv is None or not line.place.upper().startswith("M"):
            findings.append(_unknown(file, line, "no mapping of a permanent variable"))
        else:
            variables.append(Permanent(line.pv, _location(file, line)))
    return variables, findings


def _location(file: Path, line: _Line) -> str:
    return f"{file}:{line.number}"


def _unknown(file: Path, line: _Line, message: str) -> Finding:
    return Finding(file, line.number, f"{line.place[:100]!r}: {message}")


def _lines(file: Path) -> tuple[list[_Line], list[Finding]]:
    try:
        with file.open("rb") as stream:
            data = read_at_most(stream, MAX_BYTES + 1)
    except OSError as err:
        return [], [Finding(file, 0, err.strerror or str(err))]
    if len(data) > MAX_BYTES:
        return [], [Finding(file, 0, f"it is larger than {MAX_BYTES >> 20} MiB")]
    text = _COMMENT.sub(_blank, _decoded(data))
    return [_line(part, number) for part, number in _statements(text)], _open_end(file, text)


def _open_end(file: Path, text: str) -> list[Finding]:
    """Return a finding where a VAR_CONFIG has no end: what stood there was lost in saving."""
    frames = [found[0].upper() for found in _FRAME.finditer(text)]
    if frames.count("VAR_CONFIG") <= frames.count("END_VAR"):
        return []
    line = text.rstrip().count("\n") + 1
    return [Finding(file, line, "END_VAR is missing: the file ends in the middle")]


def _line(text: str, number: int) -> _Line:
    found = _LINE.fullmatch(text)
    pv = None if found is None else _pv(found["pv"])
    return _Line(pv, text if found is None else found["place"], number)


def _decoded(data: bytes) -> str:
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return data.decode("utf-16", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def _statements(text: str) -> Iterator[tuple[str, int]]:
    """Yield what stands between semicolons, and the line it begins in."""
    text = _FRAME.sub(lambda found: " " * len(found[0]), text)
    line = 1
    for part in text.split(";"):
        blank = len(part) - len(part.lstrip())
        if blank < len(part):
            yield " ".join(part.split()), line + part.count("\n", 0, blank)
        line += part.count("\n")


def _blank(found: re.Match[str]) -> str:
    return " " + "\n" * found[0].count("\n")


def _pv(text: str) -> Pv | None:
    found = _VARIABLE.fullmatch(text.strip())
    if found is None:
        return None
    number = found["number"]
    return Pv(found["task"] or "", found["path"].strip(), int(number) if number else None)
