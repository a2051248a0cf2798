"""The controller: units, faults of programs, restart, policies, records."""

import pytest

from plcsim.core.controller import VIOLATIONS_KEPT
from plcsim.core.errors import CycleTimeViolation, ProgramError, StateError
from plcsim.core.logbook import Severity
from plcsim.core.system import State
from plcsim.core.task import Cause, Policy, Violation
from st_types import UINT, var

MS = 1_000_000


@pytest.fixture
def calls():
    """What programs did, in order."""
    return []


@pytest.fixture
def noting(program_of, calls):
    """``noting("p")``: a program that notes each unit that runs."""

    def noting(name, **body):
        units = {unit: _note(calls, name, unit) for unit in ("init", "cyclic", "exit")}
        return program_of(**units | body)

    return noting


def _note(calls, name, unit):
    return lambda _: calls.append((name, unit))


def fail(_):
    raise ValueError("no")


def texts(controller, severity=Severity.ERROR):
    return [entry.text for entry in controller.logbook if entry.severity is severity]


# units


def test_inits_run_once_in_configured_order_then_cycles_then_exits(
    make_controller, task_class, noting, calls
):
    controller = make_controller(
        task_class(4, 10, d=noting("d")),
        task_class(1, 10, b=noting("b"), a=noting("a")),
    )
    assert controller.boot() is State.RUN
    controller.run_for(6 * MS)
    assert controller.shutdown() is State.STOPPED
    assert calls == [(name, unit) for unit in ("init", "cyclic", "exit") for name in "bad"]


def test_the_exception_program_has_init_and_exit_last(make_controller, task_class, noting, calls):
    controller = make_controller(task_class(1, 10, a=noting("a")), exception_program=noting("x"))
    controller.boot()
    controller.shutdown()
    assert calls == [("a", "init"), ("x", "init"), ("a", "exit"), ("x", "exit")]


def test_init_is_not_monitored(make_controller, task_class, program_of, clock):
    slow = program_of(init=lambda _: clock.spend_ns(5000 * MS))
    controller = make_controller(task_class(1, 10, p=slow))
    assert controller.boot() is State.RUN
    controller.run_for(10 * MS)
    assert (controller.classes[0].cycles, controller.violations) == (1, [])


def test_init_and_exit_see_the_time_of_the_controller(make_controller, task_class, clock):
    seen = []
    make = _releases_of(seen)
    controller = make_controller(task_class(1, 10, p=make))
    start_ns = clock.now_ns()
    controller.boot()
    controller.run_for(20 * MS)
    controller.shutdown()
    assert [release - start_ns for release in seen] == [0, 5 * MS, 15 * MS, 20 * MS]


def _releases_of(seen):
    from plcsim.program.python.program import Program

    def note(program):
        seen.append(program.context.release_ns)

    return type("Timed", (Program,), {"init": note, "cyclic": note, "exit": note})


def test_exits_run_once(make_controller, task_class, noting, calls):
    controller = make_controller(task_class(1, 10, p=noting("p")))
    controller.boot()
    controller.shutdown()
    assert controller.shutdown() is State.STOPPED
    assert calls == [("p", "init"), ("p", "exit")]


def test_without_init_there_is_no_exit(make_controller, task_class, noting, calls):
    controller = make_controller(task_class(1, 10, p=noting("p")))
    controller.shutdown()
    assert calls == []


# a stop


def test_a_stop_ends_the_run_after_the_cycle(make_controller, task_class, noting, calls):
    stopping = noting("a", cyclic=lambda _: controller.stop())
    controller = make_controller(task_class(1, 10, a=stopping, b=noting("b")))
    controller.boot()
    controller.run()
    controller.shutdown()
    assert calls == [("a", "init"), ("b", "init"), ("b", "cyclic"), ("a", "exit"), ("b", "exit")]
    assert controller.classes[0].cycles == 1


