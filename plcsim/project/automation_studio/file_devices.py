r"""The file devices that Hardware.hw names, as folders beside the project.

A program shall neither read nor write what else lies on the host: each path of the controller
(``F:\Recipes``, ``USER_PATH``) stands for a folder inside one that belongs to the simulation.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

FOLDER: Final = "file_devices"
"""Name of the folder beside the project."""

DRIVES: Final = ("C:", "D:", "E:", "F:", "USER_PATH")
"""What ``/DEVICE=`` of DevLink may begin with; USER_PATH is the partition of the user."""

_STRANGE = re.compile(r"[^\w.\- ]")


def file_devices(named: Mapping[str, str], folder: Path) -> dict[str, Path]:
    """Return the folder of each device; none of them is made.

    Args:
        named: paths on the controller by the names of devices.
        folder: of the project.
    """
    paths = {**{drive: drive for drive in DRIVES}, **named}
    return {name: _inside(folder / FOLDER, path or name) for name, path in paths.items() if name}


def _inside(folder: Path, path: str) -> Path:
    parts = [_STRANGE.sub("", part).strip(" .") for part in re.split(r"[/\\]+", path)]
    return folder.joinpath(*(part for part in parts if part))
