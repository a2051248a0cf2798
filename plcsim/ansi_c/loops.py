"""Whether a file of C keeps loops when the compiler has written out those of a few rounds.

Where none is left there is nothing to do in a second run of the compiler
(docs/decisions/0034-small-loops-poll-every-second-round.md).
"""

from __future__ import annotations

import re
from typing import Final

from plcsim.machine.reader import sections

MOST_ROUNDS: Final = 16
"""Rounds up to which a loop is expected to be written out."""

_CODE: Final = 10
_NOT_CODE: Final = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:\\.|[^\"\\\n])*", re.DOTALL)
_UNKNOWN: Final = re.compile(r"\b(?:while|do|goto)\b")
_FOR: Final = re.compile(r"\bfor\b")
_SHORT: Final = re.compile(
    r"\bfor\s{0,9}\([^;]{0,99};\s{0,9}\w{1,99}\s{0,9}<=?\s{0,9}(\d\d?)\s{0,9};"
)
_LOOP: Final = re.compile(rb"\x03[\x40\x6f\x70\x7b-\x7f]")
"""The instruction `loop` with each type that it can have here; other bytes may look like it."""


def seems_without_loops(text: str) -> bool:
    """Return whether a source has no loops but those of a few rounds, as far as its text tells."""
    plain = _NOT_CODE.sub(" ", text)
    rounds = [int(found) for found in _SHORT.findall(plain)]
    is_each_short = (
        len(rounds) == len(_FOR.findall(plain)) and max(rounds, default=0) <= MOST_ROUNDS
    )
    return is_each_short and not _UNKNOWN.search(plain)


def may_have_loops(wasm: bytes) -> bool:
    """Return whether there may be a loop in an object; False is certain.

    Raises:
        MachineError: it is no object.
    """
    code = [each for each in sections(wasm) if each.number == _CODE]
    return any(_LOOP.search(wasm, each.start, each.end) for each in code)