def test_a_stop_in_init_is_not_lost(make_controller, task_class, noting, calls):
    stopping = noting("p", init=lambda _: controller.stop())
    controller = make_controller(task_class(1, 10, p=stopping))
    assert controller.boot() is State.RUN
    assert controller.run() is State.RUN
    assert controller.shutdown() is State.STOPPED
    assert calls == [("p", "exit")]


def test_after_a_stop_nothing_runs_until_a_restart(make_controller, task_class, noting):
    controller = make_controller(task_class(1, 10, p=noting("p")))
    controller.boot()
    controller.stop()
    controller.run(cycles=5)
    assert controller.classes[0].cycles == 0
    controller.shutdown()
    controller.boot()
    controller.run(cycles=5)
    assert controller.classes[0].cycles == 5


# programs that fail


def test_an_init_that_raises_leads_to_service(make_controller, task_class, noting, calls):
    programs = {"a": noting("a", init=fail), "b": noting("b")}
    controller = make_controller(task_class(1, 10, **programs))
    assert controller.boot() is State.SERVICE
    assert controller.run(cycles=3) is State.SERVICE
    assert controller.shutdown() is State.SERVICE
    assert calls == []
    assert controller.fault.unit == "INIT"


def divide(_):
    return 1 // 0


def wild(program):
    program.context.memory.write(0xDEAD_0000, b"\0")


def leave(_):
    raise SystemExit(0)


def interrupt(_):
    raise KeyboardInterrupt


def nested(_):
    def inner():
        raise RuntimeError("two\nlines")

    inner()


class UnprintableError(Exception):
    def __str__(self):
        raise RuntimeError("no text either")


def unprintable(_):
    raise UnprintableError


def chatty(_):
    raise ValueError("x" * 1_000_000)


@pytest.mark.parametrize(
    ("cyclic", "reason", "line"),
    [
        (divide, "division by zero", 1),
        (wild, "page fault: 1 bytes at address 16#DEAD0000", 1),
        (fail, "ValueError: no", 1),
        (leave, "SystemExit: 0", 1),
        (interrupt, "KeyboardInterrupt", 1),
        (nested, "RuntimeError: two lines", 2),
        (unprintable, "UnprintableError", 1),
    ],
)
def test_what_a_program_raises_leads_to_service_with_its_line(
    make_controller, task_class, noting, calls, cyclic, reason, line
):
    programs = {"a": noting("a", cyclic=cyclic), "b": noting("b")}
    controller = make_controller(task_class(1, 10, **programs), task_class(2, 10, c=noting("c")))
    controller.boot()
    assert controller.run(cycles=3) is State.SERVICE
    place = f"{__file__}:{cyclic.__code__.co_firstlineno + line}"
    assert isinstance(controller.fault, ProgramError)
    assert str(controller.fault) == f"a CYCLIC: {reason} ({place})"
    assert texts(controller) == [str(controller.fault)]
    assert controller.fault.__cause__ is not None
    assert [call for call in calls if call[1] != "init"] == []


def test_a_fault_with_a_very_long_text_is_cut(make_controller, task_class, program_of):
    controller = make_controller(task_class(1, 10, p=program_of(chatty)))
    controller.boot()
    controller.run(cycles=1)
    assert len(controller.fault.reason) < 1000
    assert controller.fault.reason.startswith("ValueError: xxx")


def test_after_service_no_exit_runs(make_controller, task_class, noting, calls):
    controller = make_controller(task_class(1, 10, a=noting("a"), b=noting("b", cyclic=fail)))
    controller.boot()
    controller.run(cycles=1)
    assert controller.shutdown() is State.SERVICE
    assert ("a", "exit") not in calls


def test_a_failed_exit_is_logged_and_the_others_run(make_controller, task_class, noting, calls):
    programs = {name: noting(name) for name in "ac"} | {"b": noting("b", exit=fail)}
    controller = make_controller(task_class(1, 10, **programs))
    controller.boot()
    assert controller.shutdown() is State.SERVICE
    assert calls[-2:] == [("a", "exit"), ("c", "exit")]
    assert controller.fault.unit == "EXIT"
    assert "b EXIT: ValueError: no" in texts(controller)[0]


