from plcsim.core.errors import PlcError
from plcsim.machine.errors import FaultKind, Frame, MachineFault, frames_of, note_frames

FRAME = Frame("unit", "main", 3, 140)


def test_a_fault_says_why_and_where():
    assert str(MachineFault(FaultKind.PAGE_FAULT, 0x1A2B)) == "page fault: address 16#00001A2B"
    assert str(MachineFault(FaultKind.DIVISION_BY_ZERO)) == "division by zero"
    assert str(MachineFault(FaultKind.OTHER, detail="something new")) == "something new"
    assert isinstance(MachineFault(FaultKind.OTHER), PlcError)


def test_frames_are_noted_once():
    error = ValueError("text")
    assert frames_of(error) == ()
    note_frames(error, (FRAME,))
    note_frames(error, ())
    assert frames_of(error) == (FRAME,)


def test_frames_of_a_fault_are_its_own():
    fault = MachineFault(FaultKind.UNREACHABLE)
    note_frames(fault, (FRAME, FRAME))
    assert fault.frames == (FRAME, FRAME)
