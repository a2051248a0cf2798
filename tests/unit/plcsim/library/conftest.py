"""Folders that are libraries, and a controller that calls what they declare."""

import textwrap

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.library import face
from plcsim.library.installed import Scopes, installed
from plcsim.library.library import Library
from plcsim.library.members import BlockVariables, StructMembers
from plcsim.library.models import modelled_block
from plcsim.library.runtime import ERR_FUB_BUSY
from plcsim.program.loader import installed_catalogue
from plcsim.program.python.language import PythonCode
from plcsim.program.python.program import Program
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from st_types.types.derived import DataBlockType, Member, Section

FILES = {
    "ramps.fun": """
        FUNCTION_BLOCK Ramp (*goes up*)
            VAR_INPUT
                Enable : BOOL; (*run*)
                Step : UDINT := STEP;
                axis : Axis;
            END_VAR
            VAR_OUTPUT
                Out : ARRAY[1..2] OF UDINT; (*where it is*)
                mode : Mode;
            END_VAR
            VAR
                timer : TON;
                name : STRING[9];
                level : REAL;
            END_VAR
        END_FUNCTION_BLOCK
        FUNCTION twice : UDINT
            VAR_INPUT
                x : UDINT;
            END_VAR
        END_FUNCTION
    """,
    "ramps.typ": """
        TYPE
            Axis : STRUCT (*one axis*)
                speed : REAL := 1.5; (*m/s*)
                pName : UDINT;
            END_STRUCT;
            Mode : (IDLE, RUNNING := 5);
            Speed : REAL;
        END_TYPE
    """,
    "ramps.var": """
        VAR CONSTANT
            STEP : UDINT := 3; (*of a ramp*)
            NAME : STRING[5] := 'ramp';
        END_VAR
        VAR
            instances : UDINT;
        END_VAR
    """,
}


@pytest.fixture
def files(tmp_path):
    """``files({name: text})``: a folder ``ramp_lib`` with the library of this module, and these."""

    def files(more=None):
        folder = tmp_path / "ramp_lib"
        folder.mkdir(exist_ok=True)
        for name, text in (FILES | (more or {})).items():
            (folder / name).write_text(textwrap.dedent(text), "utf-8")
        return folder

    return files


@pytest.fixture
def library(files):
    """The library of this module, which sees the installed ones."""
    made = Library(files(), "ramp_lib", Scopes([*installed().values()]))
    face.register(made)
    yield made
    face.forget("ramp_lib")


class Idle(Program):
    """A program that does nothing."""

    def cyclic(self):
        pass


class ModelBlock:
    """A block that a model runs; a call returns its status."""

    def __init__(self, plc, name, inputs, outputs, types):
        members = [Member(each, kind, section=Section.INPUT) for each, kind in inputs.items()]
        members += [Member(each, kind, section=Section.OUTPUT) for each, kind in outputs.items()]
        data_type = DataBlockType(name, members)
        self._address = plc.memory.allocate(data_type.size)
        self._variables = BlockVariables(plc.memory, StructMembers(data_type), self._address)
        found = {each.name: each for each in types}
        self._run = modelled_block(data_type, found.get).bind(plc.context)

    def __getitem__(self, name):
        return self._variables.number(name)

    def __call__(self, **inputs):
        self._variables.set(**inputs)
        self._run(self._address)
        return self["status"]

    def finish(self, **inputs):
        """Call it with enable until it is done; it is BUSY in the first call."""
        assert self(enable=True, **inputs) == ERR_FUB_BUSY
        for _ in range(1000):
            status = self()
            if status != ERR_FUB_BUSY:
                return status
        raise AssertionError("it is BUSY for ever")


class Plc:
    """A controller whose program does nothing, and shortcuts to call blocks and functions on it."""

    def __init__(self, settings=(), start_date_ns=None, network=None, channels=None):
        self.clock = VirtualClock(0)
        tasks = TaskClassSetup(1, 10_000_000, [ProgramSetup("idle", PythonCode(Idle))])
        self.controller = make_controller(
            Setup([tasks], settings=settings, start_date_ns=start_date_ns, channels=channels),
            clock=self.clock,
            network=network,
        )
        self.context = self.controller.context
        self.memory = self.controller.memory

    def pass_ms(self, milliseconds):
        """Let the next release be later."""
        self.clock.sleep_until_ns(self.clock.now_ns() + milliseconds * 1_000_000)
        self.context.release_ns = self.clock.now_ns()

    def new(self, view):
        return self.memory.new(view, self.context)

    def bytes(self, data):
        """Store bytes; return their address."""
        address = self.memory.allocate(max(len(data), 1), 8)
        self.memory.write(address, data)
        return address

    def text(self, text, size=256):
        """Store a STRING with room behind it; return its address."""
        data = text.encode("latin-1")
        return self.bytes(data + bytes(size - len(data)))

    def string(self, address):
        return self.memory.string(address, 1000).decode("latin-1")

    def call(self, view, **inputs):
        """Make a block, enable it and call it once."""
        block = self.new(view)
        block(enable=True, **inputs)
        return block

    def finish(self, view, **inputs):
        """Make an asynchronous block and call it until it is done; it is BUSY in the first call."""
        block = self.call(view, **inputs)
        assert block.status == ERR_FUB_BUSY
        calls = 1
        while block.status == ERR_FUB_BUSY:
            block()
            calls += 1
            assert calls < 1000
        return block

    def model(self, name, inputs, outputs, types=()):
        """Make a block that a model runs; members are given as types by name.

        Its library has ``types`` as well.
        """
        return ModelBlock(self, name, inputs, outputs, types)

    def function(self, name):
        """Return a FUNCTION of any library, ready to be called."""
        return installed_catalogue().find_function(name)[1].bind(self.context)


@pytest.fixture
def plc():
    return Plc()


@pytest.fixture
def make_plc():
    return Plc
