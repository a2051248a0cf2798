"""zipArchive and zipExtract."""

import tarfile

import pytest

from plcsim.library.archives.blocks import (
    FILE_NOT_FOUND,
    FILE_WRITE_ERROR,
    INTERNAL_ERROR,
    INVALID_DEVICE,
    NULLPOINTER,
    UNSUPPORTED_EXTENSION,
)
from plcsim.library.fileio.settings import FileIoSettings
from st_types import BOOL, UDINT, UINT

ARCHIVE = ("pArchiveDevice", "pArchiveFile", "pSrcDevice", "pSrcFile", "pOptions")
EXTRACT = ("pArchiveDevice", "pArchiveFile", "pOutDevice", "pOutFolder", "pOptions")


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "logs" / "old").mkdir(parents=True)
    (tmp_path / "logs" / "one.csv").write_text("1;2")
    (tmp_path / "logs" / "old" / "two.csv").write_text("3")
    return tmp_path


@pytest.fixture
def plc(make_plc, folder):
    return make_plc(settings=[FileIoSettings(devices={"USER": folder})])


@pytest.fixture
def archive(plc):
    """``archive("a.tar", "logs")``: the status of zipArchive."""

    def run(name, source, device="USER"):
        block = plc.model("zipArchive", {"enable": BOOL} | dict.fromkeys(ARCHIVE, UDINT), STATUS)
        given = (plc.text(device), plc.text(name), plc.text("USER"), plc.text(source))
        return block.finish(**dict(zip(ARCHIVE, given, strict=False)))

    return run


@pytest.fixture
def extract(plc):
    def run(name, target):
        block = plc.model("zipExtract", {"enable": BOOL} | dict.fromkeys(EXTRACT, UDINT), STATUS)
        given = (plc.text("USER"), plc.text(name), plc.text("USER"), plc.text(target))
        return block.finish(**dict(zip(EXTRACT, given, strict=False)))

    return run


STATUS = {"status": UINT}


@pytest.mark.parametrize("name", ["a.tar", "a.tar.gz", "A.TGZ"])
def test_a_folder_is_packed_and_unpacked(archive, extract, folder, name):
    assert archive(name, "logs") == 0
    assert extract(name, "out/here") == 0
    assert (folder / "out" / "here" / "logs" / "one.csv").read_text() == "1;2"
    assert (folder / "out" / "here" / "logs" / "old" / "two.csv").read_text() == "3"


def test_a_file_is_packed_and_unpacked(archive, extract, folder):
    assert archive("one.csv.gz", "logs/one.csv") == 0
    assert extract("one.csv.gz", "out") == 0
    assert (folder / "out" / "one.csv").read_text() == "1;2"


def test_what_cannot_be_packed(archive, plc):
    assert archive("a.zip", "logs") == UNSUPPORTED_EXTENSION
    assert archive("a.gz", "logs") == UNSUPPORTED_EXTENSION
    assert archive("a.tar", "nothing") == FILE_NOT_FOUND
    assert archive("../a.tar", "logs") == FILE_NOT_FOUND
    assert archive("a.tar", "logs", device="STICK") == INVALID_DEVICE
    assert archive("no/folder/a.tar", "logs") == FILE_WRITE_ERROR
    block = plc.model("zipArchive", {"enable": BOOL} | dict.fromkeys(ARCHIVE, UDINT), STATUS)
    assert block.finish() == NULLPOINTER


def test_what_cannot_be_unpacked(extract, folder):
    (folder / "bad.tar").write_bytes(b"x" * 2000)
    (folder / "bad.gz").write_bytes(b"x" * 2000)
    (folder / "bad.zip").write_bytes(b"x")
    assert extract("none.tar", "out") == FILE_NOT_FOUND
    assert extract("bad.tar", "out") == INTERNAL_ERROR
    assert extract("bad.gz", "out") == INTERNAL_ERROR
    assert extract("bad.zip", "out") == UNSUPPORTED_EXTENSION


def test_nothing_is_written_outside_of_the_folder(extract, folder):
    with tarfile.open(folder / "evil.tar", "w") as made:
        made.add(folder / "logs" / "one.csv", "../../evil.csv")
    assert extract("evil.tar", "out/here") == INTERNAL_ERROR
    assert not list(folder.rglob("evil.csv"))
