"""Parser of program organisation units: what stands around declarations and statements.

Object orientation and namespaces are read, so that a file of them parses; which of them can run the
checker says.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text.syntax.charts import ChartParser
from plcsim.program.structured_text.syntax.keywords import UNIT_ENDS, UNIT_STARTS
from plcsim.program.structured_text.syntax.tree import (
    ActionUnit,
    Configuration,
    FunctionBlockUnit,
    FunctionUnit,
    Include,
    InterfaceUnit,
    MethodUnit,
    NamespaceUnit,
    ProgramConfiguration,
    ProgramUnit,
    StructuredTextFile,
    TaskConfiguration,
)
from st_types.syntax.lexer import NAME
from st_types.syntax.reader import UnexpectedTokenError
from st_types.syntax.specifications import VARIABLE_SECTIONS
from st_types.syntax.tree import FunctionBlockDeclaration, FunctionDeclaration

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.program.structured_text.syntax.tree import Part, Statement, Unit
    from st_types.syntax.tree import VariableBlock

_MODIFIERS = frozenset(
    ["PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL", "FINAL", "ABSTRACT", "OVERRIDE"]
)
_CHART_WORDS = frozenset(["INITIAL_STEP", "STEP", "TRANSITION"])
_PARTS = _CHART_WORDS | {"ACTION", "METHOD", "PROPERTY"}
_LOST_UNIT = (
    "a file of Structured Text holds PROGRAM, FUNCTION, FUNCTION_BLOCK, ACTION, TYPE or VAR"
)


class UnitParser(ChartParser):
    """Parses whole files."""

    def structured_text_file(self) -> StructuredTextFile:
        """Parse the file; errors go to ``diagnostics``."""
        self._open = []
        units: list[Unit] = []
        while self.text:
            start = self.index
            try:
                self._unit(units)
            except UnexpectedTokenError as err:
                self.tell(err.offset, err.message, err.hint)
                self._recover_unit(start)
        self._check_end()
        return StructuredTextFile(units, self.tokens, self.diagnostics)

    def _recover_unit(self, start: int) -> None:
        """Step to the next unit, or behind the end of the one that cannot be read."""
        self.depth = 0
        del self._open[:]
        self.index = max(self.index, start + 1)
        while (key := self.keys[self.index]) and (key not in UNIT_STARTS or self._is_name(key)):
            self.index += 1

    def _unit(self, into: list[Unit]) -> None:
        key = self.keys[self.index]
        if key == ";":
            self.index += 1
        elif key in _CHART_WORDS:
            self._stray_chart(key)
        elif key in VARIABLE_SECTIONS:
            into.append(self._variable_block())
        elif key in _UNIT_RULES:
            _UNIT_RULES[key](self, into)
        elif key == "directive":
            into.append(self._include())
        elif key == "literal" or key in UNIT_ENDS:
            self.fail("expected a unit", _LOST_UNIT)
        else:
            self._rare_unit(into)

    def _stray_chart(self, key: str) -> None:
        """Read an element of a chart that stands in no unit, and tell it."""
        self.tell(self.here(), f"a {key} stands in a PROGRAM or a FUNCTION_BLOCK")
        self._part([])

    def _rare_unit(self, into: list[Unit]) -> None:
        """Parse what begins with a word that is a keyword only here."""
        word = self.keyword
        if word == "USING":
            self._skip_line_of_names()
        elif word == "ACTIONS" and self.keys[self.index + 1] == NAME:
            self._actions_of(into)
        elif word in _MODIFIERS and self.keys[self.index + 1] in UNIT_STARTS:
            self.index += 1
            self._unit(into)
        else:
            hint = "a pragma ends with '}'" if word == "{" else _LOST_UNIT
            self.fail("expected a unit", hint)

    def _actions_of(self, into: list[Unit]) -> None:
        """Parse ``ACTIONS owner ACTION ... END_ACTION END_ACTIONS``."""
        self.index += 1
        owner = self._name("after ACTIONS")
        while self.keys[self.index] == "ACTION":
            action = self._action()
            action.name = f"{owner}.{action.name}"
            into.append(action)
            self.accept(";")
        if not self.accept("END_ACTIONS"):
            self.fail("expected END_ACTIONS")

    def _skip_line_of_names(self) -> None:
        while self.keys[self.index] not in (";", ""):
            self.index += 1

    def _include(self) -> Include:
        at, text = self.index, self.text
        self.index += 1
        return Include(at, text.partition("include")[2].strip().strip('<>"'))

    def _types(self, into: list[Unit]) -> None:
        into.append(self._type_block())

    def _name(self, context: str) -> str:
        """Step over a name, which may be a keyword, and may have parts joined by dots."""
        if not (self.text.isidentifier() and self.text.isascii()):
            self.fail(f"expected a name {context}")
        start = self.index
        self.index += 1
        while self.keys[self.index] == "." and self.texts[self.index + 1].isidentifier():
            self.index += 2
        return "".join(self.texts[start : self.index])

    def _words(self) -> tuple[str, ...]:
        start = self.index
        while self.keyword in _MODIFIERS and self.texts[self.index + 1].isidentifier():
            self.index += 1
        return tuple(word.upper() for word in self.texts[start : self.index])

    def _bases(self) -> list[str]:
        """Parse ``EXTENDS a, b IMPLEMENTS c``."""
        bases: list[str] = []
        while self.keys[self.index] in ("EXTENDS", "IMPLEMENTS"):
            word = self.keyword
            self.index += 1
            bases.append(self._name(f"after {word}"))
            while self.accept(","):
                bases.append(self._name("after ','"))
        return bases

    # Units with a body.

    def _variable_blocks(self) -> list[VariableBlock]:
        blocks: list[VariableBlock] = []
        while True:
            key = self.keys[self.index]
            if key in VARIABLE_SECTIONS and self.keys[self.index + 1] not in (":=", "."):
                blocks.append(self._variable_block())
            elif key == ";":
                self.index += 1
            elif key == "USING":
                self._skip_line_of_names()
            else:
                return blocks

    def _content(
        self, end: str, at: int, *, has_parts: bool = False
    ) -> tuple[list[VariableBlock], list[Statement], list[Part]]:
        """Parse declarations, statements and parts up to the keyword ``end``, and step over it."""
        self._open.append(end)
        blocks = self._variable_blocks()
        body: list[Statement] = []
        parts: list[Part] = []
        while True:
            body += self.statements()
            key = self.keys[self.index]
            if key in _PARTS and has_parts:
                self._part(parts)
            elif key in VARIABLE_SECTIONS:
                blocks.append(self._variable_block())
            else:
                break
        self._open.pop()
        self.close(end, at)
        return blocks, body, parts

    def _part(self, into: list[Part]) -> None:
        key = self.keys[self.index]
        if key == "ACTION":
            into.append(self._action())
        elif key == "METHOD":
            into.append(self._method())
        elif key == "PROPERTY":
            into += self._property()
        elif key == "TRANSITION":
            into.append(self.transition())
        else:
            into.append(self.step())

    def _program(self, into: list[Unit]) -> None:
        at = self.index
        self.index += 1
        self._words()
        name = self._name("after PROGRAM")
        named = self.index - 1
        blocks, body, parts = self._content("END_PROGRAM", at, has_parts=True)
        into.append(ProgramUnit(named, name, blocks, body, parts))

    def _function_unit(self, into: list[Unit]) -> None:
        at = self.index
        self.index += 1
        self._words()
        name = self._name("after FUNCTION")
        named = self.index - 1
        result = self.specification() if self.accept(":") else None
        blocks, body, _ = self._content("END_FUNCTION", at)
        declaration = FunctionDeclaration(named, name, result, blocks)
        into.append(FunctionUnit(named, declaration, body))

    def _function_block_unit(self, into: list[Unit]) -> None:
        at = self.index
        self.index += 1
        words = self._words()
        if self.keys[at] == "CLASS":
            words = ("CLASS", *words)
        name = self._name(f"after {self.keys[at]}")
        named = self.index - 1
        bases = self._bases()
        blocks, body, parts = self._content(f"END_{self.keys[at]}", at, has_parts=True)
        extended = self.texts[named + 1].upper() == "EXTENDS"
        base = bases[0] if extended and bases else ""
        declaration = FunctionBlockDeclaration(named, name, blocks, base=base)
        into.append(FunctionBlockUnit(named, declaration, body, parts, words, bases))

    def _action_unit(self, into: list[Unit]) -> None:
        into.append(self._action())

    def _action(self) -> ActionUnit:
        at = self.index
        self.index += 1
        name = self._name("after ACTION")
        named = self.index - 1
        self.accept(":")
        _, body, _ = self._content("END_ACTION", at)
        return ActionUnit(named, name, body)

    def _method_unit(self, into: list[Unit]) -> None:
        into.append(self._method())

    def _method(self) -> MethodUnit:
        at = self.index
        self.index += 1
        words = self._words()
        name = self._name("after METHOD")
        named = self.index - 1
        result = self.specification() if self.accept(":") else None
        blocks, body, _ = self._content("END_METHOD", at)
        return MethodUnit(named, FunctionDeclaration(named, name, result, blocks), body, words)

    def _property(self) -> list[MethodUnit]:
        at = self.index
        self.index += 1
        words = ("PROPERTY", *self._words())
        name = self._name("after PROPERTY")
        named = self.index - 1
        result = self.specification() if self.accept(":") else None
        found = [MethodUnit(named, FunctionDeclaration(named, name, result, []), [], words)]
        blocks = self._variable_blocks()
        while self.keyword in ("GET", "SET"):
            accessor, start = self.keyword, self.index
            self.index += 1
            blocks, body, _ = self._content(f"END_{accessor}", start)
            declaration = FunctionDeclaration(named, name, result, blocks)
            found.append(MethodUnit(named, declaration, body, (*words, accessor)))
            self.accept(";")
        self.close("END_PROPERTY", at)
        return found

    def _interface(self, into: list[Unit]) -> None:
        at = self.index
        self.index += 1
        name = self._name("after INTERFACE")
        found: list[Part] = []
        into.append(InterfaceUnit(self.index - 1, name, self._bases(), found))
        while self.keys[self.index] in ("METHOD", "PROPERTY"):
            self._part(found)
            self.accept(";")
        self.close("END_INTERFACE", at)

    def _namespace(self, into: list[Unit]) -> None:
        at = self.index
        self.index += 1
        self._words()
        into.append(NamespaceUnit(self.index, self._name("after NAMESPACE")))
        self.enter()
        while self.keys[self.index] != "END_NAMESPACE":
            if not self.text:
                break
            self._unit(into)
        self.leave()
        self.close("END_NAMESPACE", at)

    # Configurations.

    def _configuration_unit(self, into: list[Unit]) -> None:
        into.append(self._configuration())

    def _configuration(self) -> Configuration:
        """Parse a CONFIGURATION, or a RESOURCE in it."""
        at = self.index
        end = f"END_{self.keys[at]}"
        self.index += 1
        self.enter()
        name = self._name(f"after {self.keys[at]}")
        found = Configuration(
            self.index - 1, name, [], tasks := [], programs := [], resources := []
        )
        processor = self._name("after ON") if self.accept("ON") else ""
        while self.keys[self.index] != end:
            blocks = self._variable_blocks()
            key = self.keys[self.index]
            if key == "RESOURCE":
                resources.append(self._configuration())
            elif key == "TASK":
                tasks.append(self._task())
            elif key == "PROGRAM":
                programs.append(self._program_configuration())
            elif not blocks:
                break
            found.blocks = [*found.blocks, *blocks]
        self.leave()
        self.close(end, at)
        found.processor = processor
        return found

    def _task(self) -> TaskConfiguration:
        at = self.index
        self.index += 1
        name = self._name("after TASK")
        self.expect("(", "after the name of a TASK")
        arguments = self._arguments()
        self.expect(";", "after a TASK")
        return TaskConfiguration(at, name, arguments)

    def _program_configuration(self) -> ProgramConfiguration:
        at = self.index
        self.index += 1
        if self.keyword in ("RETAIN", "NON_RETAIN"):
            self.index += 1
        name = self._name("after PROGRAM")
        task = self._name("after WITH") if self.accept("WITH") else ""
        self.expect(":", "before the type of a program")
        type_name = self._name("of a program type")
        arguments = self._arguments() if self.accept("(") else []
        self.expect(";", "after a PROGRAM")
        return ProgramConfiguration(at, name, task, type_name, arguments)


_UNIT_RULES: dict[str, Callable[[UnitParser, list[Unit]], None]] = {
    "TYPE": UnitParser._types,
    "PROGRAM": UnitParser._program,
    "FUNCTION": UnitParser._function_unit,
    "FUNCTION_BLOCK": UnitParser._function_block_unit,
    "CLASS": UnitParser._function_block_unit,
    "ACTION": UnitParser._action_unit,
    "METHOD": UnitParser._method_unit,
    "INTERFACE": UnitParser._interface,
    "NAMESPACE": UnitParser._namespace,
    "CONFIGURATION": UnitParser._configuration_unit,
}
