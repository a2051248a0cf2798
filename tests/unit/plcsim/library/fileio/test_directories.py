"""Directories."""

import struct

import pytest

from plcsim.library.fileio import (
    fiBOTH,
    fiDIR_READ_DATA,
    fiDIR_READ_EX_DATA,
    fiDIRECTORY,
    fiERR_ACCESS,
    fiERR_DATA,
    fiERR_DATA_SIZE,
    fiERR_DIR_ALREADY_EXIST,
    fiERR_DIR_INVALID_HANDLE,
    fiERR_DIR_NOT_EMPTY,
    fiERR_DIR_NOT_EXIST,
    fiERR_INVALID_DIRECTORY,
    fiERR_INVALID_TYP,
    fiERR_NO_MORE_ENTRIES,
    fiFILE,
    fiOVERWRITE,
)
from plcsim.library.fileio.directories import (
    DirClose,
    DirCopy,
    DirCreate,
    DirDelete,
    DirDeleteEx,
    DirInfo,
    DirOpen,
    DirRead,
    DirReadEx,
    DirRename,
)
from plcsim.library.runtime import ERR_OK

NEW_YEAR_2000 = 946_684_800
SIZE, EX_SIZE = (view._plc_type.size for view in (fiDIR_READ_DATA, fiDIR_READ_EX_DATA))


@pytest.fixture
def tree(user):
    """logs (with old.txt in it), recipes, a.txt, b.txt."""
    (user / "logs").mkdir()
    (user / "logs" / "old.txt").write_text("old")
    (user / "recipes").mkdir()
    (user / "a.txt").write_text("a")
    (user / "b.txt").write_text("bb")
    return user


def name_at(files, address):
    return files.string(address)


def test_create(files, user):
    assert files.do(DirCreate, pDevice="USER", pName="logs").status == ERR_OK
    assert (user / "logs").is_dir()
    assert (user / "logs").stat().st_mtime == NEW_YEAR_2000
    again = files.do(DirCreate, pDevice="USER", pName="logs")
    assert again.status == fiERR_DIR_ALREADY_EXIST
    deep = files.do(DirCreate, pDevice="USER", pName="x/y")
    assert deep.status == fiERR_DIR_NOT_EXIST


def test_count(files, tree):
    found = files.do(DirInfo, pDevice="USER")
    assert (found.status, found.dirnum, found.filenum) == (ERR_OK, 2, 2)
    inner = files.do(DirInfo, pDevice="USER", pPath="logs")
    assert (inner.dirnum, inner.filenum) == (0, 1)
    assert files.do(DirInfo, pDevice="USER", pPath="x").status == fiERR_DIR_NOT_EXIST
    assert files.do(DirInfo, pDevice="USER", pPath="a.txt").status == fiERR_DIR_NOT_EXIST


@pytest.mark.parametrize(
    ("option", "names"),
    [
        (fiFILE, ["a.txt", "b.txt"]),
        (fiDIRECTORY, ["logs", "recipes"]),
        (fiBOTH, ["a.txt", "b.txt", "logs", "recipes"]),
    ],
)
def test_entries_by_number(files, tree, option, names):
    address = files.bytes(bytes(SIZE))
    found = []
    for number in range(len(names) + 1):
        block = files.do(
            DirRead, pDevice="USER", entry=number, option=option, pData=address, data_len=SIZE
        )
        if block.status == ERR_OK:
            found.append(name_at(files, address))
    assert found == names
    assert block.status == fiERR_NO_MORE_ENTRIES


def test_size_and_date_of_an_entry(files, tree):
    address = files.bytes(bytes(SIZE))
    files.do(DirRead, pDevice="USER", entry=1, pData=address, data_len=SIZE)
    date, size = struct.unpack("<II", files.memory.read(address + 260, 8))
    assert (date, size) == (int((tree / "b.txt").stat().st_mtime), 2)


def test_wrong_reads(files, tree):
    address = files.bytes(bytes(SIZE))
    given = {"pDevice": "USER", "pData": address, "data_len": SIZE}
    assert files.do(DirRead, **given | {"data_len": SIZE - 1}).status == fiERR_DATA_SIZE
    assert files.do(DirRead, **given | {"pData": 0}).status == fiERR_DATA
    assert files.do(DirRead, **given | {"option": 3}).status == fiERR_INVALID_TYP
    assert files.do(DirRead, **given | {"pPath": "x"}).status == fiERR_DIR_NOT_EXIST


