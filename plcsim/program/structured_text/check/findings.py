"""Recording findings with their codes, and lines of tokens."""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING

from plcsim.core.suggestion import did_you_mean
from st_types.syntax.diagnostics import MAX_DIAGNOSTICS

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

    from plcsim.program.structured_text.codes import FindingCode
    from st_types.syntax.diagnostics import DiagnosticLog
    from st_types.syntax.expressions import Node
    from st_types.syntax.lexer import Tokens


class FileFindings:
    """The findings of one file.

    Args:
        tokens: of the file.
        log: takes the findings.
        hidden: codes of warnings that are not recorded.
    """

    def __init__(
        self, tokens: Tokens, log: DiagnosticLog, hidden: Collection[FindingCode] = frozenset()
    ) -> None:
        self.tokens = tokens
        self.log = log
        self._hidden = hidden

    def error(self, node: Node, code: FindingCode, message: str, hint: str = "") -> None:
        """Record an error at a node."""
        self.log.error(self.tokens.offset(node.at), message, hint, code)

    def warning(self, node: Node, code: FindingCode, message: str, hint: str = "") -> None:
        """Record a warning at a node, unless its code is hidden."""
        if code not in self._hidden:
            self.log.warning(self.tokens.offset(node.at), message, hint, code)

    def near(self, name: str, known: Iterable[str]) -> str:
        """Return what ``name`` may mean, as a message ends; "" where no message is recorded more.

        Looking for it takes long, and a file may hold thousands of wrong names.
        """
        return "" if self.log.error_count >= MAX_DIAGNOSTICS else did_you_mean(name, known)

    def line(self, node: Node) -> int:
        """Return the line of a node, from 1."""
        return bisect_right(self.tokens.source.line_starts, self.tokens.offset(node.at))
