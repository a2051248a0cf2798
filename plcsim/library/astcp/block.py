"""What all AsTCP blocks share: enable, status, and the way a block is called until it is done."""

from __future__ import annotations

from plcsim.core.function_block import FunctionBlock
from plcsim.library.astcp.idents import IdentTable
from plcsim.library.astcp.interface import tcpERR_INVALID_IDENT
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE

IDLE = 0
BUSY = 1

IPV4_SIZE = 16
IPV6_SIZE = 46
"""Bytes that a literal takes with its NUL, at most."""


class AsTcpBlock(FunctionBlock):
    """Base of the AsTCP blocks.

    Each call with enable TRUE polls the network and gives a status; ERR_FUB_BUSY asks for another
    call with the same inputs. A call with enable FALSE resets the block to ERR_FUB_ENABLE_FALSE. No
    call waits, so that a program may call until the status changes, even within one cycle.
    """

    __slots__ = ()

    enable: bool
    ident: int
    status: int
    i_state: int
    i_result: int
    i_tmp: int

    def execute(self) -> None:
        """Run one call.

        Raises:
            PageFault: a pointer input is wild; nothing was taken from a socket.
        """
        if self.enable:
            idents = self.context.library(IdentTable)
            status = self.step(idents)
            endpoint = idents.find(self.ident)
            if endpoint is not None:
                endpoint.block, endpoint.status = type(self).__name__, status
            self.status = self.i_result = status
            self.i_state = BUSY if status == ERR_FUB_BUSY else IDLE
        else:
            self.status = ERR_FUB_ENABLE_FALSE
            self.i_state = IDLE

    def step(self, idents: IdentTable) -> int:
        """Do what the block does as far as it goes now; return the status."""
        raise NotImplementedError(f"{type(self).__name__} has no step method.")

    def unknown_ident(self, idents: IdentTable) -> int:
        """Return the status for an ident that is not in use, or not any more."""
        return idents.settings.closed_while_busy if self.i_state == BUSY else tcpERR_INVALID_IDENT

    def ip_at(self, address: int) -> str:
        """Return the STRING at ``address`` as far as a literal of IPv4 or IPv6 can go.

        Raises:
            PageFault: the string runs into an address that is not valid.
        """
        return self.context.memory.string(address, IPV6_SIZE).decode("latin-1")


def ip_size(ip: str) -> int:
    """Return the bytes that a peer's literal takes at most, at a socket bound to ``ip``.

    Programs know 16 of AsTCP; those that listen in IPv6, which AsTCP does not, give more.
    """
    return IPV6_SIZE if ":" in ip else IPV4_SIZE


def ip_string(ip: str) -> bytes:
    """Return an IP address as the NUL-terminated STRING that is stored in PLC memory."""
    return ip.encode("ascii") + b"\0"
