"""Text that came from somewhere else, made fit to be shown."""

from __future__ import annotations

import re

_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069]")
"""All control characters of ISO 6429 but tab and line feed, both separators of Unicode, and what
turns the direction of writing: on a terminal each of them changes what stands around it."""


def escaped(text: str) -> str:
    """Return a text with every character that a terminal would act on shown as a number.

    Tabs and line feeds stay.
    """
    return _CONTROL.sub(lambda found: _number(ord(found[0])), text)


def _number(code: int) -> str:
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"
