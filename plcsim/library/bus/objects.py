"""Registers of I/O modules and objects of POWERLINK and CANopen nodes: written, then read back.

Such a device is not there, and each answers: what a program writes it reads back, and what nobody
wrote is 0. An I/O channel that is a tag has the value of that tag, and nothing is written to it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.controller import Controller
from plcsim.core.tag import CHANNELS
from plcsim.library.runtime import ERR_OK
from plcsim.library.status_block import DelayedBlock, StatusBlock

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.core.tag import Tag
    from plcsim.library.members import BlockVariables

IOAC_PARAMETER: Final = 30195
"""ioacERR_PARAMETER: a name is missing."""

LONGEST_OBJECT: Final = 0x1_0000
"""Bytes of an object that are kept."""

NAME_LENGTH: Final = 80
"""Characters of the name of a device that count."""

_CAN_BYTES: Final = 8


class _Objects:
    """What programs wrote, by kind of bus, device and place in it; a restart forgets it."""

    def __init__(self, _context: Context) -> None:
        self.written: dict[tuple[object, ...], bytes] = {}


def _objects(context: Context) -> dict[tuple[object, ...], bytes]:
    return context.library(_Objects).written


class ReadChannel(DelayedBlock):
    """AsIOAccRead: a channel or a register of a module, by their names."""

    def act(self, variables: BlockVariables) -> int:
        """Read it."""
        names = _channel(variables)
        if "" in names:
            return IOAC_PARAMETER
        tag = _channel_tag(self.context, names)
        if tag is not None:
            data = self.context.memory.read(tag.address, min(tag.data_type.size, 4))
        else:
            data = _objects(self.context).get(("I/O", *names), b"")
        variables.set(value=int.from_bytes(data, "little"))
        return ERR_OK


class WriteChannel(DelayedBlock):
    """AsIOAccWrite: likewise."""

    def act(self, variables: BlockVariables) -> int:
        """Write it."""
        names = _channel(variables)
        if "" in names:
            return IOAC_PARAMETER
        data = int(variables.number("value")).to_bytes(4, "little")
        _objects(self.context)["I/O", *names] = data
        return ERR_OK


def _channel(variables: BlockVariables) -> tuple[str, str]:
    device, channel = (
        variables.text(name, NAME_LENGTH) for name in ("pDeviceName", "pChannelName")
    )
    return device.upper(), channel.upper()


def _channel_tag(context: Context, names: tuple[str, str]) -> Tag | None:
    controller = Controller.of(context)
    return None if controller is None else controller.tags.get(".".join((CHANNELS, *names)))


class ReadObject(DelayedBlock):
    """EplSDORead: an object of a POWERLINK node."""

    def act(self, variables: BlockVariables) -> int:
        """Read it; of one that nobody wrote all bytes that were asked for are 0."""
        found = _read(self.context, variables, "EPL", "datalen")
        _store(self.context, variables.address("pData"), found)
        variables.set(readlen=len(found), errorinfo=0)
        return ERR_OK


class WriteObject(DelayedBlock):
    """EplSDOWrite."""

    def act(self, variables: BlockVariables) -> int:
        """Write it."""
        data = _taken(self.context, variables.address("pData"), variables.number("datalen"))
        _objects(self.context)[_place(variables, "EPL")] = data
        variables.set(errorinfo=0)
        return ERR_OK


class ReadCanObject(DelayedBlock):
    """CANopenSDORead8: an object of up to eight bytes."""

    def act(self, variables: BlockVariables) -> int:
        """Read it; one that nobody wrote has four bytes."""
        found = _objects(self.context).get(_place(variables, "CAN"), bytes(4))[:_CAN_BYTES]
        bytes_found = {
            f"data{index}": each for index, each in enumerate(found.ljust(_CAN_BYTES, b"\0"))
        }
        variables.set(**bytes_found, datalen=len(found), error=0, errorinfo=0)
        return ERR_OK


class WriteCanObject(DelayedBlock):
    """CANopenSDOWrite8."""

    def act(self, variables: BlockVariables) -> int:
        """Write it."""
        size = min(int(variables.number("datalen")), _CAN_BYTES)
        data = bytes(int(variables.number(f"data{index}")) for index in range(size))
        _objects(self.context)[_place(variables, "CAN")] = data
        variables.set(error=0, errorinfo=0)
        return ERR_OK


class ReadLongCanObject(DelayedBlock):
    """CANopenSDOReadData."""

    def act(self, variables: BlockVariables) -> int:
        """Read it."""
        found = _read(self.context, variables, "CAN", "maxlength")
        _store(self.context, variables.address("pRxdata"), found)
        variables.set(rxlength=len(found), error=0, errorinfo=0)
        return ERR_OK


class WriteLongCanObject(DelayedBlock):
    """CANopenSDOWriteData."""

    def act(self, variables: BlockVariables) -> int:
        """Write it."""
        data = _taken(self.context, variables.address("pTxdata"), variables.number("txlength"))
        _objects(self.context)[_place(variables, "CAN")] = data
        variables.set(error=0, errorinfo=0)
        return ERR_OK


def _place(variables: BlockVariables, bus: str) -> tuple[object, ...]:
    device = variables.text("pDevice", NAME_LENGTH).upper()
    return bus, device, *(int(variables.number(name)) for name in ("node", "index", "subindex"))


def _read(context: Context, variables: BlockVariables, bus: str, size: str) -> bytes:
    most = min(int(variables.number(size)), LONGEST_OBJECT)
    found = _objects(context).get(_place(variables, bus))
    return bytes(most) if found is None else found[:most]


def _store(context: Context, address: int, data: bytes) -> None:
    if address and data:
        context.memory.write(address, data)


def _taken(context: Context, address: int, size: float) -> bytes:
    return context.memory.read(address, min(int(size), LONGEST_OBJECT)) if address else b""


BLOCKS: Final[Mapping[str, type[StatusBlock]]] = {
    "AsIOAccRead": ReadChannel,
    "AsIOAccWrite": WriteChannel,
    "EplSDORead": ReadObject,
    "EplSDOWrite": WriteObject,
    "CANopenSDORead8": ReadCanObject,
    "CANopenSDOWrite8": WriteCanObject,
    "CANopenSDOReadData": ReadLongCanObject,
    "CANopenSDOWriteData": WriteLongCanObject,
}
"""What runs the blocks by their names."""
