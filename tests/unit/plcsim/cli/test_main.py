"""The command itself: help of every sub-command, exit codes, errors in one line."""

import argparse
import builtins
import io
import subprocess
import sys
from pathlib import Path

import pytest

from plcsim.cli import command as cli
from plcsim.cli.command import build_parser
from plcsim.cli.main import main
from plcsim.core.errors import PlcError
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
    assert "3 the controller ended in SERVICE" in " ".join(shown.split())


def test_the_version(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert ended.value.code == 0
    assert capsys.readouterr().out.startswith("plcsim 0.")


@pytest.mark.parametrize("arguments", [[], ["fly"], ["run", "x", "y"], ["run", "x", "--nonsense"]])
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
        (OSError(28, "No space left on device"), 1, "plcsim: [Errno 28] No space left on device\n"),
        (BrokenPipeError(), 0, ""),
        (KeyboardInterrupt(), 130, ""),
    ],
)
def test_what_a_command_raises(monkeypatch, capsys, error, code, text):
    def fail(_):
        raise error

    parser = argparse.ArgumentParser()
    parser.set_defaults(func=fail)
    monkeypatch.setattr(cli, "build_parser", lambda _command: parser)
    assert main([]) == code
    assert capsys.readouterr() == ("", text)


def test_ctrl_c_while_the_modules_are_loaded_shows_nothing(monkeypatch, capsys):
    load = builtins.__import__

    def interrupted(name, *rest):
        if name == "plcsim.cli.command":
            raise KeyboardInterrupt
        return load(name, *rest)

    monkeypatch.setattr(builtins, "__import__", interrupted)
    assert main(["check", "."]) == 130
    assert capsys.readouterr() == ("", "")


def plcsim(*arguments, **options):
    """Run ``python -m plcsim`` with a closed pipe, a full disk or other letters as output."""
    command = [sys.executable, "-P", "-m", "plcsim", *arguments]
    return subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False, **options)


PRINTING = [["types", "layout", "TON"], ["tags", "list", "tank"], ["check", "tank"]]


@pytest.mark.parametrize("arguments", PRINTING)
def test_a_full_disk_is_one_line(arguments, tmp_path):
    main(["new", str(tmp_path / "tank"), "--like", "tank"])
    with Path("/dev/full").open("w") as full:
        done = plcsim(*arguments, stdout=full, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (1, "plcsim: [Errno 28] No space left on device\n")


@pytest.mark.parametrize("arguments", PRINTING)
def test_a_reader_that_has_seen_enough_is_no_error(arguments, tmp_path):
    main(["new", str(tmp_path / "tank"), "--like", "tank"])
    pipe = subprocess.Popen(["true"], stdin=subprocess.PIPE)
    pipe.wait()
    with pipe.stdin:
        done = plcsim(*arguments, stdout=pipe.stdin, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")


def test_letters_that_the_language_has_not_are_shown_as_numbers(monkeypatch):
    out = io.TextIOWrapper(io.BytesIO(), "ascii")
    monkeypatch.setattr(sys, "stdout", out)
    parser = argparse.ArgumentParser()
    parser.set_defaults(func=lambda _: print("\xe4") or 0)
    monkeypatch.setattr(cli, "build_parser", lambda _command: parser)
    assert main([]) == 0
    assert out.buffer.getvalue() == b"\\xe4\n"


@pytest.mark.parametrize("command", commands())
def test_a_command_alone_is_as_it_is_among_all(command):
    alone = build_parser(command)._subparsers._group_actions[0].choices
    assert command in list(alone)
    among = build_parser()._subparsers._group_actions[0].choices
    assert alone[command].format_help() == among[command].format_help()


def test_a_command_of_ours_imports_no_other():
    code = (
        "import sys; from plcsim.cli.command import build_parser; build_parser('logbook'); "
        "sys.exit('plcsim.project.assembly' in sys.modules or 'numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-P", "-c", code], check=False).returncode == 0
