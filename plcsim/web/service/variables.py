"""The tree of variables: what lies in a variable, and the search over all of them."""

from __future__ import annotations

from functools import cached_property
from itertools import islice, product
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.tag import leaves
from st_types.types.derived import (
    ArrayType,
    DataBlockType,
    EnumerationType,
    StringType,
    StructType,
    SubrangeType,
    WStringType,
    resolve_alias,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.core.tag import Tag
    from plcsim.shared_image import Directory
    from plcsim.web.service.follower import Follower
    from st_types.types.elementary import DataType

MOST_CHILDREN: Final = 500
MOST_FOUND: Final = 200
MOST_KNOWN: Final = 200_000
"""VariableTree that the search knows; of an ARRAY it knows the first element."""


class VariableTree:
    """The variables of a controller, as the pages show them.

    Args:
        directory: of the shared image.
        follower: knows which variables are pointers.
    """

    def __init__(self, directory: Directory, follower: Follower) -> None:
        self._directory = directory
        self._follower = follower

    def roots(self) -> list[dict[str, Any]]:
        """Return the programs, and every global variable."""
        found = []
        for area in self._directory.areas:
            if area.path:
                found.append(_described(area.path, area.path, area.data_type, area.is_constant))
            else:
                found += self._members(area.data_type, "", area.is_constant)
        return found

    def children(self, path: str, first: int = 0) -> dict[str, Any]:
        """Return what lies in a variable, at most `MOST_CHILDREN`, and how many there are.

        Raises:
            TagError: there is no such variable.
        """
        found: list[dict[str, Any]] = []
        areas = [a for a in self._directory.areas if a.path == path]
        if areas and path:  # a program has an area for its variables and one for its constants
            for area in areas:
                found += self._members(area.data_type, path, area.is_constant)
            return {"children": found[first : first + MOST_CHILDREN], "count": len(found)}
        return self.inside(self._directory.find(path), first)

    def inside(self, tag: Tag, first: int = 0) -> dict[str, Any]:
        """Return what lies in a variable, as `children` does; what has no parts is its own."""
        if isinstance(tag.data_type, ArrayType):
            return {
                "children": self._elements(tag, first),
                "count": tag.data_type.size // max(1, tag.data_type.element.size),
            }
        found = self._members(tag.data_type, tag.path, tag.is_constant)
        if "^" in tag.path and not isinstance(tag.data_type, StructType):
            found = [{**self.describe(tag), "name": "^"}]
        return {"children": found[first : first + MOST_CHILDREN], "count": len(found)}

    def describe(self, tag: Tag) -> dict[str, Any]:
        """Return what the pages know of one variable."""
        described = _described(tag.path, tag.path, tag.data_type, tag.is_constant)
        target = self._follower.pointer(tag.path)
        return described if target is None else {**described, "pointer": str(target)}

    def search(self, text: str) -> dict[str, Any]:
        """Return the variables whose path has all words of a text, the shortest first."""
        words = text.lower().split()
        found = [path for path, low in self._known if all(word in low for word in words)]
        best = sorted(found, key=lambda path: (path.count("."), len(path)))[:MOST_FOUND]
        return {
            "found": [self.describe(self._directory.find(path)) for path in best],
            "count": len(found),
        }

    def _members(
        self, data_type: DataType[Any], path: str, is_constant: bool
    ) -> list[dict[str, Any]]:
        if not isinstance(data_type, StructType):
            return []
        is_block = isinstance(data_type, DataBlockType)
        found = []
        for member in data_type.members:
            inner = f"{path}.{member.name}" if path else member.name
            described = _described(inner, member.name, member.data_type, is_constant)
            if is_block:
                described["section"] = member.section.value
            target = self._follower.target(data_type, member.name, inner)
            if target is not None and not isinstance(member.data_type, ArrayType):
                described["pointer"] = str(target)
            found.append(described)
        return found

    def _elements(self, tag: Tag, first: int) -> list[dict[str, Any]]:
        data_type = tag.data_type
        assert isinstance(data_type, ArrayType)
        target = self._follower.pointer(f"{tag.path}[0]")
        more = {} if target is None else {"pointer": str(target)}
        indices: Iterator[tuple[int, ...]]
        indices = product(*(range(low, high + 1) for low, high in data_type.bounds))
        found = []
        for index in islice(indices, first, first + MOST_CHILDREN):
            name = f"[{', '.join(map(str, index))}]"
            described = _described(tag.path + name, name, data_type.element, tag.is_constant)
            found.append({**described, **more})
        return found

    @cached_property
    def _known(self) -> list[tuple[str, str]]:
        paths = (t.path for area in self._directory.areas for t in leaves(area, elements=False))
        return [(path, path.lower()) for path in islice(paths, MOST_KNOWN)]


def _described(
    path: str,
    name: str,
    declared: DataType[Any],
    is_constant: bool,  # as in `Tag`
) -> dict[str, Any]:
    data_type = resolve_alias(declared)
    found: dict[str, Any] = {
        "path": path,
        "name": name,
        "type": str(data_type),
        "kind": _kind(data_type),
    }
    if is_constant:
        found["constant"] = True
    if "^" in path:
        found["followed"] = True
    if isinstance(data_type, EnumerationType):
        found["names"] = list(data_type.values)
    return found


def _kind(data_type: DataType[Any]) -> str:
    """Return "branch" for what has parts, and how the pages write a value otherwise."""
    if isinstance(data_type, StructType | ArrayType):
        return "branch"
    if isinstance(data_type, EnumerationType):
        return "enumeration"
    if isinstance(data_type, StringType | WStringType):
        return "string"
    base = data_type.base.name if isinstance(data_type, SubrangeType) else str(data_type)
    if base == "BOOL":
        return "bool"
    if base in ("REAL", "LREAL"):
        return "real"
    if base in ("TIME", "DATE", "TIME_OF_DAY", "DATE_AND_TIME"):
        return "time"
    return f"integer {8 * data_type.size} {'signed' if base in _SIGNED else 'unsigned'}"


_SIGNED: Final = ("SINT", "INT", "DINT", "LINT")
