"""Functions in functions, an extension of GCC, as what clang has instead: blocks.

``float cut(float x) {...}`` in a function becomes ``float (^cut)(float x) = ^float (float x)
{...};`` and is called likewise. Variables of the outer function that it uses become ``__block``, so
that both mean the same one; of an array it gets the address. Lines stay where they are. What a
block cannot do, clang tells: change parameters of the outer function, or be taken for a pointer to
a function.
"""

from __future__ import annotations

import re
from typing import Final

OPTION: Final = "-fblocks"
NEEDED: Final = """
__attribute__((used)) static void *_NSConcreteStackBlock[32];
__attribute__((weak)) void _Block_object_dispose(const void *object, int flags) {}
__attribute__((weak)) void _Block_object_assign(void *to, const void *from, int flags) {}
"""
"""What clang's code for blocks refers to. Nothing is ever copied to the heap."""

_NOT_CODE: Final = re.compile(
    rb"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'|^[ \t]*#[^\n]*",
    re.DOTALL | re.MULTILINE,
)
_HEAD: Final = re.compile(
    rb"(?P<before>\s*)(?P<type>[\w\s*]*?)\b(?P<name>[A-Za-z_]\w*)\s*(?P<given>\([^{};]*\))\s*"
)
_STORAGE: Final = re.compile(rb"\b(?:static|inline|__inline__|__inline|auto)\b")
_WORD: Final = re.compile(rb"[A-Za-z_]\w*")
_WORD_USED: Final = re.compile(
    rb"\bsizeof[\s(]*[A-Za-z_]\w*|(?:->|\.)\s*[A-Za-z_]\w*|([A-Za-z_]\w*)"
)
"""A name, but for members, and for what is only asked for its size."""

_ADDRESS: Final = b"plcsim_"
"""Stands before the name of an array, for a pointer to its first element."""

_STATEMENT: Final = re.compile(rb"[^;{}]+")
_DECLARATION: Final = re.compile(
    rb"\s*(?P<type>(?!(?:return|goto|else|case|typedef|static|extern|__block)\b)[A-Za-z_][\w\s]*)"
    rb"[\s*]+(?P<names>[A-Za-z_]\w*\s*(?:[=,\[].*)?)",
    re.DOTALL,
)


def as_block(text: bytes, line: int, column: int) -> bytes:
    """Return a source in which a function in a function is a block.

    Args:
        text: of the source.
        line: where the body of the inner function begins, from 1 on.
        column: of its brace, in bytes from 1 on.
    """
    plain = _NOT_CODE.sub(_blank, text)
    brace = sum(len(each) + 1 for each in text.split(b"\n")[: line - 1]) + column - 1
    start = 1 + max(plain.rfind(mark, 0, brace) for mark in (b";", b"{", b"}"))
    end = _end_of_body(plain, brace)
    head = _HEAD.fullmatch(plain, start, brace)
    if head is None or end is None:
        return text
    used = set(_WORD.findall(plain, brace, end))
    outer = _outer_body(plain, start)
    arrays = _arrays(plain, outer, start, used) - _arrays(plain, brace + 1, end, used)
    edits = [(start, brace, _addresses(arrays) + _block(head, used)), (end, end, b";")]
    edits += [(place, place, b"__block ") for place in _declared(plain, outer, start, used)]
    for found in _WORD_USED.finditer(plain, brace, end):
        if found[1] in arrays:
            edits.append((found.start(1), found.start(1), _ADDRESS))
    for first, last, new in sorted(edits, reverse=True):
        text = text[:first] + new + text[last:]
    return text


def _blank(found: re.Match[bytes]) -> bytes:
    return re.sub(rb"[^\n]", b" ", found[0])


def _block(head: re.Match[bytes], used: set[bytes]) -> bytes:
    """Return the head of a block, with as many lines as that of the function has."""
    kind = b" ".join(_STORAGE.sub(b"", head["type"]).split()) or b"int"
    given = b" ".join(head["given"].split())
    mark = b"__block " if head["name"] in used else b""  # it calls itself
    lines = b"\n" * (head[0].count(b"\n") - head["before"].count(b"\n"))
    block = b"%s %s(^%s)%s = ^%s %s" % (
        head["before"],
        mark + kind,
        head["name"],
        given,
        kind,
        given,
    )
    return block + (lines or b" ")


def _addresses(arrays: set[bytes]) -> bytes:
    """Return declarations of pointers to arrays."""
    return b"".join(
        b" __typeof__(&%s[0]) %s%s = %s;" % (name, _ADDRESS, name, name) for name in sorted(arrays)
    )


def _arrays(plain: bytes, start: int, end: int, used: set[bytes]) -> set[bytes]:
    """Return the names of the arrays that are declared in a part of a source, and used."""
    names: set[bytes] = set()
    for statement in _STATEMENT.finditer(plain, start, end):
        found = _DECLARATION.fullmatch(statement[0])
        if found is not None:
            names.update(re.findall(rb"(?:^|,)[\s*]*([A-Za-z_]\w*)\s*\[", found["names"]))
    return names & used


def _end_of_body(plain: bytes, brace: int) -> int | None:
    """Return the place behind a body that begins at a brace, None where it does not end."""
    depth = 0
    for found in re.compile(rb"[{}]").finditer(plain, brace):
        depth += 1 if found[0] == b"{" else -1
        if not depth:
            return found.end()
    return None


def _outer_body(plain: bytes, start: int) -> int:
    """Return where the body of the function begins in which a place lies."""
    depth, outer = 0, start
    for found in reversed(list(re.finditer(rb"[{}]", plain[:start]))):
        depth += 1 if found[0] == b"}" else -1
        if depth < 0:
            depth = 0
            if plain[: found.start()].rstrip().endswith(b")"):
                outer = found.end()
    return outer


def _declared(plain: bytes, start: int, end: int, used: set[bytes]) -> list[int]:
    """Return where the declarations begin, in a part of a source, of variables that are used."""
    places = []
    for statement in _STATEMENT.finditer(plain, start, end):
        found = _DECLARATION.fullmatch(statement[0])
        if found is None or b"[" in found["names"]:
            continue
        names = re.findall(rb"(?:^|,)[\s*]*([A-Za-z_]\w*)", found["names"])
        if used.intersection(names):
            places.append(statement.start() + found.start("type"))
    return places