def test_the_first_fault_is_the_one_that_counts(make_controller, task_class, noting):
    programs = {"a": noting("a", exit=fail), "b": noting("b", exit=divide)}
    controller = make_controller(task_class(1, 10, **programs))
    controller.boot()
    controller.shutdown()
    assert controller.fault.program == "a"
    assert len(texts(controller)) == 2


def test_after_a_fault_not_even_the_exception_program_runs(
    make_controller, task_class, noting, calls, clock
):
    def late_and_wrong(_):
        clock.spend_ns(11 * MS)
        raise ValueError("no")

    controller = make_controller(
        task_class(1, 10, {"policy": Policy.EXCEPTION}, p=noting("p", cyclic=late_and_wrong)),
        exception_program=noting("x"),
    )
    controller.boot()
    assert controller.run(cycles=1) is State.SERVICE
    assert len(controller.violations) == 1
    assert ("x", "cyclic") not in calls


@pytest.mark.parametrize("numbers", [(), (2, 2)])
def test_task_classes_have_numbers_of_their_own(make_controller, task_class, noting, numbers):
    with pytest.raises(ValueError, match="at least one, each number once"):
        make_controller(*(task_class(number, 10, p=noting("p")) for number in numbers))


def test_only_a_running_program_can_be_ended(make_controller, task_class, program_of):
    controller = make_controller(task_class(1, 10, p=program_of()))
    controller.boot()
    controller.abort_program("nobody runs")
    stuck = program_of(init=lambda _: other.abort_program("the program did not return"))
    other = make_controller(task_class(1, 10, p=stuck))
    assert other.boot() is State.SERVICE
    assert isinstance(other.fault.__cause__, CycleTimeViolation)
    assert "the program did not return" in str(other.fault)


# restart


def test_a_restart_gives_variables_their_initial_values_and_closes_libraries(
    make_controller, task_class, program_of
):
    closed = []

    class Sockets:
        def __init__(self, context):
            self.context = context

        def close(self):
            closed.append(self)

    def cyclic(program):
        program.count += 1
        program.context.library(Sockets)
        if program.count == 9:
            raise ValueError("nine")

    controller = make_controller(task_class(1, 10, p=program_of(cyclic, count=var(UINT, 7))))
    controller.boot()
    assert controller.run(cycles=5) is State.SERVICE
    assert controller.tasks[0].cyclic.__self__.count == 9
    assert controller.boot() is State.RUN
    assert controller.fault is None
    assert controller.tasks[0].cyclic.__self__.count == 7
    assert len(closed) == 1
    assert controller.run(cycles=1) is State.RUN
    controller.shutdown()
    assert len(closed) == 2
    assert closed[0] is not closed[1]


def test_a_restart_starts_a_new_grid(make_controller, task_class, program_of, clock):
    seen = []

    def cyclic(program):
        seen.append(program.context.release_ns)
        if len(seen) == 1:
            raise ValueError("once")

    controller = make_controller(task_class(1, 10, p=program_of(cyclic)))
    controller.boot()
    controller.run(cycles=1)
    clock.sleep_until_ns(clock.now_ns() + 123 * MS)
    restarted_ns = clock.now_ns()
    controller.boot()
    controller.run(cycles=1)
    assert seen[1] == restarted_ns + 5 * MS
    assert controller.classes[0].missed == 0


def test_a_controller_that_runs_cannot_be_booted(make_controller, task_class, noting, calls):
    controller = make_controller(task_class(1, 10, p=noting("p")))
    controller.boot()
    with pytest.raises(StateError, match="not possible in state RUN: somebody asked for a restart"):
        controller.boot()
    assert controller.state is State.RUN
    assert calls == [("p", "init")]


