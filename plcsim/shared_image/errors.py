"""Errors of the shared process image.

::

    PlcError
    └── ImageError            the mapping is not one of ours, or has changed under the reader
        ├── ImageNotReady     the scan process has not laid it out yet, or published nothing yet
        └── CommandRefused    the ring is full, or the command is too long for it
"""

from __future__ import annotations

from plcsim.core.errors import PlcError


class ImageError(PlcError):
    """The shared image cannot be used."""


class ImageNotReady(ImageError):  # noqa: N818  # a state, not a fault
    """There is nothing to read yet."""


class CommandRefused(ImageError):  # noqa: N818  # what happened to the command
    """The command was not queued; nothing of it will be applied."""
