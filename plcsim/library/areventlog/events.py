"""Events: numbers made of severity, area, facility and code."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.library.areventlog.interface import (
    arEVENTLOG_SEVERITY_ERROR,
    arEVENTLOG_SEVERITY_INFO,
    arEVENTLOG_SEVERITY_SUCCESS,
    arEVENTLOG_SEVERITY_WARNING,
)
from plcsim.library.areventlog.logs import event_id, severity_of
from plcsim.library.executable import function

if TYPE_CHECKING:
    from plcsim.core.context import Context


@function("ArEventLogMakeEventID")
def make(_context: Context, severity: int, facility: int, code: int) -> int:
    """Return an event of the user's area."""
    return event_id(severity, facility, code, is_customer=True)


@function("ArEventLogIsSuccess")
def is_success(_context: Context, event: int) -> bool:
    """Return whether an event is a success."""
    return severity_of(event) == arEVENTLOG_SEVERITY_SUCCESS


@function("ArEventLogIsInformation")
def is_information(_context: Context, event: int) -> bool:
    """Return whether an event is an information."""
    return severity_of(event) == arEVENTLOG_SEVERITY_INFO


@function("ArEventLogIsWarning")
def is_warning(_context: Context, event: int) -> bool:
    """Return whether an event is a warning."""
    return severity_of(event) == arEVENTLOG_SEVERITY_WARNING


@function("ArEventLogIsError")
def is_error(_context: Context, event: int) -> bool:
    """Return whether an event is an error."""
    return severity_of(event) == arEVENTLOG_SEVERITY_ERROR


@function("ArEventLogIsCustomerArea")
def is_of_customer(_context: Context, event: int) -> bool:
    """Return whether an event is of the user's area."""
    return bool(event >> 29 & 1)
