"""A terminal with a live table, and what is printed above it."""

import io
import threading

import pytest
from rich.console import Console
from rich.text import Text

from plcsim.cli import terminal as module
from plcsim.cli.terminal import Terminal, text_of


class Screen(io.StringIO):
    """A terminal; `seen` waits until something stands on it."""

    def __init__(self):
        super().__init__()
        self._written = threading.Condition()

    def write(self, text):
        with self._written:
            size = super().write(text)
            self._written.notify_all()
            return size

    def seen(self, text):
        with self._written:
            return self._written.wait_for(lambda: text in self.getvalue(), 100)


@pytest.fixture
def screen():
    return Screen()


@pytest.fixture
def terminal(screen):
    return Terminal(Console(file=screen, force_terminal=True, width=40, highlight=False))


def test_lines_stand_above_the_table_and_the_table_goes(terminal, screen):
    terminal.show(lambda: Text("the table"))
    assert screen.seen("the table")
    terminal.put(b"one\ntwo\n")
    assert terminal.flush(lambda: True) == 0
    above = screen.getvalue().rpartition("one\ntwo\n")[2]
    assert above.startswith("the table")
    terminal.hide()
    terminal.put(b"after\n")
    assert terminal.flush(lambda: True) == 0
    assert screen.getvalue().endswith("after\n")
    assert screen.getvalue().count("\x1b[?25l") == screen.getvalue().count("\x1b[?25h") == 1


def test_the_table_is_drawn_anew_by_itself(terminal, screen, monkeypatch):
    monkeypatch.setattr(module, "PERIOD_S", 0.001)
    pictures = iter(range(10**9))
    terminal.show(lambda: Text(f"picture {next(pictures)}"))
    assert screen.seen("picture 3")
    terminal.hide()


def test_without_a_table_lines_are_printed(terminal, screen):
    terminal.put(b"a line that is longer than the terminal is wide\n")
    assert terminal.flush(lambda: True) == 0
    assert screen.getvalue() == "a line that is longer than the terminal is wide\n"
    terminal.hide()


def test_a_terminal_that_takes_nothing_is_not_waited_for(monkeypatch):
    monkeypatch.setattr(module, "PATIENCE_S", 0.05)
    stopped, go_on = threading.Event(), threading.Event()

    class Stopped(io.StringIO):
        def write(self, text):
            stopped.set()
            go_on.wait(100)
            return super().write(text)

    terminal = Terminal(Console(file=Stopped(), force_terminal=True))
    terminal.put(b"12345\n")
    stopped.wait(100)
    terminal.show(lambda: Text("table"))
    terminal.hide()
    assert terminal.flush(lambda: False) == 6
    assert terminal.room == module.ROOM - 6
    go_on.set()
    assert terminal.flush(lambda: True) == 0


def test_a_terminal_that_has_gone_takes_everything():
    class Gone(io.StringIO):
        def write(self, _):
            raise OSError(5, "Input/output error")

    terminal = Terminal(Console(file=Gone(), force_terminal=True))
    for _ in range(3):
        terminal.put(b"nobody reads this\n")
        assert terminal.flush(lambda: True) == 0


@pytest.mark.parametrize(
    ("lines", "plain"),
    [
        (b"\x1b[31mred\x1b[0m\n", "red\n"),
        (b"\x1b[2J\x1b[H\xc2\x9bK\r\n", "\\x1b[2J\\x1b[H\\x9bK\n"),
        (b"\xff\n", "\\xff\n"),
        (b"100 %\r", "100 %\\x0d"),
    ],
)
def test_colours_stay_and_nothing_else_moves_the_cursor(lines, plain):
    assert text_of(lines).plain == plain
