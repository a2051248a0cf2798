"""Errors of the tag map.

::

    PlcError
    ├── ConfigurationError
    │   └── TagMapError         a row of tags.csv is wrong; file and line are named
    └── AccessRefused           a request that the map does not allow
        ├── IllegalAddress      no such address, not writable, part of a tag (exception 02)
        └── IllegalValue        out of range, not finite (exception 03)
"""

from __future__ import annotations

from plcsim.core.errors import ConfigurationError, PlcError


class TagMapError(ConfigurationError):
    """The map is wrong; the message names file, line and tag."""


class AccessRefused(PlcError):  # noqa: N818  # what happened to the request
    """The map does not allow a request."""


class IllegalAddress(AccessRefused):
    """There is no such address, or it cannot be accessed this way."""


class IllegalValue(AccessRefused):
    """The tag cannot take the value."""
