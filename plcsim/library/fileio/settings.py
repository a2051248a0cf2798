"""Table [library.FileIO] of plc.toml: the devices, and where each lies."""

from __future__ import annotations

from collections.abc import Mapping  # read at run time
from dataclasses import dataclass, field
from pathlib import Path  # likewise
from typing import Annotated

from plcsim.settings import PathTo, settings


@settings
class FileIoSettings:
    """Settings of the library.

    Attributes:
        devices: folders by the names of devices, or of what ``/DEVICE=`` of DevLink names, such as
            ``"F:"``; a relative path begins at the project's folder. Nothing outside of these
            folders is ever read or written.
    """

    devices: Mapping[str, Annotated[Path, PathTo("folder")]] = field(default_factory=dict)


@dataclass(frozen=True)
class MadeDevices:
    """Devices that nobody names in plc.toml; their folders are made when a program uses them.

    Attributes:
        folders: by the names of devices.
    """

    folders: Mapping[str, Path]
