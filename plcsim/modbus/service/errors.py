"""Errors of the Modbus service.

::

    PlcError
    └── ModbusException      a request that is answered by an exception response; has its code
"""

from __future__ import annotations

from enum import IntEnum

from plcsim.core.errors import PlcError


class ExceptionCode(IntEnum):
    """Exception codes (MODBUS Application Protocol V1.1b3, chapter 7)."""

    ILLEGAL_FUNCTION = 1
    ILLEGAL_DATA_ADDRESS = 2
    ILLEGAL_DATA_VALUE = 3
    SERVER_DEVICE_FAILURE = 4
    SERVER_DEVICE_BUSY = 6
    GATEWAY_TARGET_FAILED = 11


class ModbusException(PlcError):  # noqa: N818  # the term of the specification
    """A request is refused.

    Attributes:
        code: goes into the exception response.
    """

    def __init__(self, code: ExceptionCode, text: str = "") -> None:
        super().__init__(text or code.name)
        self.code = code
