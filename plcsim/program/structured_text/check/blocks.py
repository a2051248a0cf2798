"""Checking assignments and calls of function blocks, which assign inputs and outputs."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from plcsim.program.structured_text.check.calls import CallChecker, Parameter
from plcsim.program.structured_text.check.kinds import (
    ANY_INT,
    BOOL,
    UDINT,
    VOID,
    TypeKind,
    kind_of,
)
from plcsim.program.structured_text.check.names import NOTHING, keep_address, root_of
from plcsim.program.structured_text.check.recursion import block_label
from plcsim.program.structured_text.check.typed import (
    PLACES,
    Address,
    Assign,
    CallBlock,
    Constant,
    Evaluate,
    SetAddress,
    Symbol,
    Target,
    Unary,
    Variable,
)
from plcsim.program.structured_text.codes import FindingCode
from st_types.syntax import expressions as syntax
from st_types.types.derived import DataBlockType, ReferenceType, Section, StructType

if TYPE_CHECKING:
    from plcsim.program.structured_text.check.findings import FileFindings
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.names import ScopeNames
    from plcsim.program.structured_text.check.typed import Statement, Value
    from plcsim.program.structured_text.syntax.tree import BlockCall
    from st_types.syntax.expressions import Expression


LINKS: Final = frozenset(("MpComIdentType", "McAxisType", "McAxesGroupType"))
"""Types of what mapp's configuration makes: its blocks know it by its address, nobody by value."""


