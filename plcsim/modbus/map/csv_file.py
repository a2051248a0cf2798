"""tags.csv: one row for each tag, read with the line of every error, and written."""

from __future__ import annotations

import codecs
import csv
import io
import math
import re
from typing import TYPE_CHECKING, Final

from plcsim.core.suggestion import did_you_mean
from plcsim.modbus.map.errors import TagMapError
from plcsim.modbus.map.point import ACCESSES, ADDRESSES, KINDS, ORDERS, Area, MapRow

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from pathlib import Path
    from typing import Any

COLUMNS: Final = (
    "tag", "area", "offset", "bit", "type", "length", "order", "access", "scale", "offset_eu",
    "unit", "min", "max", "alias", "partial", "group", "iec", "description",
)  # fmt: skip
REQUIRED: Final = ("tag", "area", "offset")

_ATTRIBUTES = {"min": "minimum", "max": "maximum"}
_NUMBER = re.compile(r"[+-]?[0-9]+")
_REALS = ("scale", "offset_eu", "min", "max")
_DECIMAL_COMMA = re.compile(r"[+-]?[0-9]+,[0-9]+([eE][+-]?[0-9]+)?")


DELIMITERS: Final = ",;\t"
"""A spreadsheet writes what its language takes for a list: semicolons in German, for example."""


def read_file(file: Path) -> list[MapRow]:
    """Return the rows of a file, see `read_rows`.

    UTF-8 is expected; what is none was written by a spreadsheet on Windows, in code page 1252.

    Raises:
        TagMapError: the file cannot be read, or a field is wrong.
        FileNotFoundError: there is no such file.
    """
    try:
        data = file.read_bytes()
        if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
            raise TagMapError(f"{file}: is UTF-16; save it as CSV UTF-8")
        return read_rows(_decoded(data), file)
    except FileNotFoundError:
        raise
    except (OSError, UnicodeDecodeError) as err:
        raise TagMapError(f"{file}: cannot be read: {err}") from None


def _decoded(data: bytes) -> str:
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("cp1252")


def read_rows(text: str, file: Path) -> list[MapRow]:
    """Return the rows of a map.

    Empty lines and lines that start with ``#`` are skipped; the first other line names the columns,
    separated by commas, semicolons or tabs. Where it is not commas, numbers may have one.

    Args:
        text: contents of the file.
        file: named in errors.

    Raises:
        TagMapError: a field is wrong; file, line and column are named.
    """
    lines = io.StringIO(text.removeprefix("\ufeff"), newline=None)
    delimiter = _delimiter(text)
    reader = csv.reader(lines, delimiter=delimiter, strict=True)
    header: list[str] | None = None
    rows: list[MapRow] = []
    try:
        for line in reader:
            fields = [field.strip() for field in line]
            if not any(fields) or _is_remark(fields[0]):
                continue
            if header is None:
                header = _header(fields, file, reader.line_num)
            else:
                if delimiter != ",":
                    fields = _with_points(header, fields)
                rows.append(_row(header, fields, file, reader.line_num))
    except csv.Error as err:
        raise TagMapError(f"{file}:{reader.line_num}: {err}") from None
    if header is None:
        raise TagMapError(f"{file}: holds no line that names the columns")
    return rows


def _delimiter(text: str) -> str:
    """Return what separates the columns in the line that names them."""
    for line in text.removeprefix("\ufeff").splitlines():
        plain = line.strip(f' "{DELIMITERS}')
        if plain and not _is_remark(plain):
            return max(DELIMITERS, key=line.count)
    return ","


def _is_remark(start: str) -> bool:
    """Return True for comments, and for the line with which Excel marks its files."""
    return start.startswith("#") or start.lower().startswith("sep=")


def _with_points(header: Sequence[str], fields: Sequence[str]) -> list[str]:
    """Return fields with numbers such as ``0,1`` written with a point."""
    reals = [i for i, name in enumerate(header) if name in _REALS]
    return [
        field.replace(",", ".") if i in reals and _DECIMAL_COMMA.fullmatch(field) else field
        for i, field in enumerate(fields)
    ]


