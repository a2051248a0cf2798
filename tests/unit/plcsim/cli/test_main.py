"""The command itself: help of every sub-command, exit codes, errors in one line."""

import argparse
from importlib.metadata import EntryPoint

import pytest

from plcsim.cli import main as cli
from plcsim.cli.main import build_parser, main
from plcsim.errors import PlcError
from st_types.errors import TypeSystemError

OWN = ["run", "check", "doctor", "new"]


def commands():
    """The names of all sub-commands, those of other packages included."""
    actions = build_parser()._actions
    (found,) = [a for a in actions if isinstance(a, argparse._SubParsersAction)]
    return list(found.choices)


@pytest.mark.parametrize("command", ["", *commands()])
def test_every_command_has_help(command, capsys):
    with pytest.raises(SystemExit) as ended:
        main([*command.split(), "--help"])
    assert ended.value.code == 0
    shown = capsys.readouterr()
    assert shown.out.startswith(f"usage: plcsim {command}".rstrip())
    assert shown.err == ""


def test_the_help_names_the_commands(capsys):
    with pytest.raises(SystemExit):
        main(["--help"])
    shown = capsys.readouterr().out
    assert all(f"    {name} " in shown for name in OWN)
    assert "3 ended in SERVICE" in shown


def test_the_version(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert ended.value.code == 0
    assert capsys.readouterr().out.startswith("plcsim 0.")


@pytest.mark.parametrize("arguments", [[], ["fly"], ["run"], ["run", "x", "--nonsense"]])
def test_wrong_usage_is_exit_code_2(arguments, capsys):
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2
    assert capsys.readouterr().err.startswith("usage: plcsim")


@pytest.mark.parametrize(
    ("error", "code", "text"),
    [
        (PlcError("no such thing"), 1, "plcsim: no such thing\n"),
        (TypeSystemError("no such type"), 1, "plcsim: no such type\n"),
        (KeyboardInterrupt(), 130, ""),
    ],
)
def test_what_a_command_raises(monkeypatch, capsys, error, code, text):
    def fail(_):
        raise error

    parser = argparse.ArgumentParser()
    parser.set_defaults(func=fail)
    monkeypatch.setattr(cli, "build_parser", lambda: parser)
    assert main([]) == code
    assert capsys.readouterr() == ("", text)


def test_a_command_that_cannot_be_imported_costs_only_itself(monkeypatch, capsys):
    broken = EntryPoint("fly", "plcsim_no_such_module:register", cli.COMMANDS)
    monkeypatch.setattr(cli, "entry_points", lambda group: [broken])
    assert main(["check", "/nowhere"]) == 1
    first, second = capsys.readouterr().err.splitlines()
    assert first.startswith("plcsim: the command fly is not there: No module named")
    assert second.startswith("plcsim: /nowhere/plc.toml: there is no such file")
