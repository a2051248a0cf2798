"""The parameter server's tree: values by global names, and who is told of a change.

A name is a path of keys; a dictionary is a namespace. A subscriber to a name hears of every change
at it, above it and below it, and of nothing else: ``/p`` is not ``/pother``.
"""

from __future__ import annotations

from copy import deepcopy
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.errors import InvalidNameError
from crosnode.graph.names import PRIVATE, SEPARATOR, join, namespace_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from crosnode.xmlrpc import Value

Path = tuple[str, ...]

MAX_DEPTH: Final = 30
"""Keys within each other; a deeper tree could not be sent in one XML-RPC document."""


class ParameterChange(NamedTuple):
    """What a subscriber is told: ``value`` is now at ``key``; an empty dictionary means deleted."""

    key: str
    value: Value


def path_of(name: str) -> Path:
    """Return the keys of a global name; none for the root."""
    return tuple(key for key in name.split(SEPARATOR) if key)


class ParameterTree:
    """Parameters by global name.

    Args:
        max_size: bytes, roughly, that keys and values may take together.
    """

    def __init__(self, max_size: int) -> None:
        self._max_size = max_size
        self._size = 0
        self._root: dict[str, Value] = {}

    def get(self, name: str) -> Value:
        """Return a copy of the value, a dictionary for a namespace.

        Raises:
            KeyError: nothing is there.
        """
        return deepcopy(self._find(path_of(name)))

    def __contains__(self, name: str) -> bool:
        try:
            self._find(path_of(name))
        except KeyError:
            return False
        return True

    def set(self, name: str, value: Value) -> None:
        """Put a value at a name; it replaces all that was there, and values on the way.

        Raises:
            ValueError: the tree would be too large or too deep.
            InvalidNameError: the root is to hold something else than a namespace.
        """
        path = path_of(name)
        if not path and not isinstance(value, dict):
            raise InvalidNameError("the root can only hold a dictionary")
        if len(path) + _depth(value) > MAX_DEPTH:
            raise ValueError(f"more than {MAX_DEPTH} keys within each other")
        old = self._find(path) if name in self else None
        at_most = self._size - _size(old) + _size(value) + sum(_size({key: None}) for key in path)
        if at_most > self._max_size:
            raise ValueError(f"parameters of more than {self._max_size} bytes")
        self._put(path, deepcopy(value))

    def delete(self, name: str) -> None:
        """Delete a parameter or a namespace.

        Raises:
            KeyError: nothing is there, or it is the root.
        """
        path = path_of(name)
        if not path:
            raise KeyError(name)
        self._size -= _size(self._find(path)) + len(path[-1])
        del self._find(path[:-1])[path[-1]]

    def search(self, namespace: str, key: str) -> str | None:
        """Return the name in the nearest namespace that holds the first part of ``key``.

        Starts in ``namespace`` itself and goes up to the root; the rest of ``key`` need not exist.
        """
        if key.startswith(SEPARATOR):
            return key if key in self else None
        first, *_ = path_of(key) or ("",)
        while first and not key.startswith(PRIVATE):
            if join(namespace, first) in self:
                return join(namespace, key)
            if namespace == SEPARATOR:
                break
            namespace = namespace_of(namespace)
        return None

    def names(self) -> list[str]:
        """Return the names of all values that are no namespace."""
        return list(_names("", self._root))

    def _find(self, path: Iterable[str]) -> Value:
        value: Value = self._root
        for key in path:
            if not isinstance(value, dict):
                raise KeyError(key)
            value = value[key]
        return value

    def _put(self, path: Path, value: Value) -> None:
        if not path:
            self._root, self._size = value, _size(value)
            return
        namespace = self._root
        for key in path[:-1]:
            if not isinstance(namespace.get(key), dict):
                self._replace(namespace, key, {})
            namespace = namespace[key]
        self._replace(namespace, path[-1], value)

    def _replace(self, namespace: dict[str, Value], key: str, value: Value) -> None:
        old = _size(namespace[key]) if key in namespace else -len(key)
        self._size += _size(value) - old
        namespace[key] = value


def changes_for(subscribed: str, name: str, value: Value) -> list[ParameterChange]:
    """Return what a subscriber to ``subscribed`` is told when ``name`` is set to ``value``.

    A name above hears the change as it is, a name below its own part of it.
    """
    above, below = path_of(subscribed), path_of(name)
    if below[: len(above)] == above:
        return [ParameterChange(slashed(name), deepcopy(value))]
    if above[: len(below)] != below:
        return []
    for key in above[len(below) :]:
        value = value.get(key, {}) if isinstance(value, dict) else {}
    return [ParameterChange(slashed(subscribed), deepcopy(value))]


def slashed(name: str) -> str:
    """Return a name as masters send it in paramUpdate, with a slash behind it."""
    return name.rstrip(SEPARATOR) + SEPARATOR


def _names(prefix: str, namespace: dict[str, Value]) -> Iterator[str]:
    for key, value in namespace.items():
        name = f"{prefix}{SEPARATOR}{key}"
        if isinstance(value, dict):
            yield from _names(name, value)
        else:
            yield name


def _depth(value: Value) -> int:
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return 1 + max(map(_depth, inner), default=0)


def _size(value: Value) -> int:
    """Return roughly the bytes of a value; nothing for None."""
    if isinstance(value, dict):
        return 64 + sum(len(key) + _size(inner) for key, inner in value.items())
    if isinstance(value, list):
        return 64 + sum(map(_size, value))
    if value is None:
        return 0
    return 32 + (len(value) if isinstance(value, (str, bytes)) else 0)
