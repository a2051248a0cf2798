"""Enable, Update, Active, Error."""

from plcsim.library.mtbasics import mtBCD_ERR_OUTPUT_LIMIT_INVALID
from plcsim.library.mtbasics.signals import MTBasicsLimiter


def outputs(block):
    return block.Active, block.Error, block.UpdateDone, block.StatusID, block.Out


def test_parameters_are_taken_over_when_it_is_enabled_and_by_update(plc):
    block = plc.new(MTBasicsLimiter)
    block(Enable=True, MinOut=0, MaxOut=10, In=50)
    assert outputs(block) == (True, False, False, 0, 10)
    block(MaxOut=20)
    assert block.Out == 10
    block(Update=True)
    assert outputs(block) == (True, False, True, 0, 20)
    block(MaxOut=30)
    assert block.Out == 20
    block(Update=False)
    assert outputs(block) == (True, False, False, 0, 20)


def test_wrong_parameters_do_not_enable_it(plc):
    block = plc.new(MTBasicsLimiter)
    block(Enable=True, MinOut=5, MaxOut=5, In=50)
    assert outputs(block) == (False, True, False, mtBCD_ERR_OUTPUT_LIMIT_INVALID, 0)
    block(MaxOut=9)
    assert outputs(block) == (True, False, False, 0, 9)


def test_a_wrong_update_goes_on_with_the_old_ones(plc):
    block = plc.new(MTBasicsLimiter)
    block(Enable=True, MinOut=0, MaxOut=10, In=50)
    block(MaxOut=-1, Update=True)
    assert outputs(block) == (True, True, False, mtBCD_ERR_OUTPUT_LIMIT_INVALID, 10)


def test_disabling_resets(plc):
    block = plc.new(MTBasicsLimiter)
    block(Enable=True, MinOut=0, MaxOut=10, In=50)
    block(Enable=False)
    assert outputs(block) == (False, False, False, 0, 0)


def test_outside_of_a_task_class_no_time_passes(plc):
    assert plc.new(MTBasicsLimiter).step_s == 0
