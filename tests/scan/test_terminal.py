"""`plcsim run` on a terminal: what is printed stands above the live table, and nothing is lost."""

import codecs
import os
import pty
import re
import signal
import subprocess
import sys

import pytest

PROGRAM = """
    import sys
    from plcsim import Program

    class Main(Program):
        __slots__ = ("count",)

        def init(self):
            self.count = 0

        def cyclic(self):
            self.count += 1
            if self.count == 3:
                print("printed \\x1b[31min red\\x1b[0m \\x1b[2Jcleared")
                print("to stderr", file=sys.stderr)
"""

CALM = 'tolerance = "100s"'  # a violation by the host would be told between the lines


class Screen:
    """The other end of a terminal of 80 columns, on which a command runs."""

    def __init__(self, *arguments):
        self.seen = ""
        self._decoder = codecs.getincrementaldecoder("utf-8")()  # a read may end in a character
        self._fd, terminal = pty.openpty()
        os.set_inheritable(terminal, True)
        self.process = subprocess.Popen(
            [sys.executable, "-P", "-m", "plcsim", *map(str, arguments)],
            stdin=terminal,
            stdout=terminal,
            stderr=terminal,
            env=os.environ | {"TERM": "xterm", "COLUMNS": "80", "LINES": "24"},
        )
        os.close(terminal)

    def read_until(self, text):
        """Read until a text has been shown."""
        while text not in self.seen:
            try:
                self._read()
            except OSError:
                pytest.fail(f"it ended without {text!r}, after {self.seen!r}")

    def _read(self):
        """Read what there is.

        Raises:
            OSError: EIO: the other end has been closed.
        """
        self.seen += self._decoder.decode(os.read(self._fd, 65536))

    def read_all(self):
        """Read what is left, return the exit code."""
        while True:
            try:
                self._read()
            except OSError:
                return self.process.wait(100)

    def close(self):
        self.process.kill()
        self.process.wait()
        os.close(self._fd)

    @property
    def lines(self):
        """What stands on the terminal, as if it were high enough for all that was shown."""
        rows, row = [""], 0
        for up, erase, control, text in TERMINAL.findall(self.seen):
            if up:
                row -= int(up)
            elif erase:
                rows[row] = ""
            elif control == "\n":
                row += 1
                rows += [""] * (row == len(rows))
            elif text:
                rows[row] += text
        return [line.rstrip() for line in rows if line.strip()]


TERMINAL = re.compile(r"\x1b\[(\d+)A|\x1b\[2(K)|(\n)|\x1b\[[0-9;?]*[a-zA-Z]|\r|([^\x1b\r\n]+)")
"""A line up, a line erased, a line feed, what does not matter, text."""


@pytest.fixture
def screen():
    """``screen("run", folder)``: a command on a terminal."""
    opened = []

    def screen(*arguments):
        opened.append(Screen(*arguments))
        return opened[-1]

    yield screen
    for each in opened:
        each.close()


def test_what_is_printed_stands_above_the_table(project_of, screen):
    shown = screen("run", project_of(PROGRAM, CALM, plc='realtime = "off"'))
    shown.read_until("printed")
    shown.read_until("to stderr")
    shown.read_until("plcsim watch")
    shown.process.send_signal(signal.SIGINT)
    assert shown.read_all() == 0
    assert "printed \x1b[31min red\x1b[0m \\x1b[2Jcleared" in shown.seen
    assert "Ctrl-C stops it; values in another terminal: plcsim watch " in shown.seen
    first, second, summary, *_ = shown.lines
    assert {first, second} == {"printed in red \\x1b[2Jcleared", "to stderr"}
    assert summary.startswith("cell  STOPPED")  # the table has gone


def test_a_service_prints_above_the_table_too(project_of, screen):
    plc = 'realtime = "off"\n[modbus]\nport = 0\nauto = true'
    shown = screen("run", project_of(PROGRAM, CALM, plc=plc))
    shown.read_until("modbus: serving ")
    shown.read_until("[modbus] serving  127.0.0.1:any free port")
    shown.process.send_signal(signal.SIGINT)
    assert shown.read_all() == 0
    assert [line[:16] for line in shown.lines].count("modbus: serving ") == 1


def test_warnings_are_shown_while_the_plc_runs(project_of, screen):
    shown = screen("run", project_of(PROGRAM, CALM, plc="cpu = 1023"))
    shown.read_until("no real-time right: ")
    assert shown.process.poll() is None
    shown.process.send_signal(signal.SIGINT)
    assert shown.read_all() == 0
    assert (
        sum("no real-time right: there is no processor 1023" in line for line in shown.lines) == 1
    )


def test_a_terminal_that_takes_no_output_holds_nothing_up(project_of, screen):
    """Nobody reads before the run is long over."""
    program = PROGRAM.replace("if self.count == 3:", "for _ in range(100):")
    shown = screen("run", project_of(program, CALM, plc='realtime = "off"'), "--for", "500ms")
    with pytest.raises(subprocess.TimeoutExpired):
        shown.process.wait(3)
    assert shown.read_all() == 0
    (summary,) = [line for line in shown.lines if line.startswith("cell  STOPPED")]
    after = re.search(r"after ([\d.]+) (m?s)\b", summary)
    assert float(after[1]) / {"s": 1, "ms": 1000}[after[2]] < 3  # it did not wait for a reader
