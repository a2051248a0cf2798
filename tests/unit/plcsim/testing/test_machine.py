"""The state machine helper: it finds what breaks an invariant, in one cycle of many."""

import pytest
from hypothesis import Phase, settings
from hypothesis.stateful import run_state_machine_as_test

from plcsim import Program
from plcsim.testing import ExpectationFailed, PlcMachine, PlcTestError, every_cycle
from st_types import BOOL, USINT, var


class Press(Program):
    start = var(BOOL)
    door_closed = var(BOOL)
    mode = var(USINT)
    motor = var(BOOL)
    cycles = var(USINT)

    def cyclic(self):
        self.cycles += 1
        # the fault: after 20 cycles with the button held the door is no longer asked for
        held = self.cycles % 64 > 20
        self.motor = self.start and (self.door_closed or held)


class SafePress(Press):
    def cyclic(self):
        self.motor = self.start and self.door_closed


class PressMachine(PlcMachine):
    program = Press
    inputs = ("Press.start", "Press.door_closed", "Press.mode")

    @every_cycle
    def never_moves_with_an_open_door(self):
        name = self.program.__name__
        assert self.plc[f"{name}.door_closed"] or not self.plc[f"{name}.motor"]


class SafeMachine(PressMachine):
    program = SafePress
    inputs = ("SafePress.start", "SafePress.door_closed")


QUICK = settings(
    max_examples=30,
    deadline=None,
    derandomize=True,
    stateful_step_count=10,
    phases=[Phase.generate],
)


def test_a_broken_invariant_is_found():
    with pytest.raises(AssertionError):
        run_state_machine_as_test(PressMachine, settings=QUICK)


def test_a_sound_program_passes():
    run_state_machine_as_test(SafeMachine, settings=QUICK)


def test_an_invariant_may_answer_false():
    class Answering(PlcMachine):
        program = SafePress

        @every_cycle
        def never(self):
            return False

    with pytest.raises(ExpectationFailed, match="expected never after every cycle"):
        run_state_machine_as_test(Answering, settings=QUICK)


def test_a_machine_needs_something_to_drive():
    with pytest.raises(PlcTestError, match="needs a project or a program"):
        PlcMachine()
