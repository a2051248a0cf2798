"""ROS graph names: which are legal, and what they mean in a namespace.

Source: wiki.ros.org/Names.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.errors import InvalidNameError

if TYPE_CHECKING:
    from collections.abc import Mapping

SEPARATOR: Final = "/"
PRIVATE: Final = "~"

_NAME: Final = re.compile(r"[~/A-Za-z][\w/]*", re.A)
_BASE_NAME: Final = re.compile(r"[A-Za-z]\w*", re.A)


def check_name(name: str) -> str:
    """Return a legal graph name as it is.

    Raises:
        InvalidNameError: it has a character that names may not have, or none.
    """
    if not name or not _NAME.fullmatch(name):
        raise InvalidNameError(f"{name[:100]!r} is not a ROS name.")
    return name


def check_base_name(name: str) -> str:
    """Return a legal base name, one without namespace, as it is; raises as ``check_name`` does."""
    if not _BASE_NAME.fullmatch(name):
        raise InvalidNameError(f"{name[:100]!r} is not a ROS name without namespace.")
    return name


def canonical(name: str) -> str:
    """Return a name with single slashes, and none at the end but that of the root."""
    name = re.sub("/+", SEPARATOR, name)
    return name if name == SEPARATOR else name.rstrip(SEPARATOR)


def join(namespace: str, name: str) -> str:
    """Return a name within a namespace; a global name stays as it is."""
    if name.startswith(SEPARATOR):
        return canonical(name)
    return canonical(f"{namespace}{SEPARATOR}{name}")


def namespace_of(name: str) -> str:
    """Return the namespace that holds a resolved name: ``/a`` of ``/a/b``, ``/`` of ``/a``."""
    return name.rpartition(SEPARATOR)[0] or SEPARATOR


class NodeNames(NamedTuple):
    """Name and namespace of a node, both resolved, and its remappings from resolved to resolved."""

    node: str
    namespace: str
    remappings: Mapping[str, str]

    def resolve(self, name: str) -> str:
        """Return the global name that the program means, remapped.

        Raises:
            InvalidNameError: not a legal name.
        """
        resolved = resolve(check_name(name), self.namespace, self.node)
        return self.remappings.get(resolved, resolved)


def resolve(name: str, namespace: str, node: str) -> str:
    """Return the global name that ``name`` means in a namespace, or within a node."""
    if name.startswith(PRIVATE):
        return join(node, name[1:].lstrip(SEPARATOR))
    return join(namespace, name)