def test_reading_one_after_the_other(files, tree):
    ident = files.do(DirOpen, pDevice="USER").ident
    address = files.bytes(bytes(EX_SIZE))
    given = {"ident": ident, "pData": address, "data_len": EX_SIZE}
    found = []
    while (block := files.do(DirReadEx, **given)).status == ERR_OK:
        mode = int.from_bytes(files.memory.read(address + 268, 2), "little")
        found.append((name_at(files, address), mode))
    assert block.status == fiERR_NO_MORE_ENTRIES
    assert found == [("a.txt", 0), ("b.txt", 0), ("logs", 1), ("recipes", 1)]
    assert files.do(DirReadEx, **given | {"data_len": SIZE}).status == fiERR_DATA_SIZE
    assert files.do(DirReadEx, **given | {"pData": 0}).status == fiERR_DATA
    assert files.do(DirClose, ident=ident).status == ERR_OK
    assert files.do(DirClose, ident=ident).status == fiERR_DIR_INVALID_HANDLE
    assert files.do(DirReadEx, **given).status == fiERR_DIR_INVALID_HANDLE
    assert files.do(DirOpen, pDevice="USER", pName="x").status == fiERR_DIR_NOT_EXIST


def test_rename(files, tree):
    assert files.do(DirRename, pDevice="USER", pName="logs", pNewName="old").status == ERR_OK
    assert (tree / "old" / "old.txt").exists()
    taken = files.do(DirRename, pDevice="USER", pName="old", pNewName="recipes")
    assert taken.status == fiERR_DIR_ALREADY_EXIST
    missing = files.do(DirRename, pDevice="USER", pName="x", pNewName="y")
    assert missing.status == fiERR_DIR_NOT_EXIST
    no_directory = files.do(DirRename, pDevice="USER", pName="a.txt", pNewName="y")
    assert no_directory.status == fiERR_INVALID_DIRECTORY


def copy(files, source, target, option=0, device="F:"):
    return files.do(
        DirCopy, pSrcDev="USER", pSrcDir=source, pDestDev=device, pDestDir=target, option=option
    ).status


def test_copy(files, tree):
    stick = tree.parent / "stick"
    assert copy(files, "logs", "backup") == ERR_OK
    assert (stick / "backup" / "old.txt").read_text() == "old"
    assert copy(files, "logs", "backup") == fiERR_DIR_ALREADY_EXIST
    (tree / "logs" / "new.txt").write_text("new")
    assert copy(files, "logs", "backup", fiOVERWRITE) == ERR_OK
    assert (stick / "backup" / "new.txt").exists()
    assert copy(files, "x", "other") == fiERR_DIR_NOT_EXIST


def test_a_directory_is_not_copied_into_itself(files, tree):
    assert copy(files, "logs", "logs/inner", device="USER") == fiERR_INVALID_DIRECTORY
    assert copy(files, "logs", "logs", fiOVERWRITE, "USER") == fiERR_INVALID_DIRECTORY


def test_delete(files, tree):
    assert files.do(DirDelete, pDevice="USER", pName="recipes").status == ERR_OK
    assert not (tree / "recipes").exists()
    assert files.do(DirDelete, pDevice="USER", pName="logs").status == fiERR_DIR_NOT_EMPTY
    assert files.do(DirDelete, pDevice="USER", pName="x").status == fiERR_DIR_NOT_EXIST
    assert files.do(DirDeleteEx, pDevice="USER", pName="logs").status == ERR_OK
    assert not (tree / "logs").exists()


@pytest.mark.parametrize("view", [DirDelete, DirDeleteEx])
@pytest.mark.parametrize("name", ["", ".", "/", "logs/.."])
def test_a_device_is_not_deleted(files, tree, view, name):
    assert files.do(view, pDevice="USER", pName=name).status == fiERR_ACCESS
    assert (tree / "a.txt").exists()


def test_what_a_link_leads_to_is_not_deleted(files, tree):
    outside = tree.parent / "outside"
    outside.mkdir()
    (outside / "precious.txt").write_text("!")
    (tree / "logs" / "link").symlink_to(outside)
    assert files.do(DirDeleteEx, pDevice="USER", pName="logs").status == ERR_OK
    assert (outside / "precious.txt").exists()
