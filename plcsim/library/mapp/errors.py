"""Values of StatusID: the numbers that the vendor's enumerations have."""

from __future__ import annotations

from typing import Final

NO_ERROR: Final = 0
MPLINK_NULL: Final = -1064239102
"""Of every component."""

ALARM_NOT_ACTIVE: Final = -1064116220
ACK_NOT_ALLOWED: Final = -1064116218
NAME_NOT_FOUND: Final = -1064116212
MISSING_UICONNECT: Final = -2137858045
"""Of MpAlarmXErrorEnum."""
