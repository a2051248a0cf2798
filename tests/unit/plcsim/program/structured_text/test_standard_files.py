"""Files as other tools write them: they parse, check without a finding, and run."""

import pytest

from plcsim.program.structured_text.lower.semantics import IEC
from st_types.resolve import dialect

from .cases import FOLDER
from .running import Running, checked

FILES = sorted((FOLDER / "standard").iterdir())

RESULTS = {
    "actions.st": {"n": 15, "f.o": 15, "m": 10},
    "codesys.exp": {"wState": 167, "filters[1].fOut": 0.001500000013038516, "Index": 2},
    "matiec.st": {
        "total": 7 + 5 * 12340,
        "r.XOUT": 10.0,
        "r.BUSY": False,
        "o": False,
        "q": 100,
        "way[0].x": 2.96875,
        "way[3].y": 3.0,
        "words[2,1]": 0xFF20,
        "time0": 18615020,
        "l": 100.0,
    },
    "objects.st": {
        "b.n": 36,
        "r": 26,
        "s": 72,
        "d.n": 18,
        "d.m": 3042,
        "t": 3042,
        "u": 79,
        "v": 1043,
        "x": 18,
        "y": 19,
        "z": 3,
        "str1": "hello",
        "w": 3047,
        "log.seen": 3,
        "c": 3,
        "ds[1].n": 8,
        "ds[1].m": 3030,
    },
    "openplc.st": {"count": 5, "valve": True},
    "suite.st": {
        "small": "abc",
        "loud": "Ab!",
        "again": "Ab!",
        "numbers[1]": 1,
        "res": 17,
        "f": 55,
        "a": 32,
        "b": 21,
        "x": 280.5,
        "bits": 0x1F,
        "ok": True,
    },
    "twincat.st": {"data.nCount": 8, "fb.fSum": 15.0, "bSet": True, "nLong": (1 << 32) + 5},
}
"""Worked out by hand: values after five cycles."""


def rising(running, address):
    """R_TRIG: CLK, Q, M."""
    clock, _, memory = running.memory.read(address, 3)
    running.memory.write(address + 1, bytes([clock and not memory, clock]))


def idle(running, address):
    """A block that has nothing to do in these tests."""


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_a_file_of_another_tool_has_no_findings(path):
    assert checked(path.read_text("utf-8"), dialect=dialect.IEC)[2] == []


@pytest.mark.parametrize("name", RESULTS)
def test_it_runs(name):
    text = (FOLDER / "standard" / name).read_text("utf-8")
    blocks = {"R_TRIG": rising, "TON": idle, "TOF": idle, "SR": idle}
    running = Running(text, semantics=IEC, dialect=dialect.IEC, **blocks)
    running.run(5)
    assert {path: running[path] for path in RESULTS[name]} == RESULTS[name]
    running.close()
