"""The error of campaigns."""

from __future__ import annotations

from plcsim.core.errors import PlcError


class CampaignError(PlcError):
    """A campaign cannot be what its file says, or cannot be run as asked for."""
