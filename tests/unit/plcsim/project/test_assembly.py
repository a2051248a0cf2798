"""A project becomes a controller, in one way for all who need one."""

import io
import os
import sys

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State
from plcsim.network import network_of
from plcsim.project import assembly, extension
from plcsim.project.assembly import VIRTUAL_IP, ImageFile, assemble, load, still_controller
from plcsim.project.extension import Attachment, Extension
from plcsim.project.plc_toml import read_project
from plcsim.shared_image import ImageReader
from plcsim.shared_image.layout import make_file

PROGRAM = """
    from plcsim import Program
    from st_types import UINT, var

    class Main(Program):
        count = var(UINT)

        def cyclic(self) -> None:
            self.count += 1
"""
CLASS = '[task_class.1]\ncycle = "10ms"\n'
MAIN = CLASS + 'programs = ["main"]\n'


@pytest.fixture
def application(project):
    """``application(text)``: the project with this plc.toml and a program ``main``, loaded."""

    def application(text=MAIN, **files):
        sources = {f"{name}/main.py": source for name, source in files.items()}
        return load(read_project(project({"plc.toml": text, "main/main.py": PROGRAM} | sources)))

    return application


def test_a_loaded_project_runs(application):
    loaded = application("[plc]\nmemory = '64KiB'\n" + MAIN)
    controller = assemble(loaded, network=None, clock=VirtualClock())
    controller.boot()
    controller.run(cycles=3)
    assert controller.tags.read(controller.tags.find("main.count")) == 3
    assert controller.memory.size == 65536


def test_a_program_under_two_names_has_two_sets_of_variables(application):
    text = CLASS + 'programs = ["main", {name = "second", source = "main"}]'
    controller = assemble(application(text), network=None, clock=VirtualClock())
    controller.boot()
    controller.tags.write(controller.tags.find("second.count"), 100)
    controller.run(cycles=3)
    values = [controller.tags.read(controller.tags.find(f"{n}.count")) for n in ("main", "second")]
    assert values == [3, 103]


def test_a_program_that_is_not_there_is_named_with_those_that_are(application, tmp_path):
    with pytest.raises(ConfigurationError) as raised:
        application(CLASS + 'programs = ["mian"]')
    folder = tmp_path / "cell" / "mian"
    assert str(raised.value) == f"{folder}: no such program folder; there are main"


@pytest.mark.parametrize("source", ["x" * 300, "a\\u0000b"])
def test_a_source_that_can_be_no_folder_is_named(application, source):
    text = CLASS + f'programs = [{{name = "a", source = "{source}"}}]'
    with pytest.raises(ConfigurationError, match="no such program folder"):
        application(text)


def test_the_mistakes_of_all_programs_and_libraries_are_told_in_one_go(application, tmp_path):
    with pytest.raises(ConfigurationError) as raised:
        application(
            CLASS + 'programs = ["a", "main", "b", "c"]\n[library.astcp]\nidents = 3',
            a="x = (",
            b="import nonsense_",
        )
    folder = tmp_path / "cell"
    near = "there is no such library; did you mean AsTCP?"
    assert raised.value.findings == (
        f"{folder / 'plc.toml'}: library.astcp: {near}",
        f"{folder}/a/main.py:1: SyntaxError: '(' was never closed",
        f"{folder}/b/main.py:1: ModuleNotFoundError: No module named 'nonsense_'",
        f"{folder}/c: no such program folder; there are a, b, main",
    )


def modules():
    return {name for name in sys.modules if name.startswith("plcsim_project_")}


def test_a_project_is_unloaded_without_a_trace(application):
    before = modules()
    loaded = application()
    assert modules() - before
    loaded.unload()
    with pytest.raises(ConfigurationError):
        application(CLASS + 'programs = ["main", "a"]', a="x = (")
    assert modules() == before


class Web(Extension):
    def in_process(self, settings, ip):
        return f"{settings} at {ip}"

    def service(self, settings):
        return "a_module"

    def attach(self, settings, controller):
        assert controller.state is State.BOOT
        return Attachment({"given": settings}, [controller.tags.find("main.count")])


@pytest.fixture
def web(monkeypatch, application):
    """The application with settings of an extension that has a service."""
    for module in (assembly, extension):
        monkeypatch.setattr(module, "extensions", lambda: {"web": Web()})
    loaded = application()
    return assembly.replace(loaded, extensions={"web": "port 80"})


@pytest.mark.parametrize("in_process", [False, True])
def test_an_extension_is_attached_alike_in_a_run_and_in_one_process(web, in_process):
    loaded = web.in_process(VIRTUAL_IP) if in_process else web
    fd = make_file()
    try:
        controller = assemble(loaded, network=None, clock=VirtualClock(), image=ImageFile(fd))
        directory = ImageReader(fd, "web").directory
    finally:
        os.close(fd)
    given = f"port 80 at {VIRTUAL_IP}" if in_process else "port 80"
    assert directory.services == {"web": {"given": given}}
    assert directory.project == "cell"
    assert controller.state is State.BOOT


def test_a_controller_to_look_at_has_memory_and_tags_and_nothing_hooked_in(web):
    controller = still_controller(web)
    assert controller.tags.find("main.count").address
    assert not controller.image.inputs
    assert network_of(controller.context).open("", 0).socket.local.ip == "0.0.0.0"


def test_programs_that_do_not_return_are_ended(application):
    with pytest.raises(
        ConfigurationError, match=r"main\.py:2: the programs were not loaded within"
    ):
        application("[plc]\ninit_timeout = '20ms'\n" + MAIN, main="\nwhile True: pass\n")


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self):
        return True


def test_a_person_who_waits_is_told_how_many_programs_are_loaded(application, monkeypatch):
    two = CLASS + 'programs = ["main", "other"]\n'
    patience = assembly.PATIENCE_S
    monkeypatch.setattr(assembly, "PATIENCE_S", 0.0)
    for stream, told in ((Terminal(), True), (io.StringIO(), False)):
        monkeypatch.setattr(sys, "stderr", stream)
        application(two, other=PROGRAM)
        parts = stream.getvalue().split("\r")
        assert parts == (
            ["", "1 of 2 programs are loaded", "2 of 2 programs are loaded", "\x1b[K"]
            if told
            else [""]
        )
    monkeypatch.setattr(assembly, "PATIENCE_S", 100 * patience)
    monkeypatch.setattr(sys, "stderr", fast := Terminal())
    application(two, other=PROGRAM)
    assert fast.getvalue() == ""
