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

NO_FILE_DEVICE: Final = -1064140797
NO_FILE_NAME: Final = -1064140796
NOT_SAVED: Final = -1064140799
NOT_LOADED: Final = -1064140798
NOTHING_REGISTERED: Final = -2137882606
NOTHING_FOUND: Final = -2137882600
NO_SUCH_PV: Final = -1064140786
PV_NAME_NULL: Final = -1064140783
RECIPE_WITHOUT_UICONNECT: Final = -2137882611
NOT_DELETED: Final = -1064140780
"""Of MpRecipeErrorEnum; what begins with -2 is a warning: the block goes on."""

FILE_WITHOUT_UICONNECT: Final = -1064165376
NOTHING_TO_PASTE: Final = -1064165374
NOTHING_SELECTED: Final = -1064165373
DIR_ALREADY_EXISTS: Final = -1064165372
INVALID_FILE_DEVICE: Final = -1064165371
NAME_EMPTY: Final = -1064165370
INVALID_NAME: Final = -1064165369
PASTE_NOT_ALLOWED: Final = -1064165368
FILE_SYSTEM: Final = -1064165367
"""Of MpFileErrorEnum."""


def is_error(status: int) -> bool:
    """Whether a status is an error, and not a warning or an information."""
    return (status >> 30) & 0b11 == 0b11  # the two bits of the severity
