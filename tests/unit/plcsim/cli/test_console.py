"""Where the commands print."""

import io

import pytest

from plcsim.cli.console import CommandConsole


def test_no_line_is_cut_where_there_is_no_terminal(monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "20")
    CommandConsole().print("a word and another " * 10)
    assert len(capsys.readouterr().out.splitlines()) == 1


def test_a_terminal_has_its_width(monkeypatch):
    monkeypatch.setenv("COLUMNS", "20")
    monkeypatch.setenv("TTY_COMPATIBLE", "1")
    assert CommandConsole().width == 20


def test_text_is_no_markup(capsys):
    CommandConsole(stderr=True).print("[red] :smile:")
    assert capsys.readouterr().err == "[red] :smile:\n"


class Gone(io.StringIO):
    def write(self, _):
        raise BrokenPipeError


def test_a_reader_that_has_gone_is_an_error_of_the_caller():
    console = CommandConsole()
    console.file = Gone()
    with pytest.raises(BrokenPipeError):
        console.print("x")
