"""Keywords of Structured Text; whether one of them is a name instead, what follows it tells."""

from __future__ import annotations

from typing import Final

from st_types.syntax.lexer import KeyTable
from st_types.syntax.specifications import VARIABLE_SECTIONS

OPERATORS: Final = frozenset(["OR", "OR_ELSE", "XOR", "AND", "AND_THEN", "MOD", "NOT"])

STATEMENT_ENDS: Final = frozenset(
    [
        *("END_IF", "END_CASE", "END_FOR", "END_WHILE", "END_REPEAT"),
        *("ELSE", "ELSIF", "UNTIL"),
    ]
)
"""What ends a list of statements inside a statement."""

UNIT_ENDS: Final = frozenset(
    [
        *("END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK", "END_ACTION", "END_METHOD"),
        *("END_PROPERTY", "END_GET", "END_SET", "END_INTERFACE", "END_CLASS", "END_NAMESPACE"),
        *("END_CONFIGURATION", "END_RESOURCE", "END_STEP", "END_TRANSITION"),
        *("END_TYPE", "END_VAR", "END_STRUCT", "END_UNION"),
    ]
)

UNIT_STARTS: Final = VARIABLE_SECTIONS | frozenset(
    [
        *("PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "ACTION", "METHOD", "PROPERTY", "INTERFACE"),
        *("CLASS", "NAMESPACE", "CONFIGURATION", "RESOURCE", "TYPE"),
        *("INITIAL_STEP", "STEP", "TRANSITION"),
    ]
)
"""What starts a unit or a block of declarations, unless it is a name."""

STATEMENT_STARTS: Final = frozenset(
    ["IF", "CASE", "FOR", "WHILE", "REPEAT", "EXIT", "CONTINUE", "RETURN", "JMP"]
)

RESERVED: Final = OPERATORS | STATEMENT_ENDS | UNIT_ENDS | {"THEN", "DO", "OF", "TO", "BY"}
"""Keywords that never stand for a value."""

WORDS: Final = frozenset(["ACCESS", "USING", "EXTENDS", "IMPLEMENTS", "WITH", "ON", "TASK"])

KEYS: Final = KeyTable(RESERVED | UNIT_STARTS | STATEMENT_STARTS | WORDS)
"""Keys of tokens for the parser of statements."""
