"""MpFileManagerUI of mapp File: the files on the devices of FileIO at UIConnect.

Commands count at their edges and are done in that call, without asking: no message box opens. The
list is read when a command was done, or at Refresh; neither filtered nor sorted but by name, and
single steps through it do nothing.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from plcsim.library.block import StatusError
from plcsim.library.fileio.volumes import Volumes
from plcsim.library.mapp.block import MappBlock
from plcsim.library.mapp.errors import FILE_WITHOUT_UICONNECT
from plcsim.library.mapp.file_view import FileView
from plcsim.library.members import BlockVariables, ReferredStructure, StructMembers, rises
from st_types.types.derived import StructType

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.fileio.volumes import DirectoryEntry
    from plcsim.library.members import FindType

ITEMS: Final = "File.List.Items"

FOLDER: Final = 1
FILE: Final = 2
_TYPES: Final = {".txt": 3, ".html": 4, ".doc": 5, ".xls": 6, ".xml": 7, ".csv": 8} | {
    ".jpg": 9,
    ".bmp": 10,
}
"""MpFileManagerUIItemTypeEnum."""

_COMMANDS: Final = {
    "File.EnterFolder": "CHANGE_DIR",
    "File.FolderUp": "CHANGE_DIR",
    "File.Refresh": "REFRESH",
    "File.CreateFolder": "CREATE",
    "File.Rename": "RENAME",
    "File.Delete": "DELETE",
    "File.Copy": "COPY",
    "File.Cut": "CUT",
    "File.Paste": "PASTE",
    "File.List.PageUp": "CHANGE_PAGE",
    "File.List.PageDown": "CHANGE_PAGE",
}
"""Commands at UIConnect, and Status for the call that does them."""


class _Screen:
    """What one UIConnect shows.

    Attributes:
        view: the folder.
        first: index of the first entry that is shown.
        status: of the last command.
    """

    def __init__(self, view: FileView) -> None:
        self.view = view
        self.first = 0
        self.status = 0

    def turn(self, command: str, size: int) -> None:
        """Show another page; a command that is none of those shows the first."""
        match command.rpartition(".")[2]:
            case "PageUp":
                self.first = max(self.first - size, 0)
            case "PageDown" if self.first + size < len(self.view.entries):
                self.first += size
            case "PageDown":
                pass
            case _:
                self.first = 0


class _Screens:
    """What is shown, by the address of the UIConnect; a restart forgets it."""

    def __init__(self, _context: Context) -> None:
        self.by_address: dict[int, _Screen] = {}


class FileManagerUI(MappBlock):
    """MpFileManagerUI."""

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._connect = ReferredStructure(data_type, "UIConnect")
        item = find_type("MpFileManagerUIItemType")
        self._item = item if isinstance(item, StructType) else None
        self._item_members = None if self._item is None else StructMembers(self._item)

    def seen(self, variables: BlockVariables, _link: int) -> tuple[object, ...]:
        """Return what the operator does, and the operation shown."""
        connect = self._connect.of(self.context.memory, variables)
        asked = (*_COMMANDS, "DeviceList.SelectedIndex", "Status")
        return () if connect is None else (connect.start, *map(connect.number, asked))

    def call(self, _address: int, variables: BlockVariables, _link: int) -> None:
        """Take what the operator asks for, and show the folder."""
        connect = self._connect.of(self.context.memory, variables)
        if connect is None:
            variables.set(Error=True, StatusID=FILE_WITHOUT_UICONNECT)
            return
        size = int(variables.number("UISetup.FileListSize")) or connect.count_of(ITEMS)
        size = min(size, connect.count_of(ITEMS))
        screens = self.context.library(_Screens).by_address
        edges = [name for name in _COMMANDS if rises(self.context, connect.start, connect, name)]
        index = int(connect.number("DeviceList.SelectedIndex"))
        screen = screens.get(connect.start)
        is_other = screen is None or screen.view.device != index
        if screen is None:
            volumes = self.context.library(Volumes)
            screen = screens[connect.start] = _Screen(FileView(volumes))
            for place, name in enumerate(volumes.device_names):
                connect.set_element("DeviceList.DeviceNames", place, os.fsdecode(name))
        if is_other:
            screen.view.change_device(index)
        if is_other or edges:
            self._obey(edges[0] if edges else "", screen, connect, size)
        done = "ERROR" if screen.status else _COMMANDS[edges[0]] if edges else "IDLE"
        connect.set_enumeration("Status", f"STATUS_{done}")
        variables.set(Error=screen.status != 0, StatusID=screen.status)

    def _obey(self, command: str, screen: _Screen, connect: BlockVariables, size: int) -> None:
        """Do a command, and show what is there then."""
        view, shown = screen.view, screen.view.entries[screen.first : screen.first + size]
        selected = [each for index, each in enumerate(shown) if self._is_selected(connect, index)]
        screen.status = 0
        try:
            _do(command, view, selected, connect.own_text("File.NewName"))
            view.refresh()
        except StatusError as refused:
            screen.status = refused.status
        screen.turn(command, size)
        self._show(screen, connect, size)

    def _show(self, screen: _Screen, connect: BlockVariables, size: int) -> None:
        view = screen.view
        shown = view.entries[screen.first : screen.first + size]
        for index in range(size):
            self._set_item(connect, index, shown[index] if index < len(shown) else None)
        folders = sum(each.is_directory for each in view.entries)
        connect.set(
            File__PathInfo__CurrentDir=view.directory,
            File__PathInfo__FolderCount=folders,
            File__PathInfo__FileCount=len(view.entries) - folders,
        )

    def _item_at(self, connect: BlockVariables, index: int) -> BlockVariables | None:
        address = connect.element_address(ITEMS, index)
        if not address or self._item_members is None:
            return None
        return BlockVariables(self.context.memory, self._item_members, address)

    def _is_selected(self, connect: BlockVariables, index: int) -> bool:
        item = self._item_at(connect, index)
        return item is not None and item.is_true("IsSelected")

    def _set_item(self, connect: BlockVariables, index: int, entry: DirectoryEntry | None) -> None:
        item = self._item_at(connect, index)
        if item is None:
            return
        item.set(
            Name="" if entry is None else os.fsdecode(entry.name),
            Size=0 if entry is None else entry.size,
            LastModified=0 if entry is None else entry.date,
            ItemType=0 if entry is None else _type_of(entry),
            IsSelected=False,
            IsFolder=entry is not None and entry.is_directory,
        )


def _type_of(entry: DirectoryEntry) -> int:
    suffix = Path(os.fsdecode(entry.name)).suffix.lower()
    return FOLDER if entry.is_directory else _TYPES.get(suffix, FILE)


def _do(command: str, view: FileView, selected: list[DirectoryEntry], name: str) -> None:
    """Do a command.

    Raises:
        StatusError: it cannot be done.
    """
    match command.rpartition(".")[2]:
        case "EnterFolder":
            view.enter(selected)
        case "FolderUp":
            view.leave()
        case "CreateFolder":
            view.create_folder(name)
        case "Rename":
            view.rename(selected, name)
        case "Delete":
            view.delete(selected)
        case "Copy" | "Cut" as taken:
            view.take(selected, is_cut=taken == "Cut")
        case "Paste":
            view.paste()


BLOCKS: Final[Mapping[str, type[MappBlock]]] = {"MpFileManagerUI": FileManagerUI}
"""What runs the blocks by their names."""
