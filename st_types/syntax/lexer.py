"""Lexer of Structured Text and of .typ, .var and .fun files.

One compiled regular expression cuts the whole text into tokens in C. A token is its text; blanks,
comments and pragmas before it are its trivia. Tokens are numbered, and their offsets are worked out
only when a place is asked for, which most parses never do.

Comments are ``(* *)``, ``/* */`` and ``//``. Files of Automation Studio do not nest them, but
hand-written ones may: `unnest_comments` is for texts that do not parse otherwise.
"""

from __future__ import annotations

import re
from enum import Enum, auto
from itertools import accumulate, chain
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from st_types.syntax.source import Location, Source

MAX_TOKENS = 1_000_000
"""Tokens of one file that are read; bounds the memory that a hostile file can take."""

LOOKAHEAD = 4
"""Number of empty tokens behind the last one, so that a parser may look ahead unchecked."""

BLANKS = r"[ \t\n\r\f\v\xa0\ufeff\x1a]"
"""Blanks: also the no-break space, a byte order mark inside the text and the DOS end of file.

They are spelled out, as a set without a class of characters is looked up faster.
"""

# What cannot start a comment ends the blanks at once; that spares most tokens the repetition.
_TRIVIA = rf"""
    {BLANKS}*
    (?: (?! [(/{{] )
      | (?: (?: \(\* .*? (?: \*\) | \Z )
              | // [^\r\n]*
              | /\* .*? (?: \*/ | \Z )
              | \{{ [^{{}}]* \}} )
            {BLANKS}* )* )
"""
_WORD = "[A-Za-z0-9_]"
_STRINGS = r"""' [^'$\r\n]* (?: \$. [^'$\r\n]* )* ' | " [^"$\r\n]* (?: \$. [^"$\r\n]* )* \""""
# The commonest tokens stand first; an identifier before # is part of a literal. One of the last two
# always matches, so nothing that was taken is given back. Possessive quantifiers would say so, but
# Python took them wrongly before 3.11.5, and Debian 12 has 3.11.2 (python/cpython issue 106052).
_LEXEME = rf"""
    (?: [A-Za-z_] {_WORD}* (?! [A-Za-z0-9_\#] )
      | [;()+,\[\]]
      | :=?
      | [0-9]+ (?! [\w.\#] )
      | (?i:L?(?:DATE_AND_TIME|DATE|DT|D|TIME_OF_DAY|TOD)) \# \d [\d:._-]*
      | [A-Za-z_] \w*
        (?: \# (?: {_STRINGS}
                 | [+-]? \d+ \# \w+
                 | [+-]? \d (?: \w | \.(?=\d) | (?<=[eE])[+-](?=\d) )*
                 | [A-Za-z_] \w* ) )?
      | \.\. | => | <> | <= | >= | \*\*
      | \d+ \# \w+
      | \d [\d_]* (?: \. (?: \d [\d_]* | (?![.\w]) ) )? (?: [eE] [+-]? \d+ )?
      | {_STRINGS}
      | ['"] [^\r\n]*
      | % (?: "[^"\r\n]*" | [\w*] | \.(?!%) )+
      | \# [ \t]* [A-Za-z] [^\r\n]*
      | . | \Z )
"""
_CUT = re.compile(f"({_TRIVIA})({_LEXEME})", re.VERBOSE | re.DOTALL | re.ASCII)
_STRING = re.compile(_STRINGS, re.VERBOSE | re.DOTALL)


class TokenKind(Enum):
    """What a token is; keywords are identifiers, for any of them may be a name."""

    END = auto()
    IDENTIFIER = auto()
    LITERAL = auto()
    OPERATOR = auto()
    ADDRESS = auto()
    """A direct address such as ``%IX0.1``."""
    DIRECTIVE = auto()
    """A preprocessor line such as ``#ifdef NAME``."""
    UNKNOWN = auto()
    """A character, or an open string, that belongs nowhere."""


