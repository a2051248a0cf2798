"""A program with a variable of every kind, and what a map of it is made with."""

from enum import IntEnum
from pathlib import Path

from plcsim import Program
from plcsim.core.clock import VirtualClock
from plcsim.core.controller import Controller
from plcsim.library.standard import TON
from plcsim.modbus.map import Point
from plcsim.modbus.map.csv_file import read_rows
from plcsim.modbus.map.resolve import resolve
from plcsim.network import VirtualNetwork
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from st_types import (
    ARRAY,
    BOOL,
    DINT,
    ENUM,
    INT,
    LINT,
    LREAL,
    REAL,
    SINT,
    STRING,
    TIME,
    UDINT,
    UINT,
    ULINT,
    USINT,
    WORD,
    WSTRING,
    Struct,
    var,
)
from st_types.types.derived import SubrangeType

FILE = Path("tags.csv")
MS = 1_000_000


class Mode(IntEnum):
    OFF = 0
    ON = 5


class Axis(Struct):
    position = var(DINT, -7)
    ready = var(BOOL, True)


class Everything(Program):
    flag = var(BOOL, True)
    other = var(BOOL)
    small = var(SINT, -3)
    byte = var(USINT, 200)
    number = var(INT, -1234)
    count = var(UINT, 0xABCD)
    word = var(WORD, 0x1234)
    long = var(DINT, -123456789)
    big = var(UDINT, 0x89ABCDEF)
    huge = var(LINT, -(1 << 40))
    vast = var(ULINT, 0x0123456789ABCDEF)
    real = var(REAL, 1.5)
    double = var(LREAL, -2.25)
    duration = var(TIME, 1500)
    mode = var(ENUM(Mode), Mode.ON)
    percent = var(SubrangeType("Percent", INT, 0, 100), 50)
    text = var(STRING(9), "hello")
    wide = var(WSTRING(4))
    bits = var(ARRAY(BOOL, (0, 31)))
    words = var(ARRAY(UINT, (1, 300)))
    axes = var(ARRAY(Axis, (1, 2)))
    timer = var(TON)
    cycles = var(UDINT)

    def cyclic(self) -> None:
        self.cycles += 1


def controller() -> Controller:
    clock = VirtualClock()
    network = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    setup = Setup([TaskClassSetup(1, MS, [ProgramSetup("p", PythonCode(Everything))])])
    return make_controller(setup, network=network, clock=clock)


def points(plc: Controller, *lines: str, order: str = "ABCD") -> list[Point]:
    """Return the points of rows "tag,area,offset,bit,type,length,order,access,scale,..." """
    header = "tag,area,offset,bit,type,length,order,access,scale,offset_eu,min,max,alias,partial"
    text = "\n".join([header, *lines])
    return resolve(read_rows(text, FILE), plc.tags.find, FILE, order)
