"""Writes each file of the corpus again in other styles.

``good/<feature>/automation_studio`` is written by hand, in the shape of Automation Studio's
editor; this makes the folders ``by_hand`` and ``dense`` beside it. Run ``python generate.py`` after
changes; a test sees to it. ``odd`` and ``bad`` are written by hand as well.
"""

from __future__ import annotations

import re
from pathlib import Path

HERE = Path(__file__).parent

SKIPPED = r"""\(\*.*?\*\)|/\*.*?\*/|//[^\r\n]*|'(?:[^'$]|\$.)*'|"(?:[^"$]|\$.)*"|[{][^}]*[}]"""
"""Comments, strings and pragmas, which stay as they are."""

KEYWORD = re.compile(
    rf"""(?P<kept>{SKIPPED}) | \b(?:
        (?:END_)?(?:TYPE|STRUCT|VAR|FUNCTION|FUNCTION_BLOCK) | VAR_(?:INPUT|OUTPUT|IN_OUT)
      | ARRAY | OF | CONSTANT | RETAIN | REFERENCE | TO | AT | W?STRING | TIME
      | BOOL | L?REAL | U?[SD]?INT )\b (?! [ \t]* : (?!=) )""",
    re.DOTALL | re.VERBOSE,
)
BLANKS = re.compile(rf"(?P<line>//[^\r\n]*)|(?P<kept>{SKIPPED})|\s+", re.DOTALL)
OPERATORS = re.compile(rf"({SKIPPED})|[ ]*(:=|[;:,\[\]()=])[ ]*", re.DOTALL)


def by_hand(text: str) -> bytes:
    """Return the text with small keywords, blanks for tabs, LF, umlauts in Latin-1."""
    lowered = KEYWORD.sub(lambda m: m.group() if m["kept"] else m.group().lower(), text)
    head = "(* gepr\xfcft f\xfcr alle Ger\xe4te *)\n" if text.strip() else ""
    return (head + lowered.replace("\t", "  ").replace("\r\n", "\n")).encode("latin-1")


def dense(text: str) -> bytes:
    """Return the text on one line where that can be, in UTF-8 with a byte order mark."""
    packed = OPERATORS.sub(lambda m: m[1] or m[2], BLANKS.sub(_pack, text))
    return b"\xef\xbb\xbf" + ("(* \u2192 dense *)" + packed + "\n").encode() if text else b""


def _pack(match: re.Match[str]) -> str:
    if match["line"]:
        return f"(*{match['line'][2:].strip()}*)"
    return match["kept"] or " "


STYLES = {"by_hand": by_hand, "dense": dense}


def files() -> dict[Path, bytes]:
    """Return the contents of all files that this writes."""
    return {
        source.parents[1] / style / source.name: write(source.read_bytes().decode("ascii"))
        for source in sorted(HERE.glob("good/*/automation_studio/*"))
        for style, write in STYLES.items()
    }


if __name__ == "__main__":
    for path, data in files().items():
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(data)