OPERATORS = frozenset([":=", "..", "=>", "<>", "<=", ">=", "**", *";:,()[].+-*/=<>&^"])
"""Operators and separators."""

_KIND_BY_FIRST = {
    **dict.fromkeys("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_", TokenKind.IDENTIFIER),
    **dict.fromkeys("0123456789'\"", TokenKind.LITERAL),
    "%": TokenKind.ADDRESS,
    "#": TokenKind.DIRECTIVE,
}


def kind_of(text: str) -> TokenKind:
    """Return the kind of the token ``text``."""
    if text in OPERATORS:
        return TokenKind.OPERATOR
    if not text:
        return TokenKind.END
    kind = _KIND_BY_FIRST.get(text[0], TokenKind.UNKNOWN)
    if kind is TokenKind.IDENTIFIER:
        return TokenKind.LITERAL if "#" in text else kind
    if kind is TokenKind.LITERAL:
        return TokenKind.UNKNOWN if is_open_string(text) else kind
    return kind if len(text) > 1 else TokenKind.UNKNOWN


NAME = "name"
"""Key of an identifier that is no keyword of the parser."""

_KEY_BY_KIND = {
    TokenKind.END: "",
    TokenKind.IDENTIFIER: NAME,
    TokenKind.LITERAL: "literal",
    TokenKind.ADDRESS: "address",
    TokenKind.DIRECTIVE: "directive",
    TokenKind.UNKNOWN: "unknown",
}


class KeyTable(dict[str, str]):
    """Key by token: what a parser decides by.

    The key of a keyword is the keyword in capitals, of an operator the operator itself, of other
    tokens `NAME` or the kind in lower case, of the end of the text the empty string.
    """

    def __init__(self, keywords: Iterable[str]) -> None:
        self._keywords = frozenset(keywords)
        super().__init__(zip(OPERATORS, OPERATORS, strict=True))
        for keyword in self._keywords:
            self.update(dict.fromkeys((keyword, keyword.lower(), keyword.capitalize()), keyword))
        self.update(dict.fromkeys(("TRUE", "FALSE", "true", "false", "True", "False"), "literal"))

    def keys_of(self, texts: Sequence[str]) -> list[str]:
        """Return the keys of tokens, those of an own copy: a file's names are not kept."""
        return list(map(_FileKeys(self, self._keywords).__getitem__, texts))

    def keys_when_asked(self, texts: Sequence[str]) -> Keys:
        """Return what `keys_of` does, each key worked out when it is asked for.

        That is for parsers that ask for few.
        """
        return _AskedKeys(texts, _FileKeys(self, self._keywords))


class Keys(Protocol):
    """The keys of tokens."""

    def __getitem__(self, index: int, /) -> str:
        """Return the key of a token."""


class _AskedKeys:
    __slots__ = ("_keys", "_texts")

    def __init__(self, texts: Sequence[str], keys: Mapping[str, str]) -> None:
        self._texts = texts
        self._keys = keys

    def __getitem__(self, index: int) -> str:
        return self._keys[self._texts[index]]


class _FileKeys(dict[str, str]):
    """The keys of one file."""

    __slots__ = ("_keywords",)

    def __init__(self, known: Mapping[str, str], keywords: frozenset[str]) -> None:
        super().__init__(known)
        self._keywords = keywords

    def __missing__(self, text: str) -> str:
        upper = text.upper()
        if upper in self._keywords:
            key = upper
        elif upper in ("TRUE", "FALSE"):
            key = "literal"
        elif text.isidentifier() and text.isascii():
            key = NAME
        else:
            key = _KEY_BY_KIND[kind_of(text)]
        self[text] = key
        return key


def is_open_string(text: str) -> bool:
    """Return True for a token that starts a string and does not end it on its line."""
    return text[0] in "'\"" and _STRING.fullmatch(text) is None


