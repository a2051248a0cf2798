"""Devices."""

import pytest

from plcsim.library.fileio import (
    fiERR_DATA,
    fiERR_DATA_SIZE,
    fiERR_DEVICE_ALREADY_EXIST,
    fiERR_DEVICE_INVALID_HANDLE,
    fiERR_FILE_DEVICE,
    fiERR_FILE_NOT_FOUND,
    fiERR_INVALID_PATH,
    fiERR_NOT_SUPPORTED,
    fiERR_PARAMETER,
    fiERR_SYSTEM,
)
from plcsim.library.fileio.devices import (
    DevLink,
    DevMemInfo,
    DevUnlink,
    GetVolumeLabel,
    GetVolumeSerialNo,
)
from plcsim.library.fileio.directories import DirInfo
from plcsim.library.runtime import ERR_OK


def link(files, parameter, name="STICK"):
    return files.do(DevLink, pDevice=name, pParam=parameter)


@pytest.mark.parametrize("parameter", ["/DEVICE=F:\\logs", "/device=f:/LOGS", "/DEVICE=F:\\\\logs"])
def test_a_device_in_a_known_one(files, user, parameter):
    logs = user.parent / "stick" / "logs"
    logs.mkdir()
    (logs / "a.txt").write_text("a")
    made = link(files, parameter)
    assert made.status == ERR_OK
    assert files.do(DirInfo, pDevice="STICK").filenum == 1
    assert link(files, parameter).status == fiERR_DEVICE_ALREADY_EXIST
    assert files.do(DevUnlink, handle=made.handle).status == ERR_OK
    assert files.do(DevUnlink, handle=made.handle).status == fiERR_DEVICE_INVALID_HANDLE
    assert files.do(DirInfo, pDevice="STICK").status == fiERR_FILE_DEVICE


@pytest.mark.parametrize(
    ("parameter", "status"),
    [
        ("/DEVICE=C:\\Windows", fiERR_SYSTEM),
        ("/DEVICE=/etc", fiERR_SYSTEM),
        ("/DEVICE=F:/nothing", fiERR_SYSTEM),
        ("/DEVICE=F:/..", fiERR_INVALID_PATH),
        ("/DEVICE=F:x", fiERR_SYSTEM),
        ("/SIP=10.0.0.1 /PROTOCOL=ftp", fiERR_NOT_SUPPORTED),
        ("DEVICE=F:", fiERR_PARAMETER),
        ("", fiERR_PARAMETER),
    ],
)
def test_devices_that_cannot_be(files, parameter, status):
    made = link(files, parameter)
    assert (made.status, made.handle) == (status, 0)


def test_a_folder_of_a_device_that_nobody_names_is_made(files, user):
    assert link(files, "/DEVICE=G:\\Recipes\\old").status == ERR_OK
    assert (user.parent / "deep" / "G" / "Recipes" / "old").is_dir()
    assert files.do(DirInfo, pDevice="STICK").status == ERR_OK


def test_names_of_devices(files):
    assert link(files, "/DEVICE=F:", "USER").status == fiERR_DEVICE_ALREADY_EXIST
    assert link(files, "/DEVICE=F:", "").status == fiERR_PARAMETER
    assert files.do(DevLink, pParam="/DEVICE=F:").status == fiERR_FILE_DEVICE
    assert files.do(DevLink, pDevice="X").status == fiERR_PARAMETER


def test_the_size_of_a_device(files):
    found = files.do(DevMemInfo, pDevice="USER")
    assert found.status == ERR_OK
    assert 0 < found.freemem <= found.memsize
    assert files.do(DevMemInfo, pDevice="x").status == fiERR_FILE_DEVICE


def test_label_and_number_of_a_volume(files):
    address = files.bytes(b"#" * 8)
    found = files.do(GetVolumeLabel, pDevice="USER", pLabel=address, labelMax=5)
    assert (found.status, found.labelLen) == (ERR_OK, 4)
    assert files.memory.read(address, 6) == b"USER\0#"
    small = files.do(GetVolumeLabel, pDevice="USER", pLabel=address, labelMax=4)
    assert small.status == fiERR_DATA_SIZE
    assert files.do(GetVolumeLabel, pDevice="USER", labelMax=9).status == fiERR_DATA
    number = files.do(GetVolumeSerialNo, pDevice="USER")
    assert (number.status, number.serialNo) == (ERR_OK, 0)


def test_the_last_error_of_the_host(files):
    last = files.function("FileIoGetSysError")
    assert last() == 0
    missing = files.do(DirInfo, pDevice="USER", pPath="x")
    assert missing.status != fiERR_FILE_NOT_FOUND
    assert last() == 2
