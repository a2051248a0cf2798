"""Files of recipes: values of variables by their names, as XML or CSV.

The names of elements and attributes are those of the vendor's configuration files; nothing public
says which ones its recipes have. A value of a STRUCT stands under its path.
"""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING, NamedTuple
from xml.sax.saxutils import quoteattr

from plcsim.library.document import DocumentError, parse

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from plcsim.library.document import XmlElement


class RecipeContent(NamedTuple):
    """What a file of a recipe holds.

    Attributes:
        header: texts by the members of the header.
        values: texts by the path inside, by the variable.
    """

    header: Mapping[str, str]
    values: Mapping[str, Mapping[str, str]]


class RecipeFileError(Exception):
    """A file is no recipe."""


def xml_of(content: RecipeContent) -> bytes:
    """Return the text of an XML file."""
    lines = ['<?xml version="1.0" encoding="utf-8"?>', "<DATA>"]
    if content.header:
        lines.append('  <Group ID="Header">')
        lines += (_property(name, text) for name, text in content.header.items())
        lines.append("  </Group>")
    for variable, values in content.values.items():
        lines.append(f"  <Element ID={quoteattr(variable)}>")
        lines += (_property(path, text) for path, text in values.items())
        lines.append("  </Element>")
    return "\n".join([*lines, "</DATA>", ""]).encode("utf-8", "replace")


def _property(name: str, text: str) -> str:
    printable = "".join(c if c.isprintable() else "?" for c in text)
    return f"    <Property ID={quoteattr(name)} Value={quoteattr(printable)} />"


def content_of_xml(data: bytes) -> RecipeContent:
    """Return what an XML file holds.

    Raises:
        RecipeFileError: it is no XML.
    """
    try:
        root = parse(data)
    except DocumentError as err:
        raise RecipeFileError(str(err)) from None
    header = {
        each.get("ID"): each.get("Value")
        for group in root.children
        if group.tag == "Group" and group.get("ID") == "Header"
        for each in group.all("Property")
    }
    values = {each.get("ID"): dict(_inside(each, "")) for each in root.all("Element")}
    return RecipeContent(header, values)


def _inside(element: XmlElement, prefix: str) -> Iterator[tuple[str, str]]:
    """Yield the values of an element and its groups, by their paths."""
    for child in element.children:
        name = child.get("ID")
        path = f"{prefix}{'' if name.startswith('[') or not prefix else '.'}{name}"
        if child.tag == "Property":
            yield path, child.get("Value")
        elif child.tag == "Group":
            yield from _inside(child, path)


def csv_of(content: RecipeContent) -> bytes:
    """Return the text of a CSV file: variable, path inside, value."""
    text = io.StringIO()
    writer = csv.writer(text, delimiter=";", lineterminator="\r\n")
    writer.writerows(("Header", name, value) for name, value in content.header.items())
    for variable, values in content.values.items():
        writer.writerows((variable, path, value) for path, value in values.items())
    return text.getvalue().encode("utf-8", "replace")


def content_of_csv(data: bytes) -> RecipeContent:
    """Return what a CSV file holds.

    Raises:
        RecipeFileError: it is no CSV with three columns.
    """
    header: dict[str, str] = {}
    values: dict[str, dict[str, str]] = {}
    try:
        for row in csv.reader(io.StringIO(data.decode("utf-8", "replace")), delimiter=";"):
            if row:
                variable, path, value = row
                (header if variable == "Header" else values.setdefault(variable, {}))[path] = value
    except (csv.Error, ValueError) as err:
        raise RecipeFileError(str(err)) from None
    return RecipeContent(header, values)
