"""The declaration of ``plcsim ros``."""

import argparse
import subprocess
import sys
from pathlib import Path

import pytest

from crosnode.commands.ros import register
from plcsim.cli.parser import CommandParser


def parse(*arguments: str) -> argparse.Namespace:
    parser = CommandParser()
    register(parser.add_subparsers())
    return parser.parse_args(["ros", *arguments])


def test_arguments() -> None:
    namespace = parse("md5", "--path", "a", "--path", "b", "x/Y", "z/W")
    assert namespace.path == [Path("a"), Path("b")]
    assert namespace.types == ["x/Y", "z/W"]
    assert parse("md5", "x/Y", "--path", "a").path == [Path("a")]
    assert parse("show", "x/Y").path == []
    assert parse("encode", "x/Y", "{}").json == "{}"
    assert parse("decode", "x/Y", "00").hex == "00"


@pytest.mark.parametrize("arguments", [[], ["md5"], ["show"], ["encode", "x/Y"], ["nonsense"]])
def test_wrong_usage(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        parse(*arguments)
    assert "usage:" in capsys.readouterr().err


def test_declaring_loads_nothing_heavy() -> None:
    """Every command of plcsim declares these."""
    code = "import sys, crosnode.commands.ros\nsys.exit('numpy' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(__file__).parents[4])