def test_a_restart_forgets_the_last_violation(make_controller, task_class, program_of, clock):
    seen = []
    slow = program_of(lambda _: clock.spend_ns(11 * MS))
    record = program_of(
        lambda program: seen.append(program.context.violation),
        init=lambda program: seen.append(program.context.violation),
    )
    controller = make_controller(
        task_class(1, 10, {"policy": Policy.EXCEPTION}, p=slow), exception_program=record
    )
    controller.boot()
    controller.run(cycles=1)
    controller.shutdown()
    controller.boot()
    assert [violation is None for violation in seen] == [True, False, True]


def test_the_logbook_goes_on_over_a_restart(make_controller, task_class, program_of):
    controller = make_controller(task_class(1, 10, p=program_of(fail)))
    for _ in range(3):
        controller.boot()
        controller.run(cycles=1)
    times = [entry.time_ns for entry in controller.logbook]
    assert times == sorted(times)
    assert times[-1] == 15 * MS


# records


def test_records_of_violations_are_bounded_and_all_are_counted(
    run_for, task_class, program_of, clock
):
    program = program_of(lambda _: clock.spend_ns(11 * MS))
    controller = run_for(20_000, task_class(1, 10, {"policy": Policy.LOG}, p=program))
    assert len(controller.violations) == VIOLATIONS_KEPT
    assert controller.violations[-1].cycle == controller.classes[0].cycles == 1000
    assert controller.classes[0].violations[Cause.PROGRAM] == 1000
    assert len(controller.logbook) + controller.logbook.dropped > 1000


@pytest.mark.parametrize(
    ("policy", "severity"), [(Policy.SERVICE, Severity.ERROR), (Policy.LOG, Severity.WARNING)]
)
def test_a_violation_is_in_the_logbook(run_for, task_class, program_of, clock, policy, severity):
    program = program_of(lambda _: clock.spend_ns(25 * MS))
    controller = run_for(6, task_class(1, 10, {"policy": policy}, p=program))
    (entry,) = [e for e in controller.logbook if e.source == "task class 1"]
    assert entry.severity is severity
    assert entry.text == (
        "cycle time violation in cycle 1, cause program: program p used 25 ms; "
        "ended 25 ms after its release, limit 10 ms"
    )


@pytest.mark.parametrize(
    ("cause", "place", "part"),
    [
        (Cause.PROGRAM, "", "cause program: program p used 20 ms;"),
        (Cause.PROGRAM, "main.py:3", "program p did not return, ended at main.py:3;"),
        (Cause.PREEMPTED, "", "programs of other classes used 30 ms, p most;"),
        (Cause.CONTROLLER, "", "LATCH and PUBLISH used 40 ms, for what is read and written from"),
        (Cause.HOST, "", "the host did not give the CPU in time;"),
    ],
)
def test_a_violation_as_a_sentence(cause, place, part):
    from plcsim.core.controller import describe_violation

    violation = Violation(1, "p", 1, cause, 0, 50 * MS, 20 * MS, 30 * MS, 40 * MS, 10 * MS, place)
    assert part in describe_violation(violation)


def test_a_program_that_is_ended_on_the_virtual_clock_took_none_of_its_time():
    from plcsim.core.controller import describe_violation

    violation = Violation(1, "p", 5, Cause.PROGRAM, 0, 0, 0, 0, 0, 10 * MS, "main.py:3")
    assert describe_violation(violation) == (
        "cycle time violation in cycle 5, cause program: program p did not return, ended at "
        "main.py:3; the time limit was the watchdog's, as no virtual time passes while a program "
        "runs"
    )


def test_the_heartbeat_is_told_what_runs(make_controller, task_class, program_of):
    told = []

    class Heartbeat:
        def started(self, task):
            told.append(task.name)

        def finished(self, task_class):
            told.append(task_class.number)

        def changed(self, state):
            told.append(state)

    controller = make_controller(
        task_class(1, 10, a=program_of(), b=program_of()), heartbeat=Heartbeat()
    )
    controller.boot()
    controller.run(cycles=1)
    controller.shutdown()
    assert told == [State.BOOT, "a", "b", State.RUN, "a", "b", 1, State.STOPPED, "a", "b"]
