"""Devices of Hardware.hw lie in folders beside the project."""

from pathlib import Path

import pytest

from plcsim.project.automation_studio.file_devices import file_devices

HERE = Path("/here")


@pytest.mark.parametrize(
    ("path", "folder"),
    [
        ("F:\\", "F"),
        ("F:\\Recipes\\Öl", "F/Recipes/Öl"),
        ("c:/Temp", "c/Temp"),
        ("USER_PATH", "USER_PATH"),
        ("", "DEV"),
        ("..\\..\\etc", "etc"),
        ("F:\\..\\a\\.\\b..", "F/a/b"),
        ("\\\\10.0.0.1\\share$", "10.0.0.1/share"),
        ("a\0b*?", "ab"),
    ],
)
def test_a_path_of_the_controller_is_one_inside_the_folder(path, folder):
    assert file_devices({"DEV": path}, HERE)["DEV"] == HERE / "file_devices" / folder


def test_drives_are_there_too_and_what_is_named_counts_more():
    found = file_devices({"F:": "C:\\Data", "": "x"}, HERE)
    assert found["C:"] == HERE / "file_devices" / "C"
    assert found["F:"] == HERE / "file_devices" / "C" / "Data"
    assert found["USER_PATH"] == HERE / "file_devices" / "USER_PATH"
    assert set(found) == {"C:", "D:", "E:", "F:", "USER_PATH"}
