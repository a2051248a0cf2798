"""Controllers of a setup."""

from plcsim.ansi_c.c_library import CLibrary
from plcsim.core.clock import VirtualClock
from plcsim.core.tag import Tag
from plcsim.core.task import Task, Unit
from plcsim.program.language import PlacedProgram
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from st_types.types.derived import StructType


class Code:
    """A program that tells what is done with it."""

    warnings = ()

    def __init__(self, told):
        self.told = told

    def place(self, name, site):
        def compile_():
            self.told.append(f"compile {name}")
            return False

        def task():
            self.told.append(f"link {name}")
            units = dict.fromkeys(Unit, lambda: None)
            tag = Tag(name, StructType(name, ()), site.memory.allocate(1))
            return Task(name, tag, units, fault_of=str, interrupt=str)

        self.told.append(f"place {name}")
        return PlacedProgram(compile_, task)


def test_all_programs_are_placed_before_one_is_compiled_and_compiled_before_one_is_linked():
    """Machine code depends on the places alone, so it can be made elsewhere."""
    told = []
    first, second, third, last = (ProgramSetup(n, Code(told)) for n in ("a", "b", "c", "x"))
    classes = [TaskClassSetup(4, 10, [third]), TaskClassSetup(1, 10, [first, second])]
    controller = make_controller(Setup(classes, exception_program=last), clock=VirtualClock())
    assert told == [f"{what} {n}" for what in ("place", "compile", "link") for n in "abcx"]
    tasks = [[task.name for task in each.tasks] for each in controller.classes]
    assert tasks == [["a", "b"], ["c"]]
    controller.close()


def test_the_c_library_is_compiled_beside_the_programs_and_before_one_is_linked(monkeypatch):
    told = []

    class UsesC(Code):
        def place(self, name, site):
            site.c_library()
            return super().place(name, site)

    def compile_(library):
        told.append("compile the C library")
        return whole(library)

    whole = CLibrary.compile
    monkeypatch.setattr(CLibrary, "compile", compile_)
    programs = [ProgramSetup(name, UsesC(told)) for name in "ab"]
    make_controller(Setup([TaskClassSetup(1, 10, programs)]), clock=VirtualClock()).close()
    compiled = ["compile a", "compile the C library", "compile b"]
    assert told == ["place a", "place b", *compiled, "link a", "link b"]
