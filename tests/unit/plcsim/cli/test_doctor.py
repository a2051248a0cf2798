"""``plcsim doctor`` from its arguments to its words."""

import json

import pytest

from plcsim.cli import doctor
from plcsim.cli.parser import CommandParser
from plcsim.core.errors import ConfigurationError
from plcsim.core.statistics import Summary
from plcsim.doctor.loops import LoopOrder, Measurement
from plcsim.host.realtime import Rights

ALL = Rights(("SCHED_FIFO 50", "CPU 1", "locked memory", "no deep sleep"), ())
NONE = Rights((), ("SCHED_FIFO: Operation not permitted",))


def parse(*arguments):
    parser = CommandParser()
    doctor.register(parser.add_subparsers())
    return parser.parse_args(["doctor", *arguments])


def run(*arguments):
    options = parse(*arguments)
    return options.func(options)


@pytest.fixture
def host_gives(monkeypatch):
    """``host_gives(rights, lateness_ns)``: what is probed and measured; returns the orders."""
    orders = []

    def host_gives(rights, lateness_ns=20_000):
        def measure(loop, order):
            orders.append(order)
            summary = Summary(order.cycles, *[lateness_ns] * 7)
            return Measurement(loop.name, order, 0, summary, 0.0)

        monkeypatch.setattr(doctor, "probe_rights", lambda: rights)
        monkeypatch.setattr(doctor, "measure", measure)
        return orders

    return host_gives


def test_the_tick_and_the_length_are_taken_from_the_arguments(host_gives):
    orders = host_gives(ALL)
    assert run("--tick", "2ms", "--seconds", "3") == 0
    assert orders == [LoopOrder(2_000_000, 1500, rights) for rights in (False, False, True, True)]


def test_a_long_tick_is_measured_for_some_cycles_at_least(host_gives):
    orders = host_gives(NONE)
    assert run("--tick", "1s") == 0
    assert {order.cycles for order in orders} == {doctor.FEWEST_CYCLES}


def test_a_host_that_holds_the_tick_is_told_so_with_and_without_rights(host_gives, capsys):
    host_gives(ALL)
    assert run() == 0
    out = capsys.readouterr().out
    assert "Without real-time rights a tick of 1 ms can be held" in out
    assert "With real-time rights a tick of 1 ms can be held" in out
    assert "To get better" not in out


def test_without_rights_nothing_is_measured_with_them_and_the_way_to_them_is_shown(
    host_gives, capsys
):
    orders = host_gives(NONE, lateness_ns=900_000)
    assert run() == 0
    out = capsys.readouterr().out
    assert not any(order.realtime for order in orders)
    assert "Without real-time rights a tick of 1 ms cannot be held" in out
    assert "rights refused" in out
    assert "Real-time rights are not given here (SCHED_FIFO: Operation not permitted)." in out
    assert "- setcap: " in out


def test_the_json_file_holds_facts_figures_verdicts_and_advice(host_gives, tmp_path):
    host_gives(NONE, lateness_ns=900_000)
    file = tmp_path / "doctor.json"
    assert run("--json", str(file)) == 0
    result = json.loads(file.read_text())
    assert result["schema"] == "plcsim-doctor/1"
    assert [m["loop"] for m in result["measurements"]][1] == "plcsim"
    assert result["measurements"][0]["lateness"]["p99_9_ns"] == 900_000
    assert result["verdicts"][0]["verdict"] == "not_held"
    assert result["rights"]["refused"] == list(NONE.refused)
    assert result["host"]["cpus"] >= 1
    assert result["advice"]


def test_a_json_file_in_a_folder_that_is_not_there_is_refused_before_measuring(host_gives):
    orders = host_gives(ALL)
    with pytest.raises(ConfigurationError, match="--json /nowhere/x: there is no folder"):
        run("--json", "/nowhere/x")
    assert orders == []


def test_a_json_file_that_cannot_be_written_is_an_error(host_gives, tmp_path):
    orders = host_gives(NONE)
    with pytest.raises(ConfigurationError, match=r"--json .*: cannot be written"):
        run("--json", str(tmp_path))
    assert orders == []  # before the measurement, not after it
    with pytest.raises(ConfigurationError, match=r"--json /dev/full: No space left"):
        run("--json", "/dev/full")


def test_ctrl_c_ends_it_without_a_trace(host_gives, monkeypatch, capsys):
    host_gives(ALL)

    def interrupted(_loop, _order):
        raise KeyboardInterrupt

    monkeypatch.setattr(doctor, "measure", interrupted)
    assert run() == 130
    assert "stopped" in capsys.readouterr().err


@pytest.mark.parametrize(
    "arguments",
    [("--tick", "soon"), ("--tick", "1us"), ("--tick", "2s"), ("--seconds", "0"),
     ("--seconds", "1.5"), ("--seconds", "-1")],
)  # fmt: skip
def test_wrong_arguments_are_refused_with_a_reason(arguments, capsys):
    with pytest.raises(SystemExit) as stopped:
        parse(*arguments)
    assert stopped.value.code == 2
    assert f"argument {arguments[0]}: " in capsys.readouterr().err


def test_this_host_is_measured(monkeypatch, capsys):
    monkeypatch.setattr(doctor, "_seconds", int)
    assert run("--seconds", "0") == 0  # the fewest cycles
    out = capsys.readouterr().out
    assert out.count("plcsim loop") == out.count("of their release (limit 200 us)")
    assert "Without real-time rights a tick of 1 ms can" in out
