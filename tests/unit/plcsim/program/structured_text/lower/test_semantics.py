import struct

import pytest

from plcsim.machine import MachineFault
from plcsim.program.structured_text.lower.semantics import IEC
from st_types.resolve import dialect

from ..cases import cases
from ..running import Running

DECLARATIONS = """
TYPE Point : STRUCT x : INT; y : INT; END_STRUCT; Colour : (RED, GREEN, BLUE); END_TYPE
TYPE Both : UNION r : REAL; d : DWORD; b : ARRAY[0..3] OF BYTE; END_UNION;
Inside : STRUCT n : BYTE; u : Both := (r := 2.0); END_STRUCT;
Base EXTENDS Point : STRUCT z : INT := 3; END_STRUCT
More EXTENDS Base : STRUCT w : INT; END_STRUCT END_TYPE
VAR CONSTANT LIMIT : INT := 10; END_VAR
FUNCTION count : BOOL VAR_INPUT p : UDINT; END_VAR END_FUNCTION
FUNCTION next : INT VAR_INPUT p : UDINT; END_VAR END_FUNCTION
"""


def counted(running: Running, address: int) -> int:
    """Add one to the INT at an address."""
    (old,) = struct.unpack("<h", running.memory.read(address, 2))
    running.memory.write(address, struct.pack("<h", old + 1))
    return old + 1


def shown(value: object) -> str:
    return str(value).upper() if isinstance(value, bool) else str(value)


def wanted(text: str) -> str:
    return str(int(text[3:], 16)) if text.startswith("16#") else text


def outcome(text: str, expected: str, **options: object) -> tuple[list[str], list[str]]:
    running = Running(
        f"PROGRAM _CYCLIC\n{text}\nEND_PROGRAM",
        DECLARATIONS,
        count=lambda running, address: min(counted(running, address), 1),
        next=counted,
        **options,
    )
    try:
        running.run()
        rows = [row.split(" = ") for row in expected.splitlines()]
        return [f"{n} = {shown(running[n])}" for n, _ in rows], [
            f"{n} = {wanted(value)}" for n, value in rows
        ]
    finally:
        running.close()


@pytest.mark.parametrize(("text", "expected"), cases("semantics.txt"))
def test_automation_studio(text: str, expected: str) -> None:
    found, wanted = outcome(text, expected)
    assert found == wanted


@pytest.mark.parametrize(("text", "expected"), cases("semantics_iec.txt"))
def test_standard(text: str, expected: str) -> None:
    found, wanted = outcome(text, expected, semantics=IEC, dialect=dialect.IEC)
    assert found == wanted


def test_an_index_outside_its_bounds_ends_a_standard_program() -> None:
    text = "VAR a : ARRAY[1..3] OF INT; i : INT; END_VAR i := 4; a[i] := 1;"
    with pytest.raises(MachineFault):
        outcome(text, "", semantics=IEC, dialect=dialect.IEC)
    outcome(text, "")  # it is the variable behind, in Automation Studio
