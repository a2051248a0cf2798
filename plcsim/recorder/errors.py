"""The one error of this house."""

from __future__ import annotations

from plcsim.core.errors import PlcError


class RecordingError(PlcError):
    """A bag cannot be written, read or replayed; the message names the file and why."""
