"""MpFileManagerUI: an operator who looks at files."""

import os

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.fileio.settings import FileIoSettings
from plcsim.library.mapp.errors import (
    DIR_ALREADY_EXISTS,
    FILE_SYSTEM,
    FILE_WITHOUT_UICONNECT,
    INVALID_FILE_DEVICE,
    INVALID_NAME,
    NAME_EMPTY,
    NOTHING_SELECTED,
    NOTHING_TO_PASTE,
    PASTE_NOT_ALLOWED,
)
from plcsim.library.mapp.file_blocks import BLOCKS
from plcsim.library.members import BlockVariables, StructMembers
from st_types import BOOL, DATE_AND_TIME, DINT, UDINT, UINT
from st_types.types.derived import (
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StringType,
    StructType,
)

ITEM = StructType(
    "MpFileManagerUIItemType",
    [
        Member("Name", StringType(255)),
        Member("Size", UDINT),
        Member("LastModified", DATE_AND_TIME),
        Member("ItemType", UINT),
        Member("IsSelected", BOOL),
        Member("IsFolder", BOOL),
    ],
)
STATUSES = "IDLE REFRESH CHANGE_PAGE CHANGE_DIR CHANGE_DEVICE CREATE RENAME DELETE COPY CUT PASTE"
STATUS = EnumerationType(
    "MpFileManagerUIStatusEnum",
    {
        **{f"mpFILE_UI_STATUS_{name}": number for number, name in enumerate(STATUSES.split())},
        "mpFILE_UI_STATUS_ERROR": 99,
    },
)
PAGE = StructType(
    "MpFileManagerUIFileListType",
    [Member("Items", ArrayType(ITEM, [(0, 4)])), Member("PageUp", BOOL), Member("PageDown", BOOL)],
)
INFO = StructType(
    "MpFileManagerUIPathInfoType",
    [
        Member("CurrentDir", StringType(255)),
        Member("FileCount", UDINT),
        Member("FolderCount", UDINT),
    ],
)
BUTTONS = (
    "Refresh",
    "EnterFolder",
    "FolderUp",
    "Delete",
    "Copy",
    "Cut",
    "Paste",
    "Rename",
    "CreateFolder",
)
FILES = StructType(
    "MpFileManagerUIFileType",
    [
        Member("List", PAGE),
        Member("PathInfo", INFO),
        Member("NewName", StringType(255)),
        *(Member(name, BOOL) for name in BUTTONS),
    ],
)
DEVICES = StructType(
    "MpFileManagerUIDeviceListType",
    [Member("DeviceNames", ArrayType(StringType(50), [(0, 2)])), Member("SelectedIndex", UINT)],
)
CONNECT = StructType(
    "MpFileManagerUIConnectType",
    [Member("Status", STATUS), Member("DeviceList", DEVICES), Member("File", FILES)],
)
SETUP = StructType("MpFileManagerUISetupType", [Member("FileListSize", UINT)])
BLOCK = DataBlockType(
    "MpFileManagerUI",
    [
        Member("MpLink", UDINT, section=Section.INPUT),
        Member("Enable", BOOL, section=Section.INPUT),
        Member("UISetup", SETUP, section=Section.INPUT),
        Member("UIConnect", ReferenceType(CONNECT), section=Section.INPUT),
        Member("Active", BOOL, section=Section.OUTPUT),
        Member("Error", BOOL, section=Section.OUTPUT),
        Member("StatusID", DINT, section=Section.OUTPUT),
    ],
)


class Operator:
    """Somebody at the screen of a block."""

    def __init__(self, devices):
        self.memory = Memory()
        context = Context(self.memory, None, [FileIoSettings(devices=devices)])
        self.block = self._structure(BLOCK)
        self.screen = self._structure(CONNECT)
        self._run = BLOCKS["MpFileManagerUI"](BLOCK, context, {ITEM.name: ITEM}.get).run
        self.call(MpLink=1, Enable=True, UIConnect=self.screen.start)

    def _structure(self, kind):
        return BlockVariables(self.memory, StructMembers(kind), self.memory.allocate(kind.size))

    def call(self, **inputs):
        self.block.set(**inputs)
        self._run(self.block.start)
        return self.block.number("StatusID")

    def press(self, button, *, name=""):
        """Press a button of the files; the status."""
        self.screen.set(**{f"File__{button}": True, "File__NewName": name})
        status = self.call()
        self.shown = self.screen.enumerator("Status").removeprefix("mpFILE_UI_STATUS_")
        self.screen.set(**{f"File__{button}": False})
        self.call()
        return status

    def item(self, index):
        at = self.screen.element_address("File.List.Items", index)
        return BlockVariables(self.memory, StructMembers(ITEM), at)

    def select(self, *names):
        for index in range(5):
            self.item(index).set(IsSelected=self.item(index).own_text("Name") in names)

    @property
    def names(self):
        found = (self.item(index).own_text("Name") for index in range(5))
        return [name for name in found if name]

    @property
    def directory(self):
        return self.screen.own_text("File.PathInfo.CurrentDir")


@pytest.fixture
def folders(tmp_path):
    for name in ("user/recipes/old", "stick"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "user" / "a.csv").write_text("1;2")
    (tmp_path / "user" / "b.BMP").write_text("")
    (tmp_path / "user" / "recipes" / "one").write_text("1")
    os.utime(tmp_path / "user" / "a.csv", (1_000, 1_000))
    return tmp_path


@pytest.fixture
def operator(folders):
    return Operator({"USER": folders / "user", "F:": folders / "stick"})


