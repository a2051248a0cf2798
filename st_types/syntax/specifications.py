"""Parser of type specifications and of lists of declarations, the same in TYPE, STRUCT and VAR."""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.syntax.expressions import Argument
from st_types.syntax.initials import InitialParser
from st_types.syntax.lexer import TokenKind, kind_of
from st_types.syntax.reader import UnexpectedTokenError
from st_types.syntax.tree import (
    ArraySpecification,
    Declaration,
    EnumerationSpecification,
    EnumerationValue,
    NamedType,
    OpenArraySpecification,
    ReferenceSpecification,
    StringSpecification,
    StructSpecification,
    SubrangeSpecification,
)
from st_types.syntax.trivia import pragmas_in
from st_types.types.elementary import ALL_ELEMENTARY

if TYPE_CHECKING:
    from collections.abc import Callable

    from st_types.syntax.diagnostics import DiagnosticLog
    from st_types.syntax.expressions import Expression
    from st_types.syntax.lexer import Tokens
    from st_types.syntax.tree import Initial, TypeSpecification

VARIABLE_SECTIONS = frozenset(
    [
        *("VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_GLOBAL", "VAR_EXTERNAL"),
        *("VAR_TEMP", "VAR_CONFIG", "VAR_ACCESS", "VAR_STAT", "VAR_INST"),
        "VAR_GENERIC",
    ]
)
"""Keywords that start a block of variables."""

END_KEYWORDS = frozenset(
    ["END_TYPE", "END_VAR", "END_STRUCT", "END_UNION", "END_FUNCTION", "END_FUNCTION_BLOCK"]
)
_EDGES = ("R_EDGE", "F_EDGE")
_AFTER_TYPE = (";", ":=")
_SINGLE_ENDS = frozenset(["END_TYPE", "END_VAR"])
"""Ends of blocks that lie in no other list of declarations: one taken for the other ends both."""

ITEM_KEYWORDS = frozenset(["TYPE", "FUNCTION", "FUNCTION_BLOCK", "PROGRAM"]) | VARIABLE_SECTIONS
BLOCK_KEYWORDS = ITEM_KEYWORDS | END_KEYWORDS
"""Where a list of declarations ends, unless a colon follows: then it is a name."""

_NO_BASE = BLOCK_KEYWORDS.union(_EDGES)


