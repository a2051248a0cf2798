"""Blocks as variables of a Python program, whatever executes them."""

import pytest

from plcsim.core.context import Context
from plcsim.core.errors import ConfigurationError
from plcsim.core.memory import PAGE, Memory
from plcsim.core.system import State
from plcsim.library.catalogue import Catalogue
from plcsim.library.installed import installed
from plcsim.library.library import Library
from plcsim.program.python.blocks import give_views
from plcsim.program.site import Site
from st_types import ARRAY, Struct
from st_types.types.derived import Member, StructType
from st_types.types.views import view_class


class Adding:
    """A language whose blocks add 1 to the first UDINT of their data block."""

    name = language = "Adding"

    def bodies(self, library):
        return {block.name: self for block in library.scope.function_blocks}

    def bind(self, context):
        def run(address):
            memory = context.memory
            count = int.from_bytes(memory.read(address, 4), "little") + 1
            memory.write(address, count.to_bytes(4, "little"))

        return run


@pytest.fixture
def library(tmp_path):
    text = "FUNCTION_BLOCK Add VAR_OUTPUT Sum : UDINT; END_VAR END_FUNCTION_BLOCK\n"
    (tmp_path / "adds.fun").write_text(text)
    return Library(tmp_path, "adds")


@pytest.fixture
def view_of(library):
    """``view_of(data_type, *languages)``: a variable of this type on a controller."""

    def view_of(data_type, *languages):
        catalogue = Catalogue([library, *installed().values()], languages)
        context = Context(Memory(4 * PAGE), network=None)
        Site(context, catalogue)
        give_views(data_type, catalogue)
        return context.memory.new(view_class(data_type), context)

    return view_of


def test_a_block_of_another_language_is_called_like_any_other(view_of, library):
    add = library.scope.find_type("Add")
    data_type = StructType("V", [Member("one", add), Member("more", ARRAY(add, (1, 2)))])
    view = view_of(data_type, Adding())
    view.one()
    view.one()
    view.more[2]()
    assert (view.one.Sum, view.more[1].Sum, view.more[2].Sum) == (2, 0, 1)
    with pytest.raises(AttributeError, match="Som"):
        view.one(Som=1)


def test_a_block_that_nothing_executes_is_data_and_says_so_when_called(view_of, library):
    view = view_of(StructType("V", [Member("one", library.scope.find_type("Add"))]))
    view.one.Sum = 3
    assert view.one.Sum == 3
    with pytest.raises(ConfigurationError, match="FUNCTION_BLOCK Add has no body"):
        view.one()


def test_a_class_that_declares_itself_is_left_alone():
    from plcsim import FunctionBlock
    from st_types import UDINT, var_output

    class Own(FunctionBlock):
        Sum = var_output(UDINT)

        def execute(self):
            self.Sum += 1

    give_views(StructType("V", [Member("own", Own._plc_type)]), Catalogue([], []))
    assert Own._plc_type.view is Own


def test_a_body_is_loaded_without_an_import(run, value, ramp):
    files = ramp | {
        "main/Variables.var": "VAR inner : Inner; END_VAR",
        "Global.typ": "TYPE Inner : STRUCT ramps : ARRAY[0..1] OF Ramp; END_STRUCT; END_TYPE",
        "main/main.py": """
            from plcsim import Program

            class Main(Program):
                def cyclic(self):
                    self.inner.ramps[1](Enable=True)
        """,
    }
    controller = run(files)
    assert controller.state is State.RUN
    assert value(controller, "main.inner.ramps[1].Out") == 9


def test_enumerations_read_back_by_name(run):
    files = {
        "Global.typ": "TYPE Mode : (IDLE, RUNNING := 5); END_TYPE",
        "main/Variables.var": "VAR mode : Mode; seen : ARRAY[0..1] OF Mode; ok : BOOL; END_VAR",
        "main/main.py": """
            from plcsim import Program

            from .. import Mode

            class Main(Program):
                def cyclic(self):
                    self.mode = Mode.RUNNING
                    self.seen[1] = self.mode
                    self.ok = self.mode is Mode.RUNNING and self.seen[1].name == "RUNNING"
        """,
    }
    controller = run(files)
    assert controller.tags.read(controller.tags.find("main.ok")) is True


def test_structs_are_left_as_they_are():
    class Axis(Struct):
        pass

    give_views(Axis._plc_type, Catalogue([], []))
    assert Axis._plc_type.view is Axis