def test_the_first_device_is_shown_with_folders_first(operator):
    texts = [operator.screen.element_address("DeviceList.DeviceNames", n) for n in range(3)]
    assert [operator.memory.string(at, 50) for at in texts] == [b"USER", b"F:", b""]
    assert operator.names == ["recipes", "a.csv", "b.BMP"]
    kinds = [operator.item(index).number("ItemType") for index in range(4)]
    assert kinds == [1, 8, 10, 0]
    assert [operator.item(1).number(each) for each in ("Size", "LastModified")] == [3, 1_000]
    counts = ("File.PathInfo.FolderCount", "File.PathInfo.FileCount")
    assert [operator.screen.number(each) for each in counts] == [1, 2]
    assert operator.screen.enumerator("Status") == "mpFILE_UI_STATUS_IDLE"


def test_he_goes_through_folders_and_devices(operator):
    assert operator.press("EnterFolder") == NOTHING_SELECTED
    assert operator.shown == "ERROR"
    operator.select("a.csv")
    assert operator.press("EnterFolder") == NOTHING_SELECTED
    operator.select("recipes")
    assert operator.press("EnterFolder") == 0
    assert (operator.directory, operator.names, operator.shown) == (
        "recipes",
        ["old", "one"],
        "CHANGE_DIR",
    )
    assert operator.press("FolderUp") == 0
    assert operator.press("FolderUp") == 0
    assert (operator.directory, operator.names[0]) == ("", "recipes")
    operator.screen.set(DeviceList__SelectedIndex=1)
    assert (operator.call(), operator.names) == (0, [])
    operator.screen.set(DeviceList__SelectedIndex=2)
    assert (operator.call(), operator.names) == (INVALID_FILE_DEVICE, [])


def test_what_he_selects_stays_until_a_command_and_files_come_at_refresh(operator, folders):
    operator.select("a.csv")
    (folders / "user" / "c.txt").write_text("")
    operator.call()
    assert operator.item(1).is_true("IsSelected")
    assert "c.txt" not in operator.names
    operator.press("Refresh")
    assert "c.txt" in operator.names
    assert not operator.item(1).is_true("IsSelected")


def test_he_makes_renames_and_deletes(operator, folders):
    assert operator.press("CreateFolder", name="new") == 0
    assert operator.press("CreateFolder", name="new") == DIR_ALREADY_EXISTS
    operator.select("new")
    assert operator.press("Rename", name="a.csv") == INVALID_NAME
    operator.select("new")
    assert operator.press("Rename", name="newer") == 0
    assert operator.names == ["newer", "recipes", "a.csv", "b.BMP"]
    operator.select("recipes", "a.csv")
    assert operator.press("Delete") == 0
    assert (operator.names, operator.shown) == (["newer", "b.BMP"], "DELETE")
    assert sorted(each.name for each in (folders / "user").iterdir()) == ["b.BMP", "newer"]


@pytest.mark.parametrize(
    ("name", "status"), [("", NAME_EMPTY), ("..", INVALID_NAME), ("a/b", INVALID_NAME)]
)
def test_names_that_are_none(operator, name, status):
    assert operator.press("CreateFolder", name=name) == status
    operator.select("a.csv")
    assert operator.press("Rename", name=name) == status


def test_a_name_that_is_too_long_for_the_host(operator):
    operator.select("a.csv")
    assert operator.press("Rename", name="\xe4" * 200) == FILE_SYSTEM
    assert operator.press("CreateFolder", name="\xe4" * 200) == FILE_SYSTEM
    assert operator.names == ["recipes", "a.csv", "b.BMP"]


def test_he_copies_and_moves_to_another_device(operator, folders):
    assert operator.press("Paste") == NOTHING_TO_PASTE
    operator.select("recipes", "a.csv")
    assert operator.press("Copy") == 0
    operator.screen.set(DeviceList__SelectedIndex=1)
    operator.call()
    assert operator.press("Paste") == 0
    assert operator.names == ["recipes", "a.csv"]
    assert (folders / "stick" / "recipes" / "one").read_text() == "1"
    assert operator.press("Paste") == DIR_ALREADY_EXISTS
    operator.select("a.csv")
    operator.press("Cut")
    operator.select("recipes")
    operator.press("EnterFolder")
    assert operator.press("Paste") == 0
    assert operator.names == ["old", "a.csv", "one"]
    assert not (folders / "stick" / "a.csv").exists()
    assert operator.press("Paste") == NOTHING_TO_PASTE


def test_a_folder_is_not_put_into_itself(operator):
    operator.select("recipes")
    operator.press("Copy")
    operator.select("recipes")
    operator.press("EnterFolder")
    assert operator.press("Paste") == PASTE_NOT_ALLOWED


def test_pages(operator):
    operator.call(UISetup__FileListSize=2)
    operator.press("Refresh")
    for index in range(2, 5):
        operator.item(index).set(Name="")
    assert operator.names == ["recipes", "a.csv"]
    operator.press("List__PageDown")
    assert operator.names == ["b.BMP"]
    operator.press("List__PageDown")
    assert operator.names == ["b.BMP"]
    operator.press("List__PageUp")
    assert operator.names == ["recipes", "a.csv"]


def test_a_folder_that_is_gone_and_a_link_that_leads_out(operator, folders):
    (folders / "user" / "out").symlink_to("/")
    operator.press("Refresh")
    operator.select("out")
    assert operator.press("Delete") == FILE_SYSTEM
    operator.select("recipes")
    operator.press("EnterFolder")
    (folders / "user" / "recipes" / "one").unlink()
    operator.select("one")
    assert operator.press("Delete") == FILE_SYSTEM


def test_without_a_screen_he_sees_nothing(operator):
    assert operator.call(UIConnect=0) == FILE_WITHOUT_UICONNECT
    assert operator.block.is_true("Error")
