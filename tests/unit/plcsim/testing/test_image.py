"""Extensions of the project under test: what hooks in, with which settings, what they share."""

import gc
from pathlib import Path

import pytest

from plcsim.core.controller import Controller
from plcsim.project import assembly, extension
from plcsim.project.assembly import Application
from plcsim.project.extension import Attachment, Extension
from plcsim.shared_image import snapshot
from plcsim.testing.errors import PlcTestError
from plcsim.testing.plc import Plc


class Steps(Extension):
    """An extension that steps with the scan."""

    def read(self, table):
        raise AssertionError("the table is read already")

    def attach(self, settings, controller):
        assert isinstance(controller, Controller)
        self.settings = settings
        self.seen = []
        tag = controller.tags.find("Cell.count")
        controller.image.watchers.append(lambda _: self.seen.append(controller.tags.read(tag)))
        return Attachment()


class Moves(Steps):
    """One that lives at another address in tests."""

    def in_process(self, settings, ip):
        return f"{settings} at {ip or 'the host'}"


class Serves(Steps):
    """One with a process of its own."""

    def service(self, settings):
        return "a_module_that_nobody_may_import"

    def attach(self, settings, controller):
        return Attachment({"given": settings}, [controller.tags.find("Cell.count")])


@pytest.fixture
def installed(monkeypatch):
    found = {"steps": Steps(), "moves": Moves(), "serves": Serves()}
    for each in (assembly, extension):
        monkeypatch.setattr(each, "extensions", lambda: found)
    return found


@pytest.fixture
def open_with(installed, cell_plc):
    made = []

    def open_with(settings, **options):
        application = Application("cell", cell_plc.application.setup, settings)
        made.append(Plc(application, **options))
        made[-1].boot()
        return made[-1]

    yield open_with
    for plc in made:
        plc.close()


def test_those_that_step_are_attached_with_what_holds_in_process(open_with, installed):
    open_with({"steps": "a", "moves": "b"}).cycles(3)
    assert installed["steps"].settings == "a"
    assert installed["steps"].seen == [1, 2, 3]
    assert installed["moves"].settings == "b at 192.168.0.10"


def test_on_the_network_of_the_host_there_is_no_address(open_with, installed):
    open_with({"moves": "b"}, host_network=True)
    assert installed["moves"].settings == "b at the host"


def test_what_is_forced_is_what_extensions_see(open_with, installed):
    plc = open_with({"steps": "a"})
    plc.force("Cell.count", 70)
    plc.cycles(2)
    assert installed["steps"].seen == [70, 70]


@pytest.mark.parametrize("limit", [snapshot.WHOLE, 0])
def test_one_with_a_service_is_attached_as_in_a_run(open_with, monkeypatch, limit):
    monkeypatch.setattr(snapshot, "WHOLE", limit)
    plc = open_with({"serves": "c"})
    image = plc.image.reader("serves")
    plc.cycles(2)
    assert image.latest == 2
    assert image.directory.services == {"serves": {"given": "c"}}
    tag = plc.controller.tags.find("Cell.count")
    whole = plc.controller.areas[0].data_type.size
    assert image.directory.bank_size == (whole if limit else tag.data_type.size)


def test_without_a_service_there_is_no_image(open_with):
    plc = open_with({"steps": "a"})
    with pytest.raises(PlcTestError, match=r"no table \[serves\]"):
        plc.image.reader("serves")


def open_files():
    return len(list(Path("/proc/self/fd").iterdir()))


def test_closing_gives_the_memory_back(open_with):
    plc = open_with({"serves": "c"})
    gc.collect()  # what others left open is not counted
    files = open_files()
    plc.image.close()
    plc.image.close()
    assert open_files() == files - 1
