"""``plcsim new NAME``."""

from __future__ import annotations

import re
import shlex
import shutil
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import plcsim
from plcsim.cli.exit_codes import epilog
from plcsim.cli.new_files import GITIGNORE, MYPY_INI, PYTEST_INI, commented
from plcsim.core.errors import ConfigurationError
from plcsim.project.project_file import FILE_NAME

if TYPE_CHECKING:
    import argparse

DEFAULT_EXAMPLE = "blinky"
_SUFFIXES = {"python": "", "st": "_st", "c": "_c"}
"""What the names of examples end in, by the language of their programs."""


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    examples = ", ".join(sorted(_examples())) or "none found"
    parser = subparsers.add_parser(
        "new",
        help="start a project",
        description="Make a folder NAME with a project that runs and tests itself, a copy of an "
        f"example. Examples: {examples}.",
        examples=(
            ("plcsim new my_plc", ""),
            ("plcsim new my_plc --language st", "its program is in Structured Text"),
            ("plcsim new my_plc --language c", "in C; needs the compiler of plcsim[c]"),
            ("plcsim new my_plc --like tank", "tags over Modbus for an HMI, and a plant"),
        ),
        epilog=epilog(DONE="", FAILED="the folder is there already, or cannot be made"),
    )
    parser.add_argument("name", type=Path, metavar="NAME", help="folder to make")
    parser.add_argument(
        "--like",
        metavar="EXAMPLE",
        help=f"the example to start from (default: {DEFAULT_EXAMPLE})",
    )
    parser.add_argument(
        "--language",
        choices=tuple(_SUFFIXES),
        default="python",
        help="of the default example's program (default: python)",
    )
    parser.set_defaults(func=new)


def _examples() -> dict[str, Path]:
    """Return the example projects: in the installed package, or beside it in a checkout."""
    package = Path(plcsim.__file__).resolve().parent
    for folder in (package / "_examples", package.parent / "programs"):
        if folder.is_dir():
            return {p.parent.name: p.parent for p in folder.glob("*/plc.toml")}
    return {}


def _make_its_own(target: Path, example: str) -> None:
    """Add what a project of its own needs; a test file is called after the project.

    So tests of several projects in one repository do not have the same name.
    """
    settings = target / FILE_NAME
    settings.write_text(commented(settings.read_text("utf-8"), target.name), "utf-8")
    (target / ".gitignore").write_text(GITIGNORE, "utf-8")
    (target / "pytest.ini").write_text(PYTEST_INI, "utf-8")
    if target.name.isidentifier():
        (target / "mypy.ini").write_text(MYPY_INI.format(name=target.name), "utf-8")
    tests = target / "tests" / f"test_{example}.py"
    if tests.exists():
        tests.rename(tests.with_name(f"test_{target.name.replace('-', '_').lower()}.py"))


def new(options: argparse.Namespace) -> int:
    """Copy the example."""
    target: Path = options.name
    like = options.like or DEFAULT_EXAMPLE + _SUFFIXES[options.language]
    example = _examples().get(like)
    if example is None:
        known = ", ".join(sorted(_examples()))
        raise ConfigurationError(f"--like {like}: no such example; there are {known}")
    if target.exists():
        raise ConfigurationError(f"{target}: exists already; nothing was changed")
    if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_-]*", target.name):
        raise ConfigurationError(
            f"{target.name!r} cannot be the name of a project: a letter of A to Z comes "
            "first, then more of them, digits, _ and -"
        )
    if not target.parent.is_dir():
        raise ConfigurationError(f"{target}: there is no folder {target.parent}")
    try:
        shutil.copytree(example, target, ignore=shutil.ignore_patterns("__pycache__", ".*"))
        _make_its_own(target, example.name)
    except OSError as err:
        raise ConfigurationError(f"{target}: cannot be made: {err}") from None
    print(f"Made {target} from the example {like}. Try:")
    print(f"    plcsim run {shlex.quote(str(target))}")
    if (target / "tests").is_dir():
        if find_spec("pytest") is None:
            print("    python3 -m pip install pytest hypothesis")
        print(f"    python3 -m pytest {shlex.quote(str(target / 'tests'))}")
    return 0
