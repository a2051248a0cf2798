"""Tasks by ident."""

from plcsim.core.control import Action
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE, ERR_OK
from plcsim.library.sys_lib import (
    ERR_BUR_ILLIDENT,
    ERR_BUR_ILLPAR,
    ERR_BUR_ILLPTR,
    ERR_BUR_MO_NOTFOUND,
    ERR_BUR_TOOLONG_PVNAME,
    Z_ST_running,
    Z_ST_tmp_suspended,
)

MS = 1_000_000


def test_ident_0_is_the_task_that_calls(tasks):
    tasks.run_as(1)
    assert tasks.function("ST_name")(0, tasks.out, tasks.out + 32) == ERR_OK
    assert tasks.string() == "fill"
    assert tasks.function("ST_name")(0, tasks.out, 0) == ERR_OK


def test_no_task_calls(tasks):
    assert tasks.function("ST_name")(0, tasks.out, 0) == ERR_BUR_ILLIDENT


def test_ident_by_name_and_back(tasks):
    ident = tasks.function("ST_ident")
    assert ident(tasks.text("fill"), 0, tasks.out) == ERR_OK
    assert tasks.number() == 2
    assert tasks.function("ST_name")(2, tasks.out, 0) == ERR_OK
    assert tasks.string() == "fill"
    assert ident(tasks.text("Fill"), 0, tasks.out) == ERR_BUR_MO_NOTFOUND
    assert ident(0, 0, tasks.out) == ERR_BUR_ILLPTR
    assert ident(tasks.text("x" * 300), 0, tasks.out) == ERR_BUR_TOOLONG_PVNAME
    assert tasks.function("ST_name")(3, tasks.out, 0) == ERR_BUR_ILLIDENT
    assert tasks.function("ST_name")(1, 0, 0) == ERR_BUR_ILLPTR


def test_state_and_class(tasks):
    info = tasks.function("ST_info")
    assert info(2, tasks.out, tasks.out + 1) == ERR_OK
    assert (tasks.number(0, 1), tasks.number(1, 1)) == (Z_ST_running, 4)
    assert info(9, tasks.out, tasks.out + 1) == ERR_BUR_ILLIDENT
    assert info(2, 0, tasks.out) == ERR_BUR_ILLPTR


def test_a_suspended_task_is_left_out_until_it_goes_on(tasks, in_cycle):
    suspend, resume = tasks.function("ST_tmp_suspend"), tasks.function("ST_tmp_resume")
    calls = tasks.controller.tags.find("fill.calls")
    in_cycle(2, lambda: suspend(2))
    in_cycle(10, lambda: resume(2))
    tasks.controller.run_for(40 * MS)
    assert tasks.controller.tags.read(calls) == 1
    assert tasks.function("ST_info")(2, tasks.out, tasks.out + 1) == ERR_OK
    assert tasks.number(0, 1) == Z_ST_tmp_suspended
    tasks.controller.run_for(160 * MS)
    assert 3 <= tasks.controller.tags.read(calls) < 8


def test_a_task_may_suspend_itself_and_a_restart_lets_it_go_on(tasks, in_cycle):
    in_cycle(3, lambda: tasks.function("ST_suspend")(0))
    calls = tasks.controller.tags.find("mix.calls")
    tasks.controller.run_for(100 * MS)
    assert tasks.controller.tags.read(calls) == 3
    tasks.controller.shutdown()
    tasks.controller.boot()
    tasks.controller.run_for(45 * MS)
    assert tasks.controller.tags.read(calls) >= 4


def test_suspending_nobody(tasks):
    for name in "ST_tmp_suspend", "ST_tmp_resume", "ST_suspend", "ST_resume":
        assert tasks.function(name)(7) == ERR_BUR_ILLIDENT


def test_a_restart_is_requested(tasks):
    restart = tasks.function("SYSreset")
    tasks.run_as(0)
    assert restart(False, 1) == ERR_FUB_ENABLE_FALSE
    assert restart(True, 99) == ERR_BUR_ILLPAR
    assert not tasks.controller.requests
    assert restart(True, 1) == ERR_OK
    assert restart(True, 2) == ERR_OK
    warm, cold = tasks.controller.requests
    assert (warm.action, warm.source) == (Action.WARM_RESTART, "mix")
    assert cold.action is Action.COLD_RESTART
