"""Extensions of the project under test: what hooks in, with which settings, in which order."""

import gc
from pathlib import Path

import pytest

from plcsim.core.controller import Controller
from plcsim.project import extension
from plcsim.project.extension import Attachment
from plcsim.shared_image import writer
from plcsim.testing import extensions as module
from plcsim.testing.errors import PlcTestError
from plcsim.testing.plc import Plc


class Steps:
    """An extension that steps with the scan."""

    def service(self, settings):
        return ""

    def read(self, table, folder):
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
        raise AssertionError("nothing is handed over to a process that does not run")


@pytest.fixture
def installed(monkeypatch):
    found = {"steps": Steps(), "moves": Moves(), "serves": Serves()}
    for each in (module, extension):
        monkeypatch.setattr(each, "extensions", lambda: found)
    return found


@pytest.fixture
def open_with(installed, cell_plc):
    made = []

    def open_with(**options):
        made.append(Plc("cell", cell_plc.setup, **options))
        made[-1].boot()
        return made[-1]

    yield open_with
    for plc in made:
        plc.close()


def test_those_that_step_are_attached_with_what_holds_in_process(open_with, installed):
    open_with(settings={"steps": "a", "moves": "b"}).cycles(3)
    assert installed["steps"].settings == "a"
    assert installed["steps"].seen == [1, 2, 3]
    assert installed["moves"].settings == "b at 192.168.0.10"


def test_on_the_network_of_the_host_there_is_no_address(open_with, installed):
    open_with(settings={"moves": "b"}, host_network=True)
    assert installed["moves"].settings == "b at the host"


def test_what_is_forced_is_what_extensions_see(open_with, installed):
    plc = open_with(settings={"steps": "a"})
    plc.force("Cell.count", 70)
    plc.cycles(2)
    assert installed["steps"].seen == [70, 70]


@pytest.mark.parametrize("limit", [writer.WHOLE_PROGRAMS, 0])
def test_one_with_a_service_gets_the_image_of_all_variables(open_with, monkeypatch, limit):
    monkeypatch.setattr(writer, "WHOLE_PROGRAMS", limit)
    plc = open_with(settings={"serves": "c"})
    image = plc.extensions.image("serves")
    plc.cycles(2)
    assert image.latest == 2
    assert image.directory.bank_size == plc.controller.areas[0].data_type.size


def test_without_a_service_there_is_no_image(open_with):
    plc = open_with(settings={"steps": "a"})
    with pytest.raises(PlcTestError, match=r"no table \[serves\]"):
        plc.extensions.image("serves")


def open_files():
    return len(list(Path("/proc/self/fd").iterdir()))


def test_closing_gives_the_memory_back(open_with):
    plc = open_with(settings={"serves": "c"})
    gc.collect()  # what others left open is not counted
    files = open_files()
    plc.extensions.close()
    plc.extensions.close()
    assert open_files() == files - 1
