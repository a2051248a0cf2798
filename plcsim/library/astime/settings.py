"""Table [library.astime] of plc.toml."""

from __future__ import annotations

from typing import Annotated, Final

from plcsim.settings import Whole, settings

FARTHEST_MINUTES: Final = 14 * 60
"""The time zone that is farthest from UTC."""


@settings
class AsTimeSettings:
    """Settings of the library.

    Attributes:
        utc_offset: minutes by which local time is ahead of UTC.
    """

    utc_offset: Annotated[int, Whole(-FARTHEST_MINUTES, FARTHEST_MINUTES)] = 0
