from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.library.fileio.settings import FileIoSettings
from plcsim.settings import Table


def read(folder, **devices):
    table = Table(folder / "plc.toml", "library.FileIO", {"devices": devices})
    return table.read(FileIoSettings).devices


def test_paths_begin_at_the_folder_of_the_project(tmp_path):
    (tmp_path / "files").mkdir()
    assert read(tmp_path, USER="files") == {"USER": tmp_path / "files"}
    assert read(tmp_path, USER=str(tmp_path)) == {"USER": tmp_path}


def test_a_device_is_a_folder_that_is_there(tmp_path):
    with pytest.raises(ConfigurationError, match=r"FileIO\.devices\.USER: there is no such folder"):
        read(tmp_path, USER="files")


def test_there_are_no_devices_by_default():
    assert not Table(Path("plc.toml"), "library.FileIO", {}).read(FileIoSettings).devices
