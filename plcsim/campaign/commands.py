"""``plcsim campaign``: many runs of a project on the virtual clock, and what came of them."""

from __future__ import annotations

import argparse
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from plcsim.campaign.errors import CampaignError
from plcsim.cli.exit_codes import epilog

if TYPE_CHECKING:
    from types import ModuleType

DESCRIPTION = (
    "Run a project many times on the virtual clock with values, faults and timings that vary, and "
    "find out where it breaks. The file of a campaign is Python; see docs/campaigns.md."
)
EXAMPLES = (
    (
        "plcsim campaign run overflow.py",
        "run what the file says, or go on where it was interrupted",
    ),
    ("plcsim campaign show overflow.py", "failures by cause, the smallest example, a picture"),
    ("plcsim campaign repeat overflow.py 137", "one run again, with its last cycles"),
    ("plcsim campaign overflow.py --scheduler tcp://cluster:8786", "on a Dask cluster"),
)
EXTRA: Final = ("distributed", "matplotlib", "pyarrow", "scipy")
"""Packages of the extra ``campaign``."""

EXITS = epilog(DONE="all runs passed", FAILED="a run did not pass, or the campaign is wrong")


class _FileOrCommand(argparse._SubParsersAction):  # type: ignore[type-arg]  # argparse has no public name for it
    """Takes ``campaign FILE`` for ``campaign run FILE``."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self.choices = None  # type: ignore[assignment]  # any file is one

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        words = list(values)
        if words[0] not in self._name_parser_map:
            words.insert(0, "run")
        super().__call__(parser, namespace, words, option_string)


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command and its own commands."""
    parser = subparsers.add_parser(
        "campaign",
        help="run a project many times with varied values, and find where it breaks",
        description=DESCRIPTION,
        examples=EXAMPLES,
        epilog=EXITS,
    )
    commands = parser.add_subparsers(
        title="commands", metavar="FILE|COMMAND", required=True, action=_FileOrCommand
    )
    _add_run(commands)
    show = _add(commands, "show", _show, "show what came of a campaign", EXAMPLES[1])
    show.add_argument("--no-shrink", action="store_true", help="no search for smaller examples")
    repeat = _add(commands, "repeat", _repeat, "do one run again, exactly", EXAMPLES[2])
    repeat.add_argument("number", type=int, nargs="?", help="of the run; see `show`")
    repeat.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="a value of the run"
    )
    repeat.add_argument("--seed", type=int, help="of network and noise")
    repeat.add_argument(
        "--record", action="append", default=[], metavar="TAG", help="a tag for the table of cycles"
    )
    repeat.add_argument(
        "--bag", type=Path, metavar="FILE", help="record the run, for `plcsim replay` and `bag`"
    )
    repeat.add_argument("--csv", type=Path, metavar="FILE", help="write what was recorded")


def _add_run(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    run = _add(commands, "run", _run, "run a campaign, or go on with it", EXAMPLES[0])
    run.add_argument(
        "--scheduler", default="", metavar="ADDRESS", help="of a Dask cluster; else this machine"
    )
    run.add_argument(
        "--processors", type=int, default=0, metavar="N", help="of this machine, by default all"
    )
    run.add_argument("--fresh", action="store_true", help="remove the results that are there")
    run.add_argument("--no-shrink", action="store_true", help="no search for smaller examples")


def _add(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    function: Any,
    text: str,
    example: tuple[str, str],
) -> argparse.ArgumentParser:
    parser: argparse.ArgumentParser = commands.add_parser(
        name,
        help=text,
        description=text[0].upper() + text[1:] + ".",
        examples=(example,),
        epilog=EXITS,
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="of the campaign")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FOLDER",
        help="of the results; FILE.results by default",
    )
    parser.set_defaults(func=function)
    return parser


def _acts() -> ModuleType:
    """Return the module that does the work, where all that it needs is installed.

    Raises:
        CampaignError: something is not.
    """
    for name in EXTRA:
        if find_spec(name) is None:
            raise CampaignError(f"campaigns need {name}: pip install 'plcsim[campaign]'")
    return import_module("plcsim.campaign.acts")


def _run(options: argparse.Namespace) -> int:
    code: int = _acts().run(options)
    return code


def _show(options: argparse.Namespace) -> int:
    code: int = _acts().show(options)
    return code


def _repeat(options: argparse.Namespace) -> int:
    code: int = _acts().repeat(options)
    return code
