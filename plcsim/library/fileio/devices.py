"""Devices: DevLink, DevUnlink, sizes and names of them; FileIoGetSysError."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from plcsim.library.executable import function
from plcsim.library.fileio import interface
from plcsim.library.fileio.block import FileIoBlock
from plcsim.library.fileio.interface import (
    fiERR_DATA,
    fiERR_DATA_SIZE,
    fiERR_DEVICE_ALREADY_EXIST,
    fiERR_DEVICE_INVALID_HANDLE,
    fiERR_FILE_DEVICE,
    fiERR_NO_MORE_ENTRIES,
    fiERR_NOT_SUPPORTED,
    fiERR_PARAMETER,
    fiERR_SYSTEM,
)
from plcsim.library.fileio.transfer import LAST_BYTE
from plcsim.library.fileio.volumes import FileRefusedError, LinkedDevice, Volumes

if TYPE_CHECKING:
    from plcsim.core.context import Context

_FOLDER: Final = b"/DEVICE="


class DevLink(interface.DevLink, FileIoBlock):
    """Make a device of ``/DEVICE=PATH``, where PATH begins with a name of [library.FileIO].

    Inputs: enable, pDevice, pParam. Outputs: status (fiERR_DEVICE_ALREADY_EXIST, fiERR_PARAMETER,
    fiERR_NOT_SUPPORTED for a device on the network, fiERR_SYSTEM where there is no such path),
    handle.
    """

    def act(self, volumes: Volumes) -> None:
        """Make it."""
        self.handle = 0
        name = volumes.text(self.pDevice, fiERR_FILE_DEVICE)
        parameter = volumes.text(self.pParam, fiERR_PARAMETER)
        if not name or not parameter.startswith(b"/"):
            raise FileRefusedError(fiERR_PARAMETER)
        if volumes.folder(name) is not None:
            raise FileRefusedError(fiERR_DEVICE_ALREADY_EXIST)
        if not parameter.upper().startswith(_FOLDER):
            raise FileRefusedError(fiERR_NOT_SUPPORTED)
        folder = volumes.linked_folder(parameter[len(_FOLDER) :].strip())
        if folder is None or not folder.is_dir():
            raise FileRefusedError(fiERR_SYSTEM)
        if volumes.links.full:
            raise FileRefusedError(fiERR_NO_MORE_ENTRIES)
        self.handle = volumes.links.add(LinkedDevice(name, folder))


class DevUnlink(interface.DevUnlink, FileIoBlock):
    """Take a device of DevLink away. Inputs: enable, handle. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Take it away."""
        if volumes.links.remove(self.handle) is None:
            raise FileRefusedError(fiERR_DEVICE_INVALID_HANDLE)


class DevMemInfo(interface.DevMemInfo, FileIoBlock):
    """Bytes of a device, at most a UDINT. Inputs: enable, pDevice. Outputs: freemem, memsize."""

    def act(self, volumes: Volumes) -> None:
        """Ask the host."""
        info = os.statvfs(volumes.path(self.pDevice, 0, is_optional=True))
        self.freemem = min(info.f_bavail * info.f_frsize, LAST_BYTE)
        self.memsize = min(info.f_blocks * info.f_frsize, LAST_BYTE)


class GetVolumeLabel(interface.GetVolumeLabel, FileIoBlock):
    """The label of a device's volume: the device's name.

    Inputs: enable, pDevice, pLabel, labelMax. Outputs: status, labelLen.
    """

    def act(self, volumes: Volumes) -> None:
        """Store it."""
        volumes.path(self.pDevice, 0, is_optional=True)
        label = volumes.text(self.pDevice, fiERR_FILE_DEVICE)
        if not self.pLabel:
            raise FileRefusedError(fiERR_DATA)
        if self.labelMax <= len(label):
            raise FileRefusedError(fiERR_DATA_SIZE)
        self.context.memory.write(self.pLabel, label + b"\0")
        self.labelLen = len(label)


class GetVolumeSerialNo(interface.GetVolumeSerialNo, FileIoBlock):
    """The number of a device's volume: folders have none, so it is 0."""

    def act(self, volumes: Volumes) -> None:
        """Tell it."""
        volumes.path(self.pDevice, 0, is_optional=True)
        self.serialNo = 0


@function("FileIoGetSysError")
def last_error(context: Context) -> int:
    """Return the number of the host's last error (errno), 0 where there was none."""
    return context.library(Volumes).last_error
