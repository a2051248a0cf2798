"""IP addresses between text and number, which holds the first of the four at its first byte."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.library.aseth.interface import ethERR_PARAMETER
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK
from plcsim.network.protocol import is_ipv4

if TYPE_CHECKING:
    from plcsim.core.context import Context

_SIZE: Final = 16
"""Bytes that an IP address takes as text."""


@function("ethInetAton")
def number_of(context: Context, p_text: int, p_number: int) -> int:
    """Store an IP address as a UDINT; return ERR_OK, or ethERR_PARAMETER where it is none."""
    if not p_text or not p_number:
        return ethERR_PARAMETER
    text = context.memory.string(p_text, _SIZE).decode("latin-1")
    if not is_ipv4(text):
        return ethERR_PARAMETER
    context.memory.write(p_number, bytes(int(part) for part in text.split(".")))
    return ERR_OK


@function("ethInetNtoa")
def text_of(context: Context, number: int, p_text: int) -> int:
    """Store a UDINT as an IP address; return ERR_OK or ethERR_PARAMETER."""
    if not p_text:
        return ethERR_PARAMETER
    text = ".".join(str(part) for part in number.to_bytes(4, "little"))
    context.memory.write(p_text, text.encode("ascii") + b"\0")
    return ERR_OK
