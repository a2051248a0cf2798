"""Paths on a device never lead out of it."""

import os

import pytest

from plcsim.library.fileio import (
    fiERR_DEVICE_DRIVER,
    fiERR_FILE_DEVICE,
    fiERR_FILE_NOT_FOUND,
    fiERR_INVALID_PATH,
)
from plcsim.library.fileio.files import FileDelete
from plcsim.library.fileio.transfer import FileOpen
from plcsim.library.fileio.volumes import FileRefusedError, Volumes, inside
from plcsim.library.runtime import ERR_OK


def status(files, path, device="USER"):
    return files.do(FileOpen, pDevice=device, pFile=path).status


@pytest.mark.parametrize("path", ["a.txt", "/a.txt", "\\a.txt", "./a.txt", "x/../a.txt", "A.TXT"])
def test_names_of_one_file(files, user, path):
    (user / "a.txt").write_text("a")
    assert status(files, path) == ERR_OK


def test_a_device_that_only_the_hardware_names_is_made_when_it_is_used(files, user):
    folder = user.parent / "deep" / "G"
    assert not folder.exists()
    assert status(files, "a.txt", "G:") == fiERR_FILE_NOT_FOUND
    assert folder.is_dir()
    assert status(files, "a.txt", "F:") == fiERR_FILE_NOT_FOUND
    assert not (user.parent / "other").exists()


def test_both_kinds_of_slash_separate(files, user):
    (user / "Log" / "2026").mkdir(parents=True)
    (user / "Log" / "2026" / "a.txt").write_text("a")
    assert status(files, "Log/2026/a.txt") == ERR_OK
    assert status(files, "log\\2026\\A.txt") == ERR_OK


@pytest.mark.parametrize("path", ["../plc.toml", "x/../../plc.toml", "..", "\\..\\plc.toml"])
def test_no_path_leads_out(files, user, path):
    (user.parent / "plc.toml").write_text("secret")
    assert status(files, path) == fiERR_INVALID_PATH


def test_no_symbolic_link_leads_out(files, user):
    outside = user.parent / "secret.txt"
    outside.write_text("secret")
    (user / "link.txt").symlink_to(outside)
    (user / "folder").symlink_to(user.parent)
    assert status(files, "link.txt") == fiERR_INVALID_PATH
    assert status(files, "folder/secret.txt") == fiERR_INVALID_PATH
    assert files.do(FileDelete, pDevice="USER", pName="link.txt").status == fiERR_INVALID_PATH
    (user / "inner.txt").symlink_to(user / "a.txt")
    (user / "a.txt").write_text("a")
    assert status(files, "inner.txt") == ERR_OK


def test_a_link_that_leads_to_itself(files, user):
    (user / "loop").symlink_to(user / "loop")
    assert status(files, "loop") in (fiERR_INVALID_PATH, fiERR_FILE_NOT_FOUND)


@pytest.mark.parametrize("device", ["OTHER", "", "x" * 280])
def test_no_such_device(files, device):
    assert status(files, "a.txt", device) == fiERR_FILE_DEVICE


def test_null_pointers(files):
    assert files.do(FileOpen, pFile="a.txt").status == fiERR_FILE_DEVICE
    assert files.do(FileOpen, pDevice="USER").status == fiERR_INVALID_PATH


@pytest.mark.parametrize("path", ["x" * 256, "x/" * 80 + "y" * 100, "x" * 299])
def test_paths_that_are_too_long(files, path):
    assert status(files, path) in (fiERR_INVALID_PATH, fiERR_FILE_NOT_FOUND)


def test_names_that_differ_in_case_only_are_not_guessed(user):
    (user / "a").write_text("")
    (user / "A").write_text("")
    assert inside(user, b"a").name == "a"
    (user / "bb").write_text("")
    (user / "Bb").write_text("")
    assert inside(user, b"BB").name == "BB"


def test_names_of_any_bytes(user):
    path = inside(user, b"k\xe4se.txt")
    path.write_text("x")
    assert [os.fsencode(each.name) for each in user.iterdir()] == [b"k\xe4se.txt"]


def test_the_folder_itself_may_be_a_link(tmp_path, user):
    (tmp_path / "link").symlink_to(user)
    assert inside(tmp_path / "link", b"a.txt") == user / "a.txt"


def test_a_refusal_has_a_status(user):
    with pytest.raises(FileRefusedError) as raised:
        inside(user, b"..")
    assert raised.value.status == fiERR_INVALID_PATH
    assert fiERR_DEVICE_DRIVER == 20797


def test_a_restart_closes_all_files(files, user):
    (user / "a.txt").write_text("a")
    files.do(FileOpen, pDevice="USER", pFile="a.txt")
    ((_, file),) = files.context.library(Volumes).files
    os.fstat(file.fd)
    files.context.restart()
    with pytest.raises(OSError, match="Bad file descriptor"):
        os.fstat(file.fd)
