"""A project with retained variables, and a controller of it with the image that services read."""

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.network import VirtualNetwork
from plcsim.project.assembly import ImageFile, assemble, load
from plcsim.project.plc_toml import read_project
from plcsim.shared_image import ImageReader
from plcsim.shared_image.layout import make_file

PLC_TOML = """
[task_class.1]
cycle = "10ms"
programs = ["press"]
[retain]
"""
PRESS = """
from plcsim import Program
from st_types import UDINT, var


class Press(Program):
    parts = var(UDINT, 5, retain=True)
    began = var(UDINT)

    def init(self) -> None:
        self.began = self.parts

    def cyclic(self) -> None:
        self.parts += 1
        self.gTotal += 2
"""
GLOBALS = "VAR RETAIN\n\tgTotal : UDINT;\n\tgName : STRING[8] := 'one';\nEND_VAR\n"


class Site:
    """A project on disk, and controllers of it one after another."""

    def __init__(self, folder):
        self.folder = folder

    def write(self, press=PRESS, declared=GLOBALS, toml=PLC_TOML):
        (self.folder / "press").mkdir(exist_ok=True)
        (self.folder / "press" / "main.py").write_text(press)
        (self.folder / "Global.var").write_text(declared)
        (self.folder / "plc.toml").write_text(toml)

    def start(self, *, cold=False):
        """Return a controller that has booted, and what its service sees."""
        application = load(read_project(self.folder))
        clock = VirtualClock()
        fd = make_file()
        controller = assemble(
            application,
            clock=clock,
            network=VirtualNetwork(clock.now_ns).host("192.168.0.10"),
            image=ImageFile(fd, [-1]),
        )
        controller.boot(cold=cold)
        application.unload()
        return controller, FakeService(ImageReader(fd, "retain"))

    @property
    def retain(self):
        return self.folder / "retain"


class FakeService:
    """What a service process has, without the process."""

    def __init__(self, image):
        self.image = image
        self.given = image.directory.services["retain"]
        self.is_stopping = False
        self.told = []

    def serving(self, text):
        self.told.append(text)


@pytest.fixture
def site(tmp_path):
    made = Site(tmp_path)
    made.write()
    return made