class BlockChecker(CallChecker):
    """Checks assignments and calls of function blocks."""

    def __init__(self, names: ScopeNames, findings: FileFindings) -> None:
        super().__init__(names, findings)
        self._own_instances: dict[str, int] = {}

    # Function blocks

    def block_call(self, node: syntax.Call, line: int) -> Statement | None:
        """Check the call of a function block, None if it is none."""
        instance = self._instance(node.function)
        return None if instance is None else self._called_block(node, instance, line)

    def _called_block(self, node: syntax.Call, instance: Value, line: int) -> Statement:
        """Check the call of an instance of a function block with the arguments of ``node``."""
        meant = self._for_bounds_given(node, instance)
        if meant is None:
            return CallBlock(line, instance, instance.type.name, (), ())
        instance, name = meant
        block = instance.type
        assert isinstance(block, DataBlockType)
        before: list[Statement] = []
        after: list[Statement] = []
        inputs = iter([member for member in block.members if member.section is Section.INPUT])
        for argument in node.arguments:
            parameter = argument.name
            if not parameter:
                member = next(inputs, None)
                if member is None:
                    message = f"{block} takes fewer arguments without a name"
                    self.error(argument, FindingCode.WRONG_ARGUMENTS, message)
                    continue
                parameter = member.name
            self._block_argument(argument, parameter, instance, before, after, line)
        self.called_bodies.add(block_label(name))
        return CallBlock(line, instance, name, before, after)

    def call_by_type(self, node: BlockCall, line: int) -> Statement | None:
        """Check the call of a function block by its type, as Automation Basic has it.

        None where ``node`` has no instance and names no function block.
        """
        known = self.names.scope.find_function_block(node.block.name)
        data_type = None if known is None else known.data_type
        if node.instance is None:
            if data_type is None or self.names.value(node.block) is not None:
                return None
            instance = self._own_instance(node, data_type)
        else:
            instance = self.value(node.instance)
            if data_type is None:
                message = f"no function block is called {node.block.name}"
                self.error(node.block, FindingCode.UNKNOWN_TYPE, message)
            elif instance.type is not VOID and instance.type is not data_type:
                message = f"this is {instance.type}, no {node.block.name}"
                self.error(node.instance, FindingCode.NOT_CALLABLE, message)
        if instance.type is VOID or instance.type is not data_type or data_type is None:
            return Evaluate(line, NOTHING)
        arguments = self._by_name(node, data_type)
        return self._called_block(syntax.Call(node.at, node.block, arguments), instance, line)

    def _own_instance(self, node: BlockCall, data_type: DataBlockType[Any]) -> Value:
        """Return the instance that a call has for itself: of a function block a member of its own.

        Automation Studio declares such members itself, zzTON00000 and so on.
        """
        number = self._own_instances.get(data_type.name, 0)
        self._own_instances[data_type.name] = number + 1
        if self.names.symbols.storages.get(self.names.scope) != "instance":
            name = f"{data_type.name} {number} of {node.at}"
            return Variable(data_type, Symbol(name, data_type, "hidden", has_address=True))
        wanted = re.compile(rf"zz{re.escape(data_type.name)}\d+", re.ASCII)
        variables = self.names.scope.index.variables
        names = [each.name for each in variables if wanted.fullmatch(each.name)]
        if number < len(names):
            return self.names.value(syntax.Name(node.at, names[number])) or NOTHING
        message = f"the function block has no member zz{data_type.name}{number:05} for this call"
        hint = f"declare it as VAR : {data_type.name}, as Automation Studio does when it builds"
        self.error(node, FindingCode.UNKNOWN_MEMBER, message, hint)
        return NOTHING

    def _by_name(self, node: BlockCall, block: DataBlockType[Any]) -> list[syntax.Argument]:
        """Return arguments in order, inputs and then outputs, with the names of what they are."""
        members = [
            each
            for section in (Section.INPUT, Section.IN_OUT, Section.OUTPUT)
            for each in block.members
            if each.section is section
        ]
        given = node.arguments
        if not given:
            return []
        has_names = any(each.name or each.value is None for each in given)
        if has_names or len(given) != len(members):
            message = f"{block} takes its {len(members)} inputs and outputs in order, or nothing"
            self.error(node, FindingCode.WRONG_ARGUMENTS, message)
            return []
        if any(each.section is Section.IN_OUT for each in members):
            message = f"{block} has a VAR_IN_OUT"
            self.error(node, FindingCode.NOT_SUPPORTED, f"{message}, which has no place here")
            return []
        return [
            syntax.Argument(each.at, member.name, each.value, member.section is Section.OUTPUT)
            for each, member in zip(given, members, strict=True)
        ]

    def _for_bounds_given(self, node: syntax.Call, instance: Value) -> tuple[Value, str] | None:
        """Return an instance as the function block for the arrays that it is given, and its name.

        That has the same data block, with an address of arrays of such bounds. None after an error.
        """
        found = self.names.symbols.open_blocks.get(instance.type)
        if found is None:
            return instance, instance.type.name
        arrays = self.arrays_given(node, found)
        made = None if arrays is None else found.block_for(arrays)
        if made is None or made.data_type is None:
            return None
        self.called_open[made.name] = (found, made)
        keep_address(instance)
        return Target(made.data_type, Address(UDINT, instance)), made.name

    def _instance(self, node: Expression) -> Value | None:
        if self.method_of(node) is not None:
            return None
        if type(node) is syntax.Name and self.names.value(node) is None:
            return None
        value = self.value(node)
        return value if isinstance(value.type, DataBlockType) else None

    def bare_call(self, node: Expression, line: int) -> Statement | None:
        """Check an instance as a statement, which is its call; None if it is none."""
        if type(node) is syntax.MemberAccess and self.method_of(node) is not None:
            return Evaluate(line, self.called(syntax.Call(node.at, node, ())))
        instance = self._instance(node)
        if instance is None:
            return None
        return self.block_call(syntax.Call(node.at, node, ()), line)

    def _block_argument(
        self,
        argument: syntax.Argument,
        name: str,
        instance: Value,
        before: list[Statement],
        after: list[Statement],
        line: int,
    ) -> None:
        block = instance.type
        assert isinstance(block, DataBlockType)
        spelling = self.spelling_of(block, name)
        section = None if spelling is None else block.find(spelling)[0].section
        wanted = (Section.OUTPUT,) if argument.is_output else (Section.INPUT, Section.IN_OUT)
        if spelling is None or section not in wanted:
            self._no_block_parameter(argument, name, block, wanted)
            return
        if argument.value is None:
            return
        if spelling != name and self.names.scope.dialect.case_sensitive:
            message = f"{name} is declared as {spelling}"
            self.findings.warning(argument, FindingCode.OTHER_CASE, message)
        member = self.member_of(instance, block, spelling)
        if argument.is_output:
            after += self._output(argument, member, line)
        else:
            before += self._input(argument, member, section, line)

    def _no_block_parameter(
        self,
        argument: syntax.Argument,
        name: str,
        block: DataBlockType[Any],
        wanted: tuple[Section, ...],
    ) -> None:
        names = [member.name for member in block.members if member.section in wanted]
        kind = "output" if argument.is_output else "input"
        message = f"{block} has no {kind} {name}{self.findings.near(name, names)}"
        self.error(argument, FindingCode.UNKNOWN_PARAMETER, message)
        if argument.value is not None:
            self.value(argument.value)

    def _output(self, argument: syntax.Argument, member: Value, line: int) -> list[Statement]:
        assert argument.value is not None
        target = self.assigned(argument.value)
        value: Value = Unary(BOOL, "NOT", member) if argument.is_negated else member
        self.check_fit(argument.value, value, target.type)
        return [Assign(line, target, value)]

    def _input(
        self, argument: syntax.Argument, member: Value, section: Section | None, line: int
    ) -> list[Statement]:
        assert argument.value is not None
        if section is Section.IN_OUT:
            assert isinstance(member, Target)
            parameter = Parameter(argument.name, member.type, "VAR_IN_OUT", by_address=True)
            value = self._argument(argument.value, parameter)
            return [SetAddress(line, member.pointer, value)]
        return [self.assignment(argument.value, member, self.value(argument.value), line)]

    # Assignments, of statements and of inputs

    def assigned(self, node: Expression) -> Value:
        """Check what is assigned: a variable that is no constant."""
        value = self.value(node)
        if isinstance(value, PLACES):
            symbol = root_of(value)
            if symbol is not None:
                symbol.written = True
            if symbol is not None and symbol.is_constant:
                message = f"{symbol.name} is a constant"
                self.error(node, FindingCode.CONSTANT_ASSIGNED, message)
            return value
        if value.type is not VOID:
            is_name = type(node) is syntax.Name
            code = FindingCode.CONSTANT_ASSIGNED if is_name else FindingCode.NO_VARIABLE
            message = "a constant cannot be assigned" if is_name else "this cannot be assigned"
            self.error(node, code, message)
        return NOTHING

    def _check_pointer(self, node: Expression, target: Value, value: Value) -> None:
        """Refuse the address of one function block with methods in a pointer to another one."""
        if not isinstance(value, Address):
            return
        classes, wanted, given = self.names.symbols.classes, _led_to(target), value.place.type
        if wanted is given or wanted not in classes or given not in classes:
            return
        message = f"a pointer to {wanted} does not lead to {given}"
        hint = "its methods are those of its declared type; an INTERFACE takes any"
        self.error(node, FindingCode.NOT_SUPPORTED, message, hint)

    def assignment(
        self, node: Expression, target: Value, value: Value, line: int
    ) -> Assign | SetAddress:
        """Return ``target := value``; ``node`` is the value.

        An address goes into a reference itself, unless that refers to an integer of 32 bits: then
        it goes there, as any other value does. So does 0, which is no address. A link of mapp
        has no value that a program could copy, so one reference to a link takes what another has.
        """
        value = self.address_of_text(node, value, target.type)
        value = self.as_implementation(value, target.type)
        self._check_pointer(node, target, value)
        if isinstance(target, Target) and isinstance(target.pointer.type, ReferenceType):
            if _is_link(target) and _is_link(value) and isinstance(value, Target):
                return SetAddress(line, target.pointer, value.pointer)
            is_address = isinstance(value, Address) or value.type is UDINT or _is_nil(value)
            if is_address and _takes_address(target.type, value):
                return SetAddress(line, target.pointer, value)
        self.check_fit(node, value, target.type)
        return Assign(line, target, value)


def _is_link(value: Value) -> bool:
    """Return whether a value is what a reference to a link of mapp leads to."""
    return (
        isinstance(value, Target)
        and isinstance(value.pointer.type, ReferenceType)
        and isinstance(value.type, StructType)
        and value.type.name in LINKS
    )


def _led_to(target: Value) -> object:
    """Return what the pointer or reference leads to that takes an address, None if it is none."""
    if isinstance(target.type, ReferenceType):
        return target.type.target
    return target.type if isinstance(target, Target) else None


def _takes_address(target: Type, value: Value) -> bool:
    """Return whether an address goes into a reference to ``target`` itself, not where it leads."""
    kind = kind_of(target)
    if isinstance(value, Address):
        return kind is not TypeKind.INTEGER or target.size != UDINT.size
    return kind >= TypeKind.STRING


def _is_nil(value: Value) -> bool:
    return isinstance(value, Constant) and value.type is ANY_INT and value.value == 0
