"""Open files: what is written is read again, and nothing else is touched."""

import os

import pytest

from plcsim.core.errors import PageFault
from plcsim.library.fileio import (
    fiERR_ACCESS,
    fiERR_DATA,
    fiERR_EXIST,
    fiERR_FILE_NOT_FOUND,
    fiERR_FILE_NOT_OPENED,
    fiERR_MODE,
    fiERR_NO_MORE_ENTRIES,
    fiERR_SEEK,
    fiREAD_ONLY,
    fiREAD_WRITE,
    fiTruncate,
    fiWRITE_ONLY,
)
from plcsim.library.fileio.transfer import (
    FileClose,
    FileCreate,
    FileOpen,
    FileRead,
    FileReadEx,
    FileWrite,
    FileWriteEx,
)
from plcsim.library.runtime import ERR_OK

NEW_YEAR_2000 = 946_684_800


def opened(files, name="a.txt", mode=fiREAD_WRITE):
    return files.do(FileOpen, pDevice="USER", pFile=name, mode=mode)


def test_create_write_read_close(files, user):
    made = files.do(FileCreate, pDevice="USER", pFile="a.txt")
    assert made.status == ERR_OK
    source = files.bytes(b"hello world")
    assert files.do(FileWrite, ident=made.ident, pSrc=source, len=11).status == ERR_OK
    target = files.bytes(b"#" * 20)
    read = files.do(FileRead, ident=made.ident, offset=6, pDest=target, len=5)
    assert read.status == ERR_OK
    assert files.memory.read(target, 6) == b"world#"
    assert files.do(FileClose, ident=made.ident).status == ERR_OK
    assert files.do(FileClose, ident=made.ident).status == fiERR_FILE_NOT_OPENED
    assert (user / "a.txt").read_text() == "hello world"


def test_a_file_that_is_there_is_not_created(files, user):
    (user / "a.txt").write_text("old")
    made = files.do(FileCreate, pDevice="USER", pFile="A.TXT")
    assert (made.status, made.ident) == (fiERR_EXIST, 0)
    assert (user / "a.txt").read_text() == "old"


def test_open_tells_the_length(files, user):
    (user / "a.txt").write_bytes(b"x" * 1234)
    found = opened(files)
    assert (found.status, found.filelen) == (ERR_OK, 1234)
    assert opened(files, "b.txt").status == fiERR_FILE_NOT_FOUND
    assert opened(files, mode=3).status == fiERR_MODE


def test_modes(files, user):
    (user / "a.txt").write_text("abc")
    buffer = files.bytes(bytes(8))
    reading, writing = opened(files, mode=fiREAD_ONLY), opened(files, mode=fiWRITE_ONLY)
    for ident, read, write in (
        (reading.ident, ERR_OK, fiERR_ACCESS),
        (writing.ident, fiERR_ACCESS, ERR_OK),
    ):
        assert files.do(FileRead, ident=ident, pDest=buffer, len=1).status == read
        assert files.do(FileWrite, ident=ident, pSrc=buffer, len=1).status == write


def test_reading_stops_at_the_end(files, user):
    (user / "a.txt").write_text("abcdef")
    ident, target = opened(files).ident, files.bytes(b"#" * 20)
    found = files.do(FileReadEx, ident=ident, offset=4, pDest=target, len=20)
    assert (found.status, found.bytesread) == (ERR_OK, 2)
    assert files.memory.read(target, 3) == b"ef#"
    end = files.do(FileReadEx, ident=ident, offset=6, pDest=target, len=20)
    assert (end.status, end.bytesread) == (ERR_OK, 0)
    beyond = files.do(FileReadEx, ident=ident, offset=7, pDest=target, len=1)
    assert (beyond.status, beyond.bytesread) == (fiERR_SEEK, 0)


def test_a_file_ends_behind_what_is_written_where_that_is_wanted(files, user):
    (user / "a.txt").write_text("abcdef")
    ident, source = opened(files).ident, files.bytes(b"XY")
    files.do(FileWriteEx, ident=ident, offset=1, pSrc=source, len=2)
    assert (user / "a.txt").read_text() == "aXYdef"
    files.do(FileWriteEx, ident=ident, offset=2, pSrc=source, len=2, option=fiTruncate)
    assert (user / "a.txt").read_text() == "aXXY"


def test_changed_files_have_the_date_of_the_controller(files, user):
    made = files.do(FileCreate, pDevice="USER", pFile="a.txt")
    assert (user / "a.txt").stat().st_mtime == NEW_YEAR_2000
    files.pass_ms(90_000)
    files.do(FileWrite, ident=made.ident, pSrc=files.bytes(b"x"), len=1)
    assert (user / "a.txt").stat().st_mtime == NEW_YEAR_2000 + 90


@pytest.mark.parametrize("view", [FileRead, FileReadEx, FileWrite, FileWriteEx])
def test_wrong_idents_and_pointers(files, user, view):
    (user / "a.txt").write_text("abc")
    ident = opened(files).ident
    assert files.do(view, ident=77, len=1).status == fiERR_FILE_NOT_OPENED
    assert files.do(view, ident=ident, len=1).status == fiERR_DATA
    name = "pSrc" if "Write" in view.__name__ else "pDest"
    block = files.call(view, ident=ident, len=1, **{name: 0x7000_0000})
    with pytest.raises(PageFault):
        block()
    assert (user / "a.txt").read_text() == "abc"


def test_no_file_is_larger_than_its_length_can_tell(files, user):
    (user / "a.txt").write_text("abc")
    ident, source = opened(files).ident, files.bytes(b"x" * 10)
    found = files.do(FileWrite, ident=ident, offset=2**32 - 5, pSrc=source, len=10)
    assert found.status == fiERR_SEEK
    assert (user / "a.txt").stat().st_size == 3


def test_a_directory_is_no_file(files, user):
    (user / "folder").mkdir()
    assert opened(files, "folder").status == fiERR_ACCESS
    assert opened(files, "folder", fiREAD_ONLY).status == fiERR_ACCESS


def test_a_pipe_is_no_file_and_nobody_waits_for_it(files, user):
    os.mkfifo(user / "pipe")
    assert opened(files, "pipe", fiREAD_ONLY).status == fiERR_ACCESS
    assert opened(files, "pipe", fiWRITE_ONLY).status == fiERR_ACCESS


def test_there_is_an_end_of_open_files(files, user):
    (user / "a.txt").write_text("abc")
    block = files.new(FileOpen)
    block.pDevice, block.pFile = files.text("USER"), files.text("a.txt")
    found = []
    for _ in range(129):
        block(enable=True)
        block()
        found.append(block.status)
    assert found == [ERR_OK] * 128 + [fiERR_NO_MORE_ENTRIES]


def test_a_folder_on_the_way_that_is_not_there(files):
    made = files.do(FileCreate, pDevice="USER", pFile="no/a.txt")
    assert made.status == fiERR_FILE_NOT_FOUND
    assert files.do(FileCreate, pDevice="USER", pFile="").status in (fiERR_EXIST,)
