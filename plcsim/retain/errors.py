"""Errors of this house."""

from plcsim.core.errors import PlcError


class RetainError(PlcError):
    """The retained variables cannot be read or written, or another run has them."""
