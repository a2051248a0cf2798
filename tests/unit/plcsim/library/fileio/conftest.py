"""A controller with two devices, USER and F:, in a folder of the test."""

import pytest

from plcsim.library.fileio.settings import FileIoSettings, MadeDevices


@pytest.fixture
def user(tmp_path):
    """The folder of device USER."""
    folder = tmp_path / "project" / "user"
    folder.mkdir(parents=True)
    return folder


@pytest.fixture
def files(make_plc, user):
    """A controller whose blocks take names: ``files.do(block, pDevice="USER", pFile="a.txt")``."""
    stick = user.parent / "stick"
    stick.mkdir()

    class Files(make_plc):
        def do(self, view, **inputs):
            """Call a block until it is done; texts are stored, and their addresses given."""
            given = {
                name: self.text(value, 300) if isinstance(value, str) else value
                for name, value in inputs.items()
            }
            return self.finish(view, **given)

    made = MadeDevices({"F:": user.parent / "other", "G:": user.parent / "deep" / "G"})
    return Files([FileIoSettings(devices={"USER": user, "F:": stick}), made])
