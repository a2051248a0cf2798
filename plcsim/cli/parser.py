"""The parser of ``plcsim`` and of each of its commands: argparse, with examples and near names."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any, NoReturn

from plcsim.cli.exit_codes import ExitCode
from plcsim.core.suggestion import did_you_mean
from plcsim.core.text import escaped

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

Examples = tuple[tuple[str, str], ...]
"""Lines to type, each with what it does."""


class CommandParser(argparse.ArgumentParser):
    """A parser whose help ends with examples, and that knows what a person may have meant.

    Args:
        examples: shown at the end of the help; commands of other packages give them to
            ``add_parser`` as well.
        options: of `argparse.ArgumentParser`.
    """

    def __init__(self, *, examples: Examples = (), **options: Any) -> None:
        super().__init__(**options)
        self.examples = examples

    def format_help(self) -> str:
        """Return the help, the examples before the line about exit codes."""
        epilog, self.epilog = self.epilog, None
        try:
            parts = [super().format_help(), _table(self.examples)]
        finally:
            self.epilog = epilog
        if epilog:
            formatter = self._get_formatter()
            formatter.add_text(epilog)
            parts.append(formatter.format_help())
        return "\n".join(part for part in parts if part)

    def parse_known_args(  # type: ignore[override]  # the overloads of typeshed say the same
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse; what nobody knows is an error here, where the names that are known are at hand."""
        found, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(self._unknown(unknown))
        return found, unknown

    def _unknown(self, words: list[str]) -> str:
        option = next((word.partition("=")[0] for word in words if word.startswith("-")), "")
        hint = did_you_mean(option, self._option_string_actions) if option else ""
        return f"unrecognized arguments: {' '.join(words)}{hint}"

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Refuse what is none of the choices, with those that are near and with all."""
        choices: Iterable[Any] | None = action.choices
        if choices is None or value in choices:
            return
        known = [str(choice) for choice in choices]
        hint = did_you_mean(str(value), known) or f"; there are {', '.join(known)}"
        raise argparse.ArgumentError(action, f"there is no {value!r}{hint}")

    def error(self, message: str) -> NoReturn:
        """End with the usage and the error."""
        self.print_usage(sys.stderr)
        self.exit(ExitCode.WRONG_USAGE, f"{self.prog}: error: {escaped(message)}\n")


def _table(examples: Examples) -> str:
    """Return the examples under their heading, "" where there are none."""
    if not examples:
        return ""
    width = max(len(line) for line, _ in examples)
    lines = [f"  {line:{width}}  {text}".rstrip() for line, text in examples]
    return "\n".join(["examples:", *lines, ""])