class SpecificationParser(InitialParser):
    """Parses declarations and the specifications in them."""

    def __init__(self, tokens: Tokens, diagnostics: DiagnosticLog) -> None:
        super().__init__(tokens, diagnostics)
        self.trivia = tokens.trivia
        self._has_pragmas = "{" in tokens.source.text
        self._is_ascii = tokens.source.text.isascii()

    def declarations(self, end: str) -> list[Declaration]:
        """Parse declarations up to the keyword ``end`` and step over it.

        Errors go to ``diagnostics``.
        """
        texts = self.texts
        found: list[Declaration] = []
        while True:
            index = self.index
            name = texts[index]
            if texts[index + 1] == ":":
                if texts[index + 3] == ";" and self._short_declaration(found):
                    continue
            elif name == ";":
                self.index += 1
                continue
            elif not name or (name.upper() in BLOCK_KEYWORDS and not self.is_name()):
                break
            depth = self.depth
            try:
                self._declaration(found)
            except UnexpectedTokenError as err:
                self.recover(err, depth, index)
        keyword = texts[self.index].upper()
        if keyword != end:
            self.tell(self.here(), f"expected {end}, found {self.found()}")
        if keyword == end or (keyword in _SINGLE_ENDS and end in _SINGLE_ENDS):
            self.index += 1
        return found

    def is_name(self) -> bool:
        """Return True where a keyword stands as the name of a declaration."""
        following, second = self.texts[self.index + 1 : self.index + 3]
        return following in (":", ",") or (following.upper() == "AT" and second.startswith("%"))

    def _short_declaration(self, into: list[Declaration]) -> bool:
        """Parse ``name : type;``, as most declarations are; False if it is not as simple."""
        index, texts, trivia = self.index, self.texts, self.trivia
        name, type_name = texts[index], texts[index + 2]
        before = trivia[index]
        if type_name in _NOT_SHORT or not (name.isidentifier() and type_name.isidentifier()):
            return False
        if not self._is_ascii and not (name.isascii() and type_name.isascii()):
            return False
        if self._has_pragmas and ("{" in before or "{" in trivia[index + 2]):
            return False
        self.index = index + 4
        named = NamedType(index + 2, type_name)
        into.append(Declaration(index, name, named, None, "", (), "", before, trivia[index + 4]))
        return True

    def recover(self, err: UnexpectedTokenError, depth: int, start: int) -> None:
        """Log an error and step to where a declaration or a block may start.

        That is behind the next semicolon, at ``name :`` on a new line, or at a block's keyword.
        """
        self.tell(err.offset, err.message, err.hint)
        self.depth = depth
        texts, trivia = self.texts, self.trivia
        index = max(self.index, start + 1)
        while texts[index] and texts[index - 1] != ";":
            if texts[index + 1] == ":":
                if "\n" in trivia[index]:
                    break
            elif texts[index].upper() in BLOCK_KEYWORDS:
                break
            index += 1
        self.index = index

    def _declaration(self, into: list[Declaration]) -> None:
        at = self.index
        texts, trivia = self.texts, self.trivia
        name = texts[at]
        if not (name.isidentifier() and name.isascii()):
            self.fail("expected the name of a declaration")
        self.index = at + 1
        base = self._base() if texts[at + 1].upper() == "EXTENDS" else ""
        others, address = ([], "") if texts[self.index] == ":" else self._others_and_address()
        colon = self.expect(":", f"after the name {name}")
        specification = self.specification()
        if base:
            specification = self._extended(base, specification)
        edge = self._edge() if texts[self.index] not in _AFTER_TYPE else ""
        initial: Initial | None = None
        if texts[self.index] == ":=":
            self.index += 1
            initial = self.initial()
        if texts[self.index] == ";":
            self.index += 1
        else:
            self._end_without_semicolon(name)
        pragmas = pragmas_in(trivia[at] + trivia[colon + 1]) if self._has_pragmas else ()
        behind = trivia[self.index]
        into.append(
            Declaration(
                at, name, specification, initial, address, pragmas, edge, trivia[at], behind
            )
        )
        for at, name in others:
            into.append(Declaration(at, name, specification, initial, address, pragmas, edge))

    def _base(self) -> str:
        """Parse ``EXTENDS base`` between the name of a STRUCT and the colon."""
        if self.texts[self.index + 1] == ":":
            return ""
        self.index += 1
        return self.expect_name("of a STRUCT after EXTENDS")

    def _extended(self, base: str, specification: TypeSpecification) -> StructSpecification:
        if not isinstance(specification, StructSpecification) or specification.keyword != "STRUCT":
            self.fail_before("only a STRUCT can extend another one")
        specification.base = base
        return specification

    def _others_and_address(self) -> tuple[list[tuple[int, str]], str]:
        """Parse ``, b, c`` and ``AT %IX0.0`` between the first name and the colon."""
        others = []
        while self.accept(","):
            others.append((self.index, self.expect_name("after ','")))
        address = ""
        if self.accept("AT"):
            if kind_of(self.text) is not TokenKind.ADDRESS:
                self.fail("expected an address such as %IX0.0 after AT")
            address = self.text
            self.index += 1
        return others, address

    def _edge(self) -> str:
        if self.keyword not in _EDGES:
            return ""
        self.index += 1
        return self.texts[self.index - 1].upper()

    def _end_without_semicolon(self, name: str) -> None:
        ended = self.texts[self.index - 1].upper() in ("END_STRUCT", "END_UNION")
        if not ended and self.keyword not in END_KEYWORDS:
            self.fail_before(f"expected ';' after the declaration of {name}")

    def specification(self) -> TypeSpecification:
        """Parse a type as it stands behind the colon of a declaration.

        Raises:
            UnexpectedTokenError: there is none here.
        """
        text = self.texts[self.index]
        keyword = text.upper()
        rule = _RULES.get(keyword)
        if rule is not None:
            self.enter()
            found = rule(self)
            self.leave()
            return found
        if not (text.isidentifier() and text.isascii()) or keyword in END_KEYWORDS:
            self.fail("expected a type")
        self.index += 1
        while self.texts[self.index] == "." and self.texts[self.index + 1].isidentifier():
            self.index += 2  # of a namespace or a library only the last name counts
            text = self.texts[self.index - 1]
        if self.texts[self.index] == "(":
            return self._restricted(self.index - 1, text)
        if self.texts[self.index] == "[":
            return self._given_to_each(self.index - 1, text)
        if self.texts[self.index] == "<":
            self.fail_before(
                f"{text}<...> (VAR_GENERIC) is not supported: expected the name of a type alone"
            )
        return NamedType(self.index - 1, text)

    def _array_specification(self) -> ArraySpecification | OpenArraySpecification:
        at = self.index
        self.index += 1
        self.expect("[", "after ARRAY")
        dimensions = self._open_dimensions()
        bounds = [] if dimensions else [self._bounds()]
        while not dimensions and self.accept(","):
            bounds.append(self._bounds())
        self.expect("]", "or ',' after the bounds of an array")
        self.expect("OF", "after the bounds of an array")
        element = self.specification()
        if dimensions:
            return OpenArraySpecification(at, dimensions, element)
        return ArraySpecification(at, bounds, element)

    def _open_dimensions(self) -> int:
        """Parse ``*, *`` and return the number of dimensions; 0 where there are bounds."""
        count = int(self.accept("*"))
        while count and self.accept(","):
            self.expect("*", "as in all dimensions of an ARRAY that takes any bounds")
            count += 1
        return count

    def skip_behind(self, end: str) -> None:
        """Step behind the keyword ``end``, or to the end of the text if there is none."""
        texts, index = self.texts, self.index + 1
        while texts[index] and texts[index].upper() != end:
            index += 1
        self.index = index + bool(texts[index])

    def _union(self) -> StructSpecification | NamedType:
        """Parse a UNION; the name of a type is one, too."""
        if self.texts[self.index + 1] in (";", ":="):
            self.index += 1
            return NamedType(self.index - 1, self.texts[self.index - 1])
        return self._struct_specification()

    def _bounds(self) -> tuple[Expression, Expression]:
        low = self.expression()
        self.expect("..", "between the bounds of an array")
        return low, self.expression()

    def _string_specification(self) -> StringSpecification | NamedType:
        at = self.index
        name = self.texts[at]
        self.index += 1
        closing = {"[": "]", "(": ")"}.get(self.text)
        if closing is None:
            return NamedType(at, name)
        self.index += 1
        length = self.expression()
        self.expect(closing, "after the length of a string")
        return StringSpecification(at, name.upper(), length)

    def _reference_specification(self) -> ReferenceSpecification:
        at = self.index
        self.index += 1
        if self.texts[at].upper() != "REF_TO":
            self.expect("TO", f"after {self.texts[at]}")
        return ReferenceSpecification(at, self.specification(), self.texts[at].upper())

    def _struct_specification(self) -> StructSpecification:
        at = self.index
        self.index += 1
        keyword = self.texts[at].upper()
        behind = self.trivia[self.index]
        members = self.declarations(f"END_{keyword}")
        closing = self.trivia[max(at + 1, self.index - 1)]
        return StructSpecification(at, members, keyword, "", behind, closing)

    def _enumeration_specification(self) -> EnumerationSpecification:
        at = self.index
        self.index += 1
        values: list[EnumerationValue] = []
        while not self.accept(")"):
            if values:
                self.expect(",", f"or ')' after the enumeration value {values[-1].name}")
                values[-1].behind = self.trivia[self.index]
                if self.accept(")"):
                    break
            values.append(self._enumeration_value())
        base = ""
        if kind_of(self.text) is TokenKind.IDENTIFIER and self.keyword not in _NO_BASE:
            base = self.expect_name("of a type")
        return EnumerationSpecification(at, values, base)

    def _enumeration_value(self) -> EnumerationValue:
        at = self.index
        name = self.expect_name("of an enumeration value")
        value = self.expression() if self.accept(":=") else None
        trivia = self.trivia
        return EnumerationValue(at, name, value, trivia[at], trivia[self.index])

    def _restricted(
        self, at: int, base: str
    ) -> SubrangeSpecification | EnumerationSpecification | NamedType:
        """Parse ``(low..high)``, ``(A, B)`` or ``(input := value)`` behind the name of a type."""
        is_elementary = base.upper() in ALL_ELEMENTARY
        if is_elementary and self.texts[self.index + 2] in (",", ")", ":="):
            found = self._enumeration_specification()
            return EnumerationSpecification(at, found.values, base)
        if not is_elementary and self.texts[self.index + 2] == ":=":
            return NamedType(at, base, [self._given()])
        self.index += 1
        low = self.expression()
        if not is_elementary and self.text != "..":
            return NamedType(at, base, [self._given(Argument(low.at, "", low))])
        self.expect("..", f"between the bounds of {base}")
        high = self.expression()
        self.expect(")", f"after the bounds of {base}")
        return SubrangeSpecification(at, base, low, high)

    def _given_to_each(self, at: int, name: str) -> NamedType:
        """Parse ``[(input := value), (input := value)]`` behind the name of a function block."""
        self.index += 1
        given = [self._given()]
        while self.accept(","):
            given.append(self._given())
        self.expect("]", "or ',' after what an instance is given")
        return NamedType(at, name, given)

    def _given(self, first: Argument | None = None) -> list[Argument]:
        """Parse what FB_init gets, up to the parenthesis; ``first`` was read already."""
        found = [] if first is None else [first]
        if first is None:
            self.expect("(", "before what FB_init is given")
        while not self.accept(")"):
            if found:
                self.expect(",", "or ')' after what FB_init is given")
            at = self.index
            name = self.expect_name("of an input") if self.texts[at + 1] == ":=" else ""
            if name:
                self.expect(":=", f"after {name}")
            found.append(Argument(at, name, self.expression()))
        return found


_RULES: dict[str, Callable[[SpecificationParser], TypeSpecification]] = {
    "ARRAY": SpecificationParser._array_specification,
    "STRING": SpecificationParser._string_specification,
    "WSTRING": SpecificationParser._string_specification,
    "REFERENCE": SpecificationParser._reference_specification,
    "POINTER": SpecificationParser._reference_specification,
    "REF_TO": SpecificationParser._reference_specification,
    "STRUCT": SpecificationParser._struct_specification,
    "UNION": SpecificationParser._union,
    "(": SpecificationParser._enumeration_specification,
}
_NOT_SHORT = frozenset(
    [spelling(key) for key in _RULES for spelling in (str, str.lower, str.capitalize)]
)
