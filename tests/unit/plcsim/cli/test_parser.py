"""The parser of all commands: examples in every help, near names in every error."""

import shlex

import pytest

from plcsim.cli.command import build_parser
from plcsim.cli.command_tree import command_tree
from plcsim.cli.parser import CommandParser

ALL = list(command_tree(build_parser()).walk())
LEAVES = [command for command in ALL if not command.commands]


@pytest.fixture
def parser():
    made = CommandParser(
        prog="do",
        description="Does it.",
        examples=(("do this", "quickly"), ("do that --fast", "")),
        epilog="Exit codes: 0 done.",
    )
    made.add_argument("--fast", action="store_true")
    made.add_argument("what", choices=["this", "that"], nargs="?")
    return made


def test_the_examples_stand_before_the_exit_codes(parser):
    assert parser.format_help().endswith(
        "examples:\n  do this         quickly\n  do that --fast\n\nExit codes: 0 done.\n"
    )


def test_without_examples_and_exit_codes_the_help_is_that_of_argparse():
    assert CommandParser(prog="do").format_help().endswith("show this help message and exit\n")


@pytest.mark.parametrize(
    ("words", "error"),
    [
        (["--fats"], "unrecognized arguments: --fats; did you mean --fast?"),
        (["--FAST=1"], "unrecognized arguments: --FAST=1; did you mean --fast?"),
        (["this", "more"], "unrecognized arguments: more"),
        (["thsi"], "argument what: there is no 'thsi'; did you mean this?"),
        (["\x1b[2J"], "argument what: there is no '\\x1b[2J'; there are this, that"),
    ],
)
def test_what_nobody_knows_gets_what_was_meant(parser, capsys, words, error):
    with pytest.raises(SystemExit) as ended:
        parser.parse_args(words)
    assert ended.value.code == 2
    assert capsys.readouterr().err.endswith(f"\ndo: error: {error}\n")


def test_a_choice_that_is_there_is_taken(parser):
    assert parser.parse_args(["that", "--fast"]).what == "that"


@pytest.mark.parametrize("leaf", LEAVES, ids=lambda leaf: " ".join(leaf.path))
def test_every_command_has_examples_that_it_understands(leaf):
    lines = [line for line, _ in leaf.parser.examples]
    own = [line for line in lines if line.startswith("plcsim ")]
    assert own
    for line in own:
        words = shlex.split(line.partition(" > ")[0])[1:]
        assert tuple(words[: len(leaf.path)]) == leaf.path
        build_parser().parse_args(words)


@pytest.mark.parametrize("command", ALL, ids=lambda command: " ".join(command.path) or "plcsim")
def test_every_command_tells_its_exit_codes(command):
    assert "Exit codes: 0 " in " ".join(command.parser.format_help().split())
