"""The tags of the controller under test, as a mapping that says clearly what is wrong."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from plcsim.core.errors import TagError
from plcsim.core.tag import encode_tag
from plcsim.testing.values import leaves_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag

__tracebackhide__ = True


class Tags:
    """Reads and writes tags by path; case does not matter.

    Attributes:
        read: paths read since the controller was made, the latest last.
    """

    def __init__(self, controller: Controller) -> None:
        self._table = controller.tags
        self._memory = controller.memory
        self._known: dict[str, Tag] = {}
        self.read: dict[str, None] = {}

    def find(self, path: str) -> Tag:
        """Return a tag.

        Raises:
            TagError: there is no such tag; near names are offered.
        """
        tag = self._known.get(path)
        if tag is None:
            if not isinstance(path, str):
                raise TagError(f'{path!r} is no tag; tags are named "program.variable"')
            try:
                tag = self._known[path] = self._table.find(path)
            except TagError as err:
                raise TagError(str(err)) from None
        return tag

    def __getitem__(self, path: str) -> Any:
        """Return the plain value of a tag: a dict for a STRUCT, a list for an ARRAY.

        Raises:
            TagError: there is no such tag.
        """
        tag = self._known.get(path) or self.find(path)
        self.read.pop(path, None)
        self.read[path] = None
        return self._memory.get(tag.data_type, tag.address)

    def __setitem__(self, path: str, value: object) -> None:
        """Store a value at once; programs see it in their next cycle.

        Raises:
            TagError: there is no such tag, or it cannot take the value.
        """
        self._memory.write(self.find(path).address, self.encode(path, value))

    def encode(self, path: str, value: object) -> bytes:
        """Return the bytes of a value for a tag.

        Raises:
            TagError: there is no such tag, or it cannot take the value.
        """
        return encode_tag(self.find(path), value)

    def store(self, path: str, data: bytes) -> None:
        """Store bytes made by `encode`."""
        self._memory.write(self.find(path).address, data)

    def peek(self, path: str) -> object:
        """Return the value of a tag without noting that it was read."""
        tag = self.find(path)
        return self._memory.get(tag.data_type, tag.address)

    def raw(self, path: str) -> bytes:
        """Return the bytes of a tag."""
        tag = self.find(path)
        return self._memory.read(tag.address, tag.data_type.size)

    def leaves(self, path: str) -> list[Tag]:
        """Return the tags of elementary types at or below a path."""
        self.find(path)
        return leaves_of(self._table, path)

    @contextmanager
    def noting(self, paths: dict[str, None]) -> Iterator[None]:
        """Note the paths that are read inside the block."""
        before, self.read = self.read, paths
        try:
            yield
        finally:
            self.read = before | dict.fromkeys(paths)

    def paths(self) -> list[str]:
        """Return the paths of all tags of elementary types."""
        return [tag.path for tag in self._table]
