"""Files by name."""

import struct

import pytest

from plcsim.library.fileio import (
    fiATTR_DIRECTORY,
    fiATTR_RDONLY,
    fiERR_ACCESS,
    fiERR_DATA,
    fiERR_EXIST,
    fiERR_FILE_NOT_FOUND,
    fiERR_SEEK,
    fiFILE_INFO,
    fiOVERWRITE,
)
from plcsim.library.fileio.files import (
    FileCopy,
    FileDelete,
    FileInfo,
    FileRename,
    FileTruncate,
    GetAttributes,
    SetAttributes,
)
from plcsim.library.runtime import ERR_OK

NEW_YEAR_2000 = 946_684_800


@pytest.fixture
def text(user):
    path = user / "a.txt"
    path.write_text("abcdef")
    return path


def test_rename(files, user, text):
    rename = files.do(FileRename, pDevice="USER", pName="a.txt", pNewName="b.txt")
    assert rename.status == ERR_OK
    assert [file.name for file in user.iterdir()] == ["b.txt"]
    text.write_text("other")
    again = files.do(FileRename, pDevice="USER", pName="a.txt", pNewName="b.txt")
    assert again.status == fiERR_EXIST
    missing = files.do(FileRename, pDevice="USER", pName="x", pNewName="y")
    assert missing.status == fiERR_FILE_NOT_FOUND


def copy(files, source, target, option=0, device="F:"):
    return files.do(
        FileCopy, pSrcDev="USER", pSrc=source, pDestDev=device, pDest=target, option=option
    ).status


def test_copy_to_another_device(files, user, text):
    stick = user.parent / "stick"
    assert copy(files, "a.txt", "copy.txt") == ERR_OK
    assert (stick / "copy.txt").read_text() == "abcdef"
    assert (stick / "copy.txt").stat().st_mtime == NEW_YEAR_2000
    text.write_text("new")
    assert copy(files, "a.txt", "copy.txt") == fiERR_EXIST
    assert (stick / "copy.txt").read_text() == "abcdef"
    assert copy(files, "a.txt", "copy.txt", fiOVERWRITE) == ERR_OK
    assert (stick / "copy.txt").read_text() == "new"


def test_a_copy_onto_itself_changes_nothing(files, text):
    assert copy(files, "a.txt", "a.txt", fiOVERWRITE, "USER") == ERR_OK
    assert text.read_text() == "abcdef"


def test_a_directory_is_not_copied_or_deleted_as_a_file(files, user, text):
    (user / "folder").mkdir()
    assert copy(files, "folder", "x") == fiERR_ACCESS
    assert copy(files, "a.txt", "folder", fiOVERWRITE, "USER") == fiERR_ACCESS
    assert files.do(FileDelete, pDevice="USER", pName="folder").status == fiERR_ACCESS


def test_delete(files, user, text):
    assert files.do(FileDelete, pDevice="USER", pName="A.txt").status == ERR_OK
    assert not text.exists()
    assert files.do(FileDelete, pDevice="USER", pName="a.txt").status == fiERR_FILE_NOT_FOUND


def test_info(files, text):
    address = files.bytes(bytes(fiFILE_INFO._plc_type.size))
    found = files.do(FileInfo, pDevice="USER", pName="a.txt", pInfo=address)
    assert found.status == ERR_OK
    size, links, _, modified, changed = struct.unpack("<5I", files.memory.read(address, 20))
    assert (size, links, modified) == (6, 1, int(text.stat().st_mtime))
    assert changed == modified
    assert files.do(FileInfo, pDevice="USER", pName="a.txt").status == fiERR_DATA
    missing = files.do(FileInfo, pDevice="USER", pName="x", pInfo=address)
    assert missing.status == fiERR_FILE_NOT_FOUND


def test_truncate(files, text):
    cut = files.do(FileTruncate, pDevice="USER", pName="a.txt", newLength=2)
    assert cut.status == ERR_OK
    assert text.read_text() == "ab"
    longer = files.do(FileTruncate, pDevice="USER", pName="a.txt", newLength=3)
    assert longer.status == fiERR_SEEK
    assert text.read_text() == "ab"


def test_a_fixed_file_is_kept(files, user, text):
    def set_(attributes):
        block = files.do(SetAttributes, pDevice="USER", pPath="a.txt", attributes=attributes)
        assert block.status == ERR_OK
        return files.do(GetAttributes, pDevice="USER", pPath="a.txt").attributes

    assert set_(fiATTR_RDONLY) == fiATTR_RDONLY
    assert files.do(FileDelete, pDevice="USER", pName="a.txt").status == fiERR_ACCESS
    assert set_(0) == 0
    assert files.do(FileDelete, pDevice="USER", pName="a.txt").status == ERR_OK
    folder = files.do(GetAttributes, pDevice="USER")
    assert (folder.status, folder.attributes) == (ERR_OK, fiATTR_DIRECTORY)