class Tokens:
    """The tokens of a source.

    Attributes:
        source: the text they were cut from.
        texts: one string a token, then empty ones for the end of the text, `LOOKAHEAD` or more.
        trivia: blanks, comments and pragmas before each token.
        truncated: True where the text has more than `MAX_TOKENS` tokens; the others were not read.
        parentheses: by the number of a ``(`` that a parser found around an expression, the number
            that is ``at`` of the expression; the tree has no nodes for them.
    """

    __slots__ = ("_offsets", "parentheses", "source", "texts", "trivia", "truncated")

    def __init__(self, source: Source) -> None:
        parts = _CUT.split(source.text, maxsplit=MAX_TOKENS)
        self.source = source
        self.truncated = bool(parts[-1])
        self.trivia = parts[1::3] + [""] * LOOKAHEAD
        self.texts = parts[2::3] + [""] * LOOKAHEAD
        self._offsets: list[int] | None = None
        self.parentheses: dict[int, int] = {}

    @classmethod
    def placed(cls, source: Source, tokens: Sequence[tuple[int, str]]) -> Tokens:
        """Return tokens that were cut elsewise, such as from the attributes of XML.

        Args:
            source: the file.
            tokens: each with its offset in the file; several may stem from one place.
        """
        made = cls(type(source)(source.path, ""))
        made.source = source
        made.texts = [text for _, text in tokens] + [""] * LOOKAHEAD
        made.trivia = [""] * len(made.texts)
        made._offsets = [offset for offset, _ in tokens] + [len(source.text)] * LOOKAHEAD
        return made

    @property
    def end(self) -> int:
        """Number of the token that stands for the end of the text."""
        return self.texts.index("")

    def offset(self, index: int) -> int:
        """Return the offset in the text of the first character of token ``index``."""
        if self._offsets is None:
            parts = chain.from_iterable(zip(self.trivia, self.texts, strict=True))
            self._offsets = list(accumulate(map(len, parts)))[::2]
        return self._offsets[index]

    def select(self, chosen: Sequence[tuple[int, str]]) -> None:
        """Keep some tokens only, in the order given; each stays at its place in the source.

        Args:
            chosen: numbers of tokens, each with the text that takes its place: what a preprocessor
                leaves.
        """
        end = self.end
        places = [index for index, _ in chosen] + [end] * LOOKAHEAD
        self._offsets = [self.offset(index) for index in places]
        self.trivia = [self.trivia[index] for index in places]
        self.texts = [text for _, text in chosen] + [""] * LOOKAHEAD

    def end_offset(self, index: int) -> int:
        """Return the offset just behind token ``index``."""
        return self.offset(index) + len(self.texts[index])

    def location(self, index: int) -> Location:
        """Return the place of token ``index``."""
        return self.source.location(self.offset(index))


_OUTSIDE = re.compile(
    rf"""\(\* | /\* | //[^\r\n]* | {_STRINGS} | ['"] [^\r\n]*""",
    re.VERBOSE | re.DOTALL,
)
_INSIDE = {"(*": re.compile(r"\(\*|\*\)"), "/*": re.compile(r"/\*|\*/")}


def unnest_comments(text: str) -> str | None:
    """Return ``text`` with the marks of comments inside comments blanked out, offsets kept.

    None if no comment lies inside another one, or if their marks do not pair up: then the text is
    not meant so, as in ``(* see (* below *)``.
    """
    inner: list[int] = []
    depth = offset = 0
    pattern = _OUTSIDE
    while match := (pattern if depth else _OUTSIDE).search(text, offset):
        offset = match.end()
        opens = match.group() in _INSIDE
        if depth > (0 if opens else 1):
            inner.append(match.start())
        if opens and not depth:
            pattern = _INSIDE[match.group()]
        if opens or depth:
            depth += 1 if opens else -1
    return None if depth or not inner else _blank_marks(text, inner)


def _blank_marks(text: str, starts: list[int]) -> str:
    ends = [0, *(start + 2 for start in starts)]
    kept = [text[end:start] for end, start in zip(ends, [*starts, len(text)], strict=True)]
    return "  ".join(kept)