def _header(names: list[str], file: Path, line: int) -> list[str]:
    for name in names:
        if name not in COLUMNS:
            hint = did_you_mean(name, COLUMNS) or f"; known are {', '.join(COLUMNS)}"
            raise TagMapError(f"{file}:{line}: unknown column {name!r}{hint}")
        if names.count(name) > 1:
            raise TagMapError(f"{file}:{line}: two columns are called {name}")
    for name in REQUIRED:
        if name not in names:
            raise TagMapError(f"{file}:{line}: column {name} is missing")
    return names


def _row(header: list[str], fields: list[str], file: Path, line: int) -> MapRow:
    if len(fields) > len(header):
        raise TagMapError(f"{file}:{line}: {len(fields)} fields for {len(header)} columns")
    values: dict[str, Any] = {"line": line}
    for name, text in zip(header, fields, strict=False):
        if text or name in REQUIRED:
            try:
                values[_ATTRIBUTES.get(name, name)] = _FIELDS[name](text)
            except ValueError as err:
                raise TagMapError(f"{file}:{line}: {name}: {err}") from None
    for name in REQUIRED:
        if name not in values:
            raise TagMapError(f"{file}:{line}: {name} is missing")
    return MapRow(**values)


def _text(text: str) -> str:
    return text


def _tag(text: str) -> str:
    if not text:
        raise ValueError("a tag is needed")
    return text


def _area(text: str) -> Area:
    try:
        return Area(text.lower())
    except ValueError:
        raise ValueError(f"{text!r} is not co, di, ir or hr") from None


def _whole(low: int, high: int) -> Callable[[str], int]:
    def convert(text: str) -> int:
        if not _NUMBER.fullmatch(text) or not low <= int(text) <= high:
            raise ValueError(f"{text!r} is not a number from {low} to {high}")
        return int(text)

    return convert


def _one_of(*allowed: str) -> Callable[[str], str]:
    def convert(text: str) -> str:
        for value in allowed:
            if text.lower() == value.lower():
                return value
        raise ValueError(f"{text!r} is not one of {', '.join(allowed)}")

    return convert


def _real(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise ValueError(f"{text!r} is not a number") from None
    if not math.isfinite(value):
        raise ValueError(f"{text!r} is not a finite number")
    return value


def _scale(text: str) -> float:
    value = _real(text)
    if value == 0:
        raise ValueError("must not be 0")
    return value


def _flag(text: str) -> bool:
    if text.lower() not in ("0", "1", "false", "true", "no", "yes"):
        raise ValueError(f"{text!r} is neither 0 nor 1")
    return text.lower() in ("1", "true", "yes")


_FIELDS: Final[dict[str, Callable[[str], object]]] = {
    "tag": _tag,
    "area": _area,
    "offset": _whole(0, ADDRESSES - 1),
    "bit": _whole(0, 15),
    "type": _one_of(*KINDS),
    "length": _whole(1, 125),
    "order": _one_of(*ORDERS),
    "access": _one_of(*ACCESSES),
    "scale": _scale,
    "offset_eu": _real,
    "unit": _text,
    "min": _real,
    "max": _real,
    "alias": _flag,
    "partial": _flag,
    "group": _text,
    "iec": _text,
    "description": _text,
}


def write_rows(rows: Iterable[MapRow]) -> str:
    """Return rows as the text of a map; `read_rows` gives them back."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for row in rows:
        values = {name: getattr(row, _ATTRIBUTES.get(name, name)) for name in COLUMNS}
        values["length"] = row.length or None
        writer.writerow([_written(value) for value in values.values()])
    return out.getvalue()


def _written(value: object) -> str:
    if isinstance(value, Area):
        return value.value
    if value is None or value is False:
        return ""
    if value is True:
        return "1"
    if isinstance(value, float):
        return repr(value).removesuffix(".0")
    return str(value)
