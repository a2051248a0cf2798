"""Writes docs/st-codes.md from the table of codes in the code.

``python tools/st_codes.py`` writes it anew; a test says when that was forgotten.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

from plcsim.program.structured_text.codes import EXPLANATIONS, FindingCode

PAGE: Final = Path(__file__).resolve().parent.parent / "docs" / "st-codes.md"

_HEAD = """\
# Findings in Structured Text

What `plcsim st check` and the load of a program tell, by its code. A code is never given to another
finding. Errors (ST1 to ST4) keep a program from running, warnings (ST5) do not. This page is
written from the table in `plcsim/program/structured_text/codes.py` by `tools/st_codes.py`.
"""
_KINDS = {
    "1": "Text and declarations",
    "2": "Names",
    "3": "Types",
    "4": "Not supported",
    "5": "Warnings",
}


def page() -> str:
    """Return the page."""
    parts = [_HEAD]
    kind = ""
    for code, explanation in EXPLANATIONS.items():
        if code.value[2] != kind:
            kind = code.value[2]
            parts.append(f"## {_KINDS[kind]}\n")
        parts.append(f"### {code.value}: {explanation.title}\n\n{explanation.text}\n")
        if explanation.example:
            parts.append(f"```\n{explanation.example}\n```\n")
    assert len(EXPLANATIONS) == len(FindingCode)
    return "\n".join(parts)


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), "utf-8")


if __name__ == "__main__":
    main()
