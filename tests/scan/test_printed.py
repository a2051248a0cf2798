"""What programs print, whoever reads it: a slow reader, one that went, or nobody."""

import json
import subprocess
import sys

import pytest

from .conftest import QUICK


def test_a_program_that_prints_a_lot_loses_nothing(program, finish):
    folder = program(cyclic="print('x' * 50_000)\nprint('end')")
    code, out, _ = finish("run", folder, "--virtual", "--cycles", "20", "--quiet")
    assert code == 0
    assert out == ("x" * 50_000 + "\nend\n") * 20


def test_what_a_program_printed_before_it_was_killed_is_seen(program, finish):
    code, out, _ = finish("run", program(cyclic="print('last words')\nos._exit(0)"), "--quiet")
    assert (code, out) == (3, "last words\n")


FLOOD = "for _ in range(200): print('x' * 1_000)"  # 2 MB in 10 cycles: more than all pipes hold


def test_a_program_that_prints_to_a_blocked_pipe_goes_on(program, start):
    process = start("run", program(cyclic=FLOOD), "--cycles", "30")
    err = process.stderr.read()
    assert process.wait(100) == 0
    assert "STOPPED" in err
    (lost,) = [line for line in err.splitlines() if "are lost" in line]
    assert int(lost.split()[0].replace(",", "")) + len(process.stdout.read()) == 30 * 200 * 1_001


def test_on_the_virtual_clock_a_program_waits_for_its_reader(program, start):
    """Longer than the watchdog would let it do anything else."""
    process = start("run", program(plc=QUICK, cyclic=FLOOD), "--virtual", "--cycles", "30")
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(2)
    assert len(process.stdout.read()) == 30 * 200 * 1_001
    assert "are lost" not in process.stderr.read()
    assert process.wait(100) == 0


def test_a_reader_that_has_seen_enough_does_not_end_the_run(program, start):
    process = start("run", program(cyclic="print('line')"), "--cycles", "20")
    process.stdout.readline()
    process.stdout.close()
    process.stdout = None
    assert "lost" not in process.stderr.read()
    assert process.wait(100) == 0


@pytest.mark.parametrize("closed", ["<&-", ">&-", "2>&-", "<&- >&- 2>&-"])
def test_closed_standard_descriptors_do_not_matter(program, closed, tmp_path):
    """What a program prints must not end up in a file of ours that has got the number."""
    folder = program(cyclic="print('x' * 5000)\nprint('y' * 5000, file=sys.stderr)")
    report = tmp_path / "report.json"
    command = f'"{sys.executable}" -P -m plcsim run "$1" --cycles 5 --report "$2" {closed}'
    done = subprocess.run(
        ["sh", "-c", command, "sh", folder, report], capture_output=True, timeout=100, check=False
    )
    assert done.returncode == 0
    assert json.loads(report.read_text())["state"] == "STOPPED"
